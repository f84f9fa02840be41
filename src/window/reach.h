/* Counts which parts of the panels were shown, and which of them were used, so that a test can
 * tell whether its replay reaches all of them. */
#ifndef LSF_WINDOW_REACH_H
#define LSF_WINDOW_REACH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Begins counting; until then nothing is counted. */
void lsf_reach_start(void);
/* Notes a thing that is shown, and whether it has just been used. `kind` is static; of `label`
 * the part counts that a replay names, or the part behind ###. */
void lsf_reach_note(const char *kind, const char *label, bool used);
/* A row of a client's table of keys: where one continues the one before, `keys` is NULL. */
void lsf_reach_key(size_t row, const char *keys, bool used);
/* A line for each thing, in the order in which they were first shown: whether it was used, its
 * kind and its name, separated by tabs. */
bool lsf_reach_write(const char *path, lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
