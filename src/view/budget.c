#include "view/budget.h"

#include <math.h>

/* Frames are counted among those of the mean for about as long. */
#define MEMORY 8.0
/* A price that fits is below so much of the budget: one frame takes longer than another. A finer
 * rung that was left for being dear has to be cheaper than that. */
#define FITS 0.85
#define FITS_AGAIN 0.75
/* Where nothing fits, so much more than the cheapest may be taken for a better picture. */
#define DEARER 1.15
/* From one frame to the next the mean is so many times as long where a machine or a view is another
 * one. */
#define ANOTHER 3.0
/* A frame that takes so many budgets is answered at once, others when there were ENOUGH. */
#define FAR_TOO_SLOW 2.0
/* The first frames after a change hold what it costs to make things anew. */
enum { SETTLING = 2, ENOUGH = 2 };
/* Of the time on a rung, so much may go to the change to a finer one whose price is known: changes
 * are seen. And each time that one is left, which a machine does that is busy now and then, it is
 * longer before one is taken again [s]. */
#define CHANGING 0.1
#define WAIT 0.5
#define LONGEST_WAIT 32.0
/* Finer rungs that were dear are doubted after so many seconds, for a price may hold what happened
 * but once; then after twice as many, and so on. */
#define PATIENCE 8.0

/* What is not known of prices. A step to finer maps costs at most that much more, and to coarser
 * ones saves at least that much; a larger picture takes at most so much longer as it has pixels,
 * and half of a frame's time is not the pixels'. What is tried in vain is known from then on. */
#define FINER 1.4
#define COARSER 0.8
#define FIXED 0.5

/* --- rungs --- */

/* By a root of 2 of the pixels, down to half of the sides; below that detail of maps is what is
 * seen least; then pixels again. */
enum { LARGE = 4, SMALL = LARGE + (int)LSF_BUDGET_COARSEST };
#define STEP 0.25 /* of a rung, in powers of 2 of the sides */

static double scale_of(uint32_t rung)
{
    uint32_t steps = rung <= LARGE ? rung : rung <= SMALL ? LARGE : rung - SMALL + LARGE;
    return exp2(-STEP * steps);
}

static uint32_t coarse_of(uint32_t rung)
{
    return rung <= LARGE ? 0u : rung <= SMALL ? rung - LARGE : LSF_BUDGET_COARSEST;
}

double lsf_budget_scale(const lsf_budget *budget)
{
    return scale_of(budget->rung);
}

uint32_t lsf_budget_coarse(const lsf_budget *budget)
{
    return coarse_of(budget->rung);
}

/* A quarter of the sides, and all as coarse as it gets. */
enum { SLOW_START = SMALL + 4 };

void lsf_budget_start(lsf_budget *budget, double seconds, bool slow)
{
    *budget = (lsf_budget){
        .seconds = seconds, .rung = slow ? SLOW_START : 0, .wait = WAIT, .patience = PATIENCE};
}

/* --- prices --- */

static double pixels_of(uint32_t rung)
{
    return scale_of(rung) * scale_of(rung);
}

/* Another rung that was seen, as coarse as this one; LSF_BUDGET_RUNGS: none. */
static uint32_t seen_beside(const lsf_budget *budget, uint32_t rung)
{
    for (uint32_t apart = 1; apart < LSF_BUDGET_RUNGS; apart++)
        for (int side = -1; side <= 1; side += 2) {
            uint32_t other = rung + (uint32_t)(side * (int)apart);
            if (other < LSF_BUDGET_RUNGS && budget->price[other] > 0.0 &&
                coarse_of(other) == coarse_of(rung))
                return other;
        }
    return LSF_BUDGET_RUNGS;
}

/* Seconds for as many times the pixels, of a rung that was seen: by what another one of the same
 * maps took, or else by what is assumed. */
static double with_pixels(const lsf_budget *budget, uint32_t seen, double times)
{
    double price = budget->price[seen], fixed = times > 1.0 ? 0.0 : FIXED;
    uint32_t other = seen_beside(budget, seen);
    if (other < LSF_BUDGET_RUNGS) {
        double ratio = pixels_of(other) / pixels_of(seen);
        /* price (fixed + (1 - fixed) ratio) is the other one's. */
        fixed = (budget->price[other] / price - ratio) / (1.0 - ratio);
        fixed = fmin(1.0, fmax(0.0, fixed));
    }
    return price * (fixed + (1.0 - fixed) * times);
}

