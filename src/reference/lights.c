#include "reference/lights.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/punctual.h"
#include "scene/environment.h"
#include "shared/brdf.h"

/* Rays that find the distances of the surfaces around a lamp. */
#define PROBES 16u

/* Rows of an environment map that are read to estimate its irradiance. */
#define SKY_ROWS 64u

static lsf_light_bounds point_bounds(const lsf_light_state *light)
{
    lsf_light_bounds bounds = {.range = light->range,
                               .cos_spread = -1.0f,
                               .cos_emission = 0.0f,
                               .intensity = lsf_f3_luminance(lsf_f3_load(light->intensity))};
    for (int i = 0; i < 3; i++) {
        bounds.low[i] = bounds.high[i] = light->position[i];
        bounds.axis[i] = light->direction[i];
    }
    return bounds;
}

/* A spot's cone; its penumbra counts as light that falls off from it. */
static lsf_light_bounds punctual_bounds(const lsf_light_state *light)
{
    if (light->type == LSF_LIGHT_DIRECTIONAL)
        return (lsf_light_bounds){.intensity = 0.0f};
    lsf_light_bounds bounds = point_bounds(light);
    if (light->type == LSF_LIGHT_SPOT) {
        float between = acosf(light->cos_outer) - acosf(light->cos_inner);
        bounds.cos_spread = light->cos_inner;
        bounds.cos_emission = cosf(fmaxf(between, 0.0f) + LSF_LIGHT_ROUNDING);
    }
    return bounds;
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The surfaces around a lamp as an emitter, half of which are within the box. */
static lsf_light_bounds lit_bounds(const lsf_reference_geometry *geometry,
                                   const lsf_light_state *light, uint32_t number)
{
    lsf_light_bounds bounds = point_bounds(light);
    bounds.range = INFINITY;
    bounds.intensity = lsf_punctual_power(light);
    float distances[PROBES];
    uint32_t met = 0;
    for (uint32_t i = 0; bounds.intensity > 0.0f && i < PROBES; i++) {
        lsf_reference_hit hit;
        float u[2];
        lsf_sobol_2d(i, number, u);
        if (lsf_punctual_begin(geometry, light, u, (lsf_reference_chance){number, i}, &hit))
            distances[met++] = hit.distance;
    }
    if (met == 0)
        return bounds;
    qsort(distances, met, sizeof *distances, by_size);
    for (int i = 0; i < 3; i++) {
        bounds.low[i] -= distances[met / 2];
        bounds.high[i] += distances[met / 2];
    }
    return bounds;
}

/* Lamps are drawn by the surfaces around them, or a few lamps by power alone. */
static bool init_lit(lsf_reference_lights *lights, lsf_light_bounds *bounds)
{
    const lsf_state *state = lights->geometry->state;
    if (state->light_count > LSF_LIGHTS_MOST) {
        for (uint32_t i = 0; i < state->light_count; i++)
            bounds[i] = lit_bounds(lights->geometry, &state->lights[i], i);
        return lsf_light_tree_init(&lights->lit, bounds, state->light_count);
    }
    float powers[LSF_LIGHTS_MOST];
    for (uint32_t i = 0; i < state->light_count; i++)
        powers[i] = lsf_punctual_power(&state->lights[i]);
    return lsf_distribution_init(&lights->powers, powers, state->light_count);
}

static bool init_bulbs(lsf_reference_lights *lights)
{
    const lsf_state *state = lights->geometry->state;
    lsf_light_bounds *bounds = lsf_alloc(state->light_count, sizeof *bounds);
    bool ok = bounds != NULL && init_lit(lights, bounds);
    for (uint32_t i = 0; ok && i < state->light_count; i++)
        bounds[i] = punctual_bounds(&state->lights[i]);
    ok = ok && lsf_light_tree_init(&lights->bulbs, bounds, state->light_count);
    free(bounds);
    return ok;
}

static bool init_glow(lsf_reference_lights *lights)
{
    const lsf_reference_emitters *emitters = &lights->emitters;
    uint64_t count = emitters->count;
    lsf_light_bounds *bounds = count < LSF_NO_LEAF / 2 ? lsf_alloc(count, sizeof *bounds) : NULL;
    for (uint64_t i = 0; bounds != NULL && i < count; i++)
        bounds[i] = lsf_reference_emitter_bounds(emitters, lights->geometry, i);
    bool ok = bounds != NULL && lsf_light_tree_init(&lights->glow, bounds, (uint32_t)count);
    free(bounds);
    return ok;
}

static bool init_far(lsf_reference_lights *lights)
{
    const lsf_state *state = lights->geometry->state;
    lights->far = lsf_alloc(state->light_count, sizeof *lights->far);
    for (uint32_t i = 0; lights->far != NULL && i < state->light_count; i++)
        if (state->lights[i].type == LSF_LIGHT_DIRECTIONAL)
            lights->far[lights->far_count++] = i;
    return lights->far != NULL;
}

/* Reads the midpoints of every n-th texel. */
static void measure_irradiance(lsf_reference_lights *lights)
{
    const lsf_environment *map = lights->sky.environment;
    uint32_t step = (map->height + SKY_ROWS - 1) / SKY_ROWS;
    uint32_t rows = (map->height + step - 1) / step, columns = (map->width + step - 1) / step;
    for (uint32_t y = 0; y < rows; y++)
        for (uint32_t x = 0; x < columns; x++) {
            double polar = M_PI * (y + 0.5) / rows;
            lsf_float3 d = lsf_environment_direction(map, (x + 0.5) / columns, cos(polar));
            double cell = 2.0 * M_PI / columns * M_PI / rows * sin(polar);
            float light = lsf_f3_luminance(lsf_environment_radiance(map, d)) * (float)cell;
            const float along[3] = {d.x, d.y, d.z};
            for (int i = 0; i < 3; i++)
                lights->sky_irradiance[i][along[i] > 0.0f] += fabsf(along[i]) * light;
        }
}

/* Otherwise rays drawn by the BRDF find the background, which is black or uniform. */
static bool is_drawn(const lsf_sky *sky)
{
    return sky->weights && sky->mean > 0.0f;
}

bool lsf_reference_lights_init(lsf_reference_lights *lights, const lsf_reference_geometry *geometry,
                               lsf_error *error)
{
    *lights = (lsf_reference_lights){.geometry = geometry};
    if (!lsf_reference_emitters_init(&lights->emitters, geometry, error))
        return false;
    const lsf_environment *environment = &geometry->scene->environment;
    if (!lsf_sky_init(&lights->sky, environment)) {
        lsf_reference_lights_finish(lights);
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "out of memory for a %u x %u environment's distribution",
                             environment->width, environment->height);
    }
    if (!init_far(lights) || !init_bulbs(lights) || !init_glow(lights)) {
        lsf_reference_lights_finish(lights);
        return lsf_error_set(
            error, LSF_ERROR_RENDER, "out of memory for %u lights and %llu emissive triangles",
            geometry->state->light_count, (unsigned long long)lights->emitters.count);
    }
    lights->sky_drawn = is_drawn(&lights->sky);
    if (lights->sky_drawn && lights->far_count > 0)
        measure_irradiance(lights);
    return true;
}

