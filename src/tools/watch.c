#include "tools/watch.h"

#include "base/base.h"
#include "tools/report.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* What goes through the pipe; short enough to arrive whole (PIPE_BUF). */
typedef struct step {
    char what[200];
    bool limited;
} step;

static int pipe_end = -1; /* of the process that works; -1: nobody watches */

void lsf_watch_step(const char *what, bool limited)
{
    step next = {.limited = limited};
    snprintf(next.what, sizeof next.what, "%s", what);
    if (pipe_end >= 0 && write(pipe_end, &next, sizeof next) < 0)
        _exit(LSF_ERROR_RENDER); /* who watched is gone */
}

static int begin_work(lsf_watched_work *work, void *user, const int ends[2])
{
    close(ends[0]);
    pipe_end = ends[1];
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    int status = work(user);
    fflush(NULL);
    exit(status);
}

static int report_hang(const step *last, double seconds)
{
    lsf_error error;
    lsf_error_set(&error, LSF_ERROR_RENDER,
                  "%s: no end after %g s: look for an endless loop, or raise --watchdog",
                  last->what, seconds);
    return lsf_report_error(&error);
}

static int status_of(pid_t child, const step *last)
{
    int status = 0;
    lsf_error error;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    if (WIFEXITED(status))
        return WEXITSTATUS(status);
    lsf_error_set(&error, LSF_ERROR_RENDER,
                  "%s: the process of the shader was ended by the signal: %s", last->what,
                  strsignal(WTERMSIG(status)));
    return lsf_report_error(&error);
}

/* Reads steps until the pipe is closed. False: one of them took too long. */
static bool follow(int end, double seconds, step *last)
{
    double start = lsf_now();
    for (;;) {
        struct pollfd ready = {.fd = end, .events = POLLIN};
        double left = last->limited ? start + seconds - lsf_now() : 1.0;
        int wait = (int)ceil(fmin(fmax(left, 0.0), 1.0) * 1000.0);
        if (poll(&ready, 1, wait) > 0) {
            step next;
            if (read(end, &next, sizeof next) != (ssize_t)sizeof next)
                return true;
            *last = next;
            start = lsf_now();
        } else if (last->limited && lsf_now() - start >= seconds) {
            return false;
        }
    }
}

int lsf_watch(lsf_watched_work *work, void *user, double seconds)
{
    int ends[2];
    lsf_error error;
    if (seconds <= 0.0)
        return work(user);
    if (pipe(ends) != 0) {
        lsf_error_set(&error, LSF_ERROR_RENDER, "no pipe to a process: %s", strerror(errno));
        return lsf_report_error(&error);
    }
    fflush(NULL);
    pid_t child = fork();
    if (child == 0)
        return begin_work(work, user, ends);
    close(ends[1]);
    step last = {.what = "sandbox"};
    bool ended = child > 0 && follow(ends[0], seconds, &last);
    close(ends[0]);
    if (child < 0) {
        lsf_error_set(&error, LSF_ERROR_RENDER, "no process for the shader: %s", strerror(errno));
        return lsf_report_error(&error);
    }
    if (ended)
        return status_of(child, &last);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    return report_hang(&last, seconds);
}
