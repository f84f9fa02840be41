#include "techniques/light_picks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/sky.h"

/* Half of the paths by power, half evenly among the lights that shine, the environment one of them:
 * one with much power may do little in view, as a sun outside does, and must not take all from
 * those that do. */
static void weigh_lights(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                         const lsf_state *state)
{
    uint32_t count = state->light_count + plan->sky_lights, shining = picks->sky;
    float *weights = picks->weights, sum = 0.0f;
    float sky =
        picks->sky ? (float)lsf_sky_fluence(&scene->environment) / (float)plan->sky_lights : 0.0f;
    const lsf_light_state sky_light = {.type = LSF_LIGHT_DIRECTIONAL, .intensity = {sky, sky, sky}};
    for (uint32_t i = 0; i < count; i++) {
        bool punctual = i < state->light_count;
        weights[i] = lsf_light_power(punctual ? &state->lights[i] : &sky_light);
        sum += weights[i];
        shining += punctual && weights[i] > 0.0f;
    }
    picks->power = sum;
    for (uint32_t i = 0; i < count; i++) {
        float parts = i < state->light_count ? 1.0f : (float)plan->sky_lights;
        if (weights[i] > 0.0f)
            weights[i] = weights[i] / sum + 1.0f / ((float)shining * parts);
    }
}

void lsf_light_picks_update(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                            const lsf_state *state)
{
    weigh_lights(picks, plan, scene, state);
    lsf_distribution_set(&picks->distribution, picks->weights);
    picks->sky_probability = 0.0f;
    for (uint64_t i = state->light_count; i < picks->distribution.count; i++)
        picks->sky_probability += (float)lsf_distribution_probability(&picks->distribution, i);
}

void lsf_light_picks_follow(lsf_light_picks *picks, uint32_t count, const float *importance)
{
    double sum = 0.0, shares = 0.0;
    for (uint32_t i = 0; importance && i < count; i++) {
        sum += (double)importance[i];
        shares += (double)picks->weights[i];
    }
    if (!(sum > 0.0) || !isfinite(sum)) {
        lsf_distribution_set(&picks->distribution, picks->weights);
        return;
    }
    memcpy(picks->followed, picks->weights, picks->distribution.count * sizeof *picks->followed);
    for (uint32_t i = 0; i < count; i++)
        if (picks->weights[i] > 0.0f)
            picks->followed[i] =
                0.5f * picks->weights[i] + (float)(0.5 * shares * (double)importance[i] / sum);
    lsf_distribution_set(&picks->distribution, picks->followed);
}

bool lsf_light_picks_init(lsf_light_picks *picks, const lsf_plan *plan, const lsf_scene *scene,
                          const lsf_state *state, bool sky, lsf_error *error)
{
    uint32_t count = state->light_count + plan->sky_lights;
    *picks = (lsf_light_picks){.sky = sky,
                               .weights = lsf_alloc(count, sizeof *picks->weights),
                               .followed = lsf_alloc(count, sizeof *picks->followed)};
    if (!picks->weights || !picks->followed ||
        !lsf_distribution_init(&picks->distribution, picks->weights, count))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights", count);
    lsf_light_picks_update(picks, plan, scene, state);
    return true;
}

void lsf_light_picks_finish(lsf_light_picks *picks)
{
    lsf_distribution_finish(&picks->distribution);
    free(picks->weights);
    free(picks->followed);
    memset(picks, 0, sizeof *picks);
}