void lsf_reference_lights_finish(lsf_reference_lights *lights)
{
    lsf_reference_emitters_finish(&lights->emitters);
    lsf_light_tree_finish(&lights->glow);
    lsf_light_tree_finish(&lights->bulbs);
    lsf_light_tree_finish(&lights->lit);
    lsf_distribution_finish(&lights->powers);
    lsf_sky_finish(&lights->sky);
    free(lights->far);
    *lights = (lsf_reference_lights){0};
}

bool lsf_reference_lights_are_met(const lsf_reference_lights *lights)
{
    return lights->emitters.count != 0 || lights->geometry->scene->environment.present;
}

/* Irradiance from the sky, interpolated from the six known ones by the squares of the normal's
 * components, which sum to 1 (G. McTaggart, "Half-Life 2 / Valve Source Shading", GDC 2004). */
static float sky_importance(const lsf_reference_lights *lights, const lsf_light_receiver *receiver)
{
    const float n[3] = {receiver->normal.x, receiver->normal.y, receiver->normal.z};
    float sum = 0.0f;
    for (int i = 0; i < 3; i++) {
        const float *sides = lights->sky_irradiance[i];
        sum += n[i] * n[i] * (receiver->both_sides ? sides[0] + sides[1] : sides[n[i] > 0.0f]);
    }
    return sum;
}

