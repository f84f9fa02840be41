/* SIGINT, SIGTERM and SIGHUP. While iterations run, the first one asks to stop after the current
 * iteration; at any other time, and the second time always, the process dies by the signal. Files
 * that are being written are removed first, so that none is left torn. */
#ifndef LSF_TOOLS_INTERRUPT_H
#define LSF_TOOLS_INTERRUPT_H

#include "tools/options.h"

#include <stdbool.h>

void lsf_interrupt_install(void);

/* Between these two the first signal is kept for lsf_interrupted. */
void lsf_interrupt_begin_iterations(void);
void lsf_interrupt_end_iterations(void);

/* Whether a signal asked to stop. */
bool lsf_interrupted(void);

/* An lsf_progress that draws the lsf_progress_bar `bar` and stops when a signal asked to. */
bool lsf_interrupt_progress(uint32_t done, uint32_t total, void *bar);

/* Fails when a signal stopped the iterations before the first sample was done: there is no picture.
 */
bool lsf_interrupt_may_save(uint32_t samples, lsf_error *error);

#endif
