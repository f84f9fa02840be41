/* What of the panels was shown, and what of that was used: so that a test can tell whether its
 * replay reaches all of it. */
#ifndef LSF_WINDOW_REACH_H
#define LSF_WINDOW_REACH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif

/* From now on; until then nothing is counted. */
void lsf_reach_start(void);
/* A thing is there, and has just been used or has not. `kind` is static; of `label` what a replay
 * calls it counts, or what follows ###. */
void lsf_reach_note(const char *kind, const char *label, bool used);
/* A row of a client's table of keys: where one continues the one before, `keys` is NULL. */
void lsf_reach_key(size_t row, const char *keys, bool used);
/* A line for each thing, in the order in which they were first there: whether it was used, its kind
 * and its name, with tabs between. */
bool lsf_reach_write(const char *path, lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