/* `index` as in lsf_far_lights_draw. */
static double far_importance(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                             uint32_t index)
{
    if (index == lights->far_count)
        return lights->sky_drawn ? (double)sky_importance(lights, receiver) : 0.0;
    const lsf_light_state *light = &lights->geometry->state->lights[lights->far[index]];
    float arrives = -lsf_f3_dot(receiver->normal, lsf_f3_load(light->direction));
    if (receiver->both_sides)
        arrives = fabsf(arrives);
    return (double)(lsf_f3_luminance(lsf_f3_load(light->intensity)) * fmaxf(arrives, 0.0f));
}

static double all_importance(const lsf_reference_lights *lights, const lsf_light_receiver *receiver)
{
    double sum = 0.0;
    for (uint32_t i = 0; i <= lights->far_count; i++)
        sum += far_importance(lights, receiver, i);
    return sum;
}

uint32_t lsf_far_lights_draw(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                             uint32_t most, double u, lsf_light_choice *choices)
{
    uint32_t end = lights->far_count + lights->sky_drawn;
    if (end <= most) {
        for (uint32_t i = 0; i < end; i++)
            choices[i] = (lsf_light_choice){.light = i, .probability = 1};
        return end;
    }
    double sum = all_importance(lights, receiver);
    if (!(sum > 0.0))
        return 0;
    double passed = 0.0, importance = 0.0;
    for (uint32_t i = 0; i < end; i++) {
        importance = far_importance(lights, receiver, i);
        passed += importance;
        if (importance > 0.0 && (u * sum < passed || i + 1 == end)) {
            *choices = (lsf_light_choice){.light = i, .probability = (float)(importance / sum)};
            return 1;
        }
    }
    return 0;
}

float lsf_sky_probability(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                          uint32_t most)
{
    if (!lights->sky_drawn)
        return 0.0f;
    if (lights->far_count + 1 <= most)
        return 1.0f;
    double sum = all_importance(lights, receiver);
    return sum > 0.0 ? (float)(far_importance(lights, receiver, lights->far_count) / sum) : 0.0f;
}

bool lsf_lit_draw(const lsf_reference_lights *lights, lsf_float3 position,
                  lsf_light_numbers numbers, lsf_light_choice *choice)
{
    if (lights->powers.count == 0) {
        lsf_light_receiver receiver = {.position = position};
        return lsf_light_tree_draw(&lights->lit, &receiver, 1, numbers, choice) == 1;
    }
    uint32_t bits[2];
    lsf_sobol_2d_bits(numbers.sample, numbers.seed, bits);
    choice->light =
        (uint32_t)lsf_distribution_sample(&lights->powers, lsf_unit_double(bits[0]), &choice->u[0]);
    choice->u[1] = lsf_unit_double(bits[1]);
    choice->probability = (float)lsf_distribution_probability(&lights->powers, choice->light);
    return true;
}

float lsf_lit_probability(const lsf_reference_lights *lights, lsf_float3 position, uint32_t light)
{
    if (lights->powers.count != 0)
        return (float)lsf_distribution_probability(&lights->powers, light);
    lsf_light_receiver receiver = {.position = position};
    return lsf_light_tree_probability(&lights->lit, &receiver, 1, light);
}