/* What a frame on a rung would take, by the one on which it is now; between what coarser and finer
 * ones took. */
static double price_of(const lsf_budget *budget, uint32_t rung)
{
    if (budget->price[rung] > 0.0)
        return budget->price[rung];
    double times = pixels_of(rung) / pixels_of(budget->rung);
    double price = with_pixels(budget, budget->rung, times);
    double steps = (double)coarse_of(rung) - (double)coarse_of(budget->rung);
    price *= steps < 0.0 ? pow(FINER, -steps) : pow(COARSER, steps);
    for (uint32_t i = 0; i < LSF_BUDGET_RUNGS; i++)
        if (budget->price[i] > 0.0)
            price = i < rung ? fmin(price, budget->price[i]) : fmax(price, budget->price[i]);
    return price;
}

/* All that was seen follows what is seen now: another view is dearer on each rung. What is far
 * dearer all at once is another thing, of which nothing is known. */
static void see(lsf_budget *budget)
{
    double before = budget->price[budget->rung];
    double times = before > 0.0 ? budget->mean / before : 1.0;
    for (uint32_t i = 0; i < LSF_BUDGET_RUNGS; i++)
        budget->price[i] = times < ANOTHER ? budget->price[i] * times : 0.0;
    budget->price[budget->rung] = budget->mean;
}

/* --- choosing --- */

/* The finest rung whose price fits; else the coarsest. If that was seen to be too dear as well, the
 * finest that is not much dearer, for what makes no frame quicker need not make pictures worse. */
static uint32_t choose(const lsf_budget *budget)
{
    const uint32_t coarsest = LSF_BUDGET_RUNGS - 1;
    uint32_t rung = 0;
    for (; rung < coarsest; rung++) {
        bool again = rung < budget->rung && budget->price[rung] > 0.0;
        if (price_of(budget, rung) <= (again ? FITS_AGAIN : FITS) * budget->seconds)
            return rung;
    }
    if (budget->price[coarsest] <= budget->seconds)
        return coarsest;
    for (rung = 0; price_of(budget, rung) > DEARER * budget->price[coarsest];)
        rung++;
    return rung;
}

/* A finer rung is worth what it costs to go over, unless it was left before, a moment ago. */
static bool worthwhile(const lsf_budget *budget, uint32_t rung)
{
    return budget->price[rung] == 0.0 ||
           (budget->change < CHANGING * budget->rested && budget->wait < budget->rested);
}

static void doubt(lsf_budget *budget)
{
    if (budget->rested < budget->patience)
        return;
    for (uint32_t i = 0; i < budget->rung; i++)
        budget->price[i] = 0.0;
    budget->rested = 0.0;
    budget->patience *= 2.0;
}

bool lsf_budget_measure(lsf_budget *budget, double seconds)
{
    budget->rested += seconds;
    budget->change = budget->frames == 0 ? seconds : budget->change;
    if (++budget->frames <= SETTLING)
        return false;
    uint32_t measured = budget->frames - SETTLING;
    if (measured > ENOUGH && seconds > ANOTHER * budget->mean && !budget->odd) {
        budget->odd = true; /* one such frame tells nothing */
        budget->frames--;
        return false;
    }
    budget->odd = false;
    double weight = fmax(1.0 / measured, 1.0 / MEMORY);
    budget->mean += weight * (seconds - budget->mean);
    see(budget);
    doubt(budget);
    bool slow = budget->mean > budget->seconds;
    if (measured < ENOUGH && budget->mean < FAR_TOO_SLOW * budget->seconds)
        return false;
    uint32_t rung = choose(budget);
    bool finer = rung < budget->rung && worthwhile(budget, rung);
    bool coarser = rung > budget->rung && slow;
    if (!finer && !coarser)
        return false;
    budget->wait = coarser ? fmin(2.0 * budget->wait, LONGEST_WAIT) : budget->wait;
    budget->rung = rung;
    budget->frames = 0;
    budget->mean = budget->rested = 0.0;
    return true;
}
