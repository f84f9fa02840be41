/* What of the panels was shown, and what of that was used: so that a test can tell whether its
 * replay reaches all of it. */
#ifndef LSF_WINDOW_REACH_H
#define LSF_WINDOW_REACH_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_reach_row {
    const char *kind; /* "button", "slider", ... */
    char name[128];   /* of its label what a replay calls it, or what follows ### */
    bool used;
} lsf_reach_row;

/* From now on; until then nothing is counted. */
void lsf_reach_start(void);
/* A thing is shown. `kind` is static. */
void lsf_reach_note(const char *kind, const char *label, bool used);
/* In the order in which things were first shown; NULL past the end. */
const lsf_reach_row *lsf_reach_at(uint32_t index);

#ifdef __cplusplus
}
#endif
#endif
