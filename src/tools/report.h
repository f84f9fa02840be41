/* What the command says on stderr: messages, a progress bar at a terminal, errors. */
#ifndef LSF_TOOLS_REPORT_H
#define LSF_TOOLS_REPORT_H

#include <lightsheaf/lightsheaf.h>

typedef enum lsf_verbosity {
    LSF_VERBOSITY_QUIET,   /* errors */
    LSF_VERBOSITY_NORMAL,  /* and warnings, progress, the closing line */
    LSF_VERBOSITY_VERBOSE, /* and everything the library logs */
} lsf_verbosity;

/* Takes over the library's log. */
void lsf_report_start(lsf_verbosity verbosity);

/* Messages of the log that do not name that file begin with its name from here on; NULL: they
 * begin with none. */
void lsf_report_about(const char *path);

/* Does not print warnings of the log again that were printed before: many renderings have the
 * same ones. */
void lsf_report_once(void);

/* Prints the error; returns the exit status that goes with it. */
int lsf_report_error(const lsf_error *error);

/* One line on stderr, unless quiet. */
void lsf_report_line(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* A bar with the time left, drawn only when stderr is a terminal and the command is not quiet. */
typedef struct lsf_progress_bar {
    const char *label;
    double time_limit;   /* seconds; infinity: none */
    double start, drawn; /* lsf_now() */
} lsf_progress_bar;

/* Draws an empty bar and starts its clock. */
void lsf_progress_bar_start(lsf_progress_bar *bar, const char *label, uint32_t total,
                            double time_limit);
/* `done` of `total` iterations; `total` UINT32_MAX: as many as the time limit allows. */
void lsf_progress_bar_draw(lsf_progress_bar *bar, uint32_t done, uint32_t total);
void lsf_progress_bar_clear(void);

#endif
