#include "view/budget.h"

#include <math.h>

#define SMALLEST 0.125
/* Frames are counted among those of the mean for about as long. */
#define MEMORY 4.0
/* Between these times the budget nothing changes: a change costs a moment by itself. */
#define TOO_SLOW 1.1
#define TOO_FAST 0.55
/* The first frames after a change hold what it costs to make things anew. */
enum { SETTLING = 2, PATIENCE = 8 };

/* What the change should lead to, below the budget. */
#define AIM 0.85

void lsf_budget_start(lsf_budget *budget, double seconds)
{
    *budget = (lsf_budget){.seconds = seconds, .scale = 1.0};
}

/* Time is at most in proportion to pixels, and at least independent of them; half of it is taken
 * to be in proportion. */
static bool slow_down(lsf_budget *budget, double ratio)
{
    if (budget->scale <= SMALLEST && budget->coarse == LSF_BUDGET_COARSEST)
        return false;
    /* Below a half of the sides, detail of maps is what is seen least. */
    if (budget->scale <= 0.5 && budget->coarse < LSF_BUDGET_COARSEST)
        budget->coarse++;
    else
        budget->scale = fmax(SMALLEST, budget->scale * fmax(0.5, sqrt(ratio)));
    return true;
}

static bool speed_up(lsf_budget *budget, double ratio)
{
    if (budget->scale >= 1.0 && budget->coarse == 0)
        return false;
    if (budget->scale >= 0.5 && budget->coarse > 0)
        budget->coarse--;
    else
        budget->scale = fmin(1.0, budget->scale * fmin(1.5, sqrt(ratio)));
    return true;
}

bool lsf_budget_measure(lsf_budget *budget, double seconds)
{
    if (++budget->frames <= SETTLING)
        return false;
    double weight = budget->mean > 0.0 ? 1.0 / MEMORY : 1.0;
    budget->mean += weight * (seconds - budget->mean);
    double ratio = AIM * budget->seconds / budget->mean;
    bool slow = budget->mean > TOO_SLOW * budget->seconds;
    bool fast = budget->mean < TOO_FAST * budget->seconds && budget->frames > PATIENCE;
    bool changed = (slow && slow_down(budget, ratio)) || (fast && speed_up(budget, ratio));
    if (changed) {
        budget->mean = 0.0;
        budget->frames = 0;
    }
    return changed;
}
