#include "sweep/grid.h"

#include <stdlib.h>
#include <string.h>

#include <lightsheaf/renderer.h>

#include "base/base.h"

enum { LONGEST = 128 }; /* "pass.key=value" */

/* A technique's sweeps, counted like an odometer: one value of each. */
typedef struct grid {
    const char *sweeps[LSF_SWEEP_MAX_OPTIONS];
    uint32_t count;
    const char *values[LSF_SWEEP_MAX_OPTIONS]; /* start of the current one */
} grid;

static bool takes(const char *technique, const char *sweep, lsf_error *error, bool *good)
{
    char key[LONGEST];
    size_t length = strcspn(sweep, "=");
    if (length >= sizeof key || sweep[length] == '\0') {
        *good = lsf_error_set(error, LSF_ERROR_USAGE,
                              "--sweep %s: expected pass.key=value,value,...", sweep);
        return false;
    }
    memcpy(key, sweep, length);
    key[length] = '\0';
    return lsf_technique_takes(technique, key);
}

static bool begin(grid *g, const char *technique, const char *const *sweeps, uint32_t count,
                  bool *used, lsf_error *error)
{
    bool good = true;
    *g = (grid){.count = 0};
    for (uint32_t i = 0; good && i < count; i++) {
        if (!takes(technique, sweeps[i], error, &good))
            continue;
        if (g->count == LSF_SWEEP_MAX_OPTIONS)
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "--sweep %s: one too many; %d options are the most", sweeps[i],
                                 LSF_SWEEP_MAX_OPTIONS);
        for (uint32_t k = 0; k < g->count; k++)
            if (strncmp(g->sweeps[k], sweeps[i], strcspn(sweeps[i], "=") + 1) == 0)
                return lsf_error_set(error, LSF_ERROR_USAGE,
                                     "--sweep %s: that option is swept already; name all its "
                                     "values at once",
                                     sweeps[i]);
        used[i] = true;
        g->sweeps[g->count] = sweeps[i];
        g->values[g->count++] = strchr(sweeps[i], '=') + 1;
    }
    return good;
}

/* Goes to the next combination; false after the last. */
static bool next_combination(grid *g)
{
    for (uint32_t i = g->count; i-- > 0;) {
        g->values[i] += strcspn(g->values[i], ",");
        if (*g->values[i] == ',') {
            g->values[i]++;
            return true;
        }
        g->values[i] = strchr(g->sweeps[i], '=') + 1;
    }
    return false;
}

static bool add_current(lsf_measurement *m, const grid *g, const char *technique, lsf_error *error)
{
    char texts[LSF_SWEEP_MAX_OPTIONS][LONGEST];
    const char *options[LSF_SWEEP_MAX_OPTIONS];
    for (uint32_t i = 0; i < g->count; i++) {
        size_t key = (size_t)(strchr(g->sweeps[i], '=') + 1 - g->sweeps[i]);
        size_t value = strcspn(g->values[i], ",");
        if (value == 0 || key + value >= LONGEST)
            return lsf_error_set(error, LSF_ERROR_USAGE,
                                 "--sweep %s: expected pass.key=value,value,...", g->sweeps[i]);
        memcpy(texts[i], g->sweeps[i], key);
        memcpy(texts[i] + key, g->values[i], value);
        texts[i][key + value] = '\0';
        options[i] = texts[i];
    }
    return lsf_measurement_add_configuration(m, technique, options, g->count) >= 0 ||
           lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

bool lsf_sweep_grid_add(lsf_measurement *m, const char *const *techniques, uint32_t technique_count,
                        const char *const *sweeps, uint32_t sweep_count, lsf_error *error)
{
    bool *used = lsf_alloc((uint64_t)sweep_count + 1, sizeof *used);
    bool good = used || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t t = 0; good && t < technique_count; t++) {
        grid g;
        good = begin(&g, techniques[t], sweeps, sweep_count, used, error);
        if (good)
            do
                good = add_current(m, &g, techniques[t], error);
            while (good && next_combination(&g));
    }
    for (uint32_t i = 0; good && i < sweep_count; i++)
        if (!used[i])
            good = lsf_error_set(error, LSF_ERROR_USAGE,
                                 "--sweep %s: none of the techniques takes that option; name one "
                                 "that does with --technique",
                                 sweeps[i]);
    free(used);
    return good;
}
