/* How large pictures may be while things move, so that each is there in time. */
#ifndef LSF_VIEW_BUDGET_H
#define LSF_VIEW_BUDGET_H

#include <stdbool.h>
#include <stdint.h>

/* Sides of the picture, to those of the window, and how coarse maps and grids are. */
typedef struct lsf_budget {
    double seconds;  /* that a frame may take */
    double scale;    /* 1 to 1/8 */
    uint32_t coarse; /* 0: as asked for, up to LSF_BUDGET_COARSEST */
    double mean;     /* seconds of frames like this one; 0: none was measured yet */
    uint32_t frames; /* since it was changed */
} lsf_budget;

#define LSF_BUDGET_COARSEST 3u

void lsf_budget_start(lsf_budget *budget, double seconds);
/* A frame took so long. True where the next ones are to be otherwise. */
bool lsf_budget_measure(lsf_budget *budget, double seconds);

#endif
