/* Work that may hang or die, in a process of its own. */
#ifndef LSF_TOOLS_WATCH_H
#define LSF_TOOLS_WATCH_H

#include <lightsheaf/error.h>

/* What the process does; returns its exit status. */
typedef int lsf_watched_work(void *user);

/* Does it in a process that is ended when it takes longer than `seconds` (0: no limit, and this
 * process does it itself) for a step. Returns the work's status, or that of the error, which is
 * then reported: it hung, or died. Whatever starts threads belongs into the work: this process is
 * copied without them. */
int lsf_watch(lsf_watched_work *work, void *user, double seconds);

/* Within the work: what it does next, for messages, and whether that may be as long as it takes. */
void lsf_watch_step(const char *what, bool limited);

#endif
