/* SIGINT, SIGTERM and SIGHUP. While iterations run, the first one asks to stop after the current
 * iteration; at any other time, and the second time always, the process dies by the signal. Files
 * that are being written are removed first, so that none is left torn. */
#ifndef LSF_TOOLS_INTERRUPT_H
#define LSF_TOOLS_INTERRUPT_H

#include <stdbool.h>

void lsf_interrupt_install(void);

/* Between these two the first signal is kept for lsf_interrupted. */
void lsf_interrupt_begin_iterations(void);
void lsf_interrupt_end_iterations(void);

/* Whether a signal asked to stop. */
bool lsf_interrupted(void);

#endif
