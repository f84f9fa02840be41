/* How large pictures may be while things move, and how coarse maps and grids, so that each is there
 * in time. Sizes and settings are a ladder of rungs, the finest first; what a frame takes on a rung
 * is its price. Prices that were seen are kept, those of other rungs follow from them, and the
 * finest rung is taken whose price fits. */
#ifndef LSF_VIEW_BUDGET_H
#define LSF_VIEW_BUDGET_H

#include <stdbool.h>
#include <stdint.h>

enum { LSF_BUDGET_RUNGS = 16 };
#define LSF_BUDGET_COARSEST 3u

typedef struct lsf_budget {
    double seconds;                 /* that a frame may take */
    double price[LSF_BUDGET_RUNGS]; /* seconds of a frame; 0: never seen */
    uint32_t rung;                  /* 0: as asked for */
    uint32_t frames;                /* since it was changed */
    bool odd;                       /* the last one took far longer than those before */
    double mean;                    /* seconds of frames like this one; 0: none was measured yet */
    double change;                  /* seconds that going over to a rung took, the last time */
    double rested;                  /* seconds since then */
    double wait;                    /* ... until a rung that was left is taken again */
    double patience;                /* seconds until what was tried in vain is tried again */
} lsf_budget;

/* Nothing is known of what frames take. A machine that is `slow` begins with small pictures, of
 * which it sees what they take in little time. */
void lsf_budget_start(lsf_budget *budget, double seconds, bool slow);
/* A frame took so long. True where the next ones are to be otherwise. */
bool lsf_budget_measure(lsf_budget *budget, double seconds);

/* Sides of the picture, to those of the window: 1 to 1/8. */
double lsf_budget_scale(const lsf_budget *budget);
/* How coarse maps and grids are: 0, as asked for, to LSF_BUDGET_COARSEST. */
uint32_t lsf_budget_coarse(const lsf_budget *budget);

#endif
