#include "scene/emitted_light.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "math/sampling.h"
#include "scene/emitters.h"
#include "scene/placed_triangle.h"

/* Number of points on surfaces, and on emitters for each of these. They give the median within a
 * few percent, which is little beside the factors by which scenes differ. */
#define POINTS 512
#define EMITTERS_EACH 32

#define TRIANGLES_MAX ((uint64_t)1 << 24)

/* A distribution of all triangles by area. */
typedef struct surfaces {
    const lsf_scene *scene;
    const lsf_state *state;
    uint64_t count;
    uint32_t *instance, *triangle;
    lsf_distribution area;
} surfaces;

typedef struct surface_point {
    lsf_float3 position, normal;
    bool double_sided;
} surface_point;

static uint64_t triangle_count(const surfaces *s, uint32_t instance)
{
    const lsf_instance_state *state = &s->state->instances[instance];
    return state->skipped ? 0 : s->scene->primitives[state->primitive].index_count / 3;
}

static void list_triangles(surfaces *s, float *area)
{
    uint64_t at = 0;
    for (uint32_t i = 0; i < s->state->instance_count; i++) {
        uint64_t count = triangle_count(s, i);
        for (uint32_t t = 0; t < count; t++, at++) {
            s->instance[at] = i;
            s->triangle[at] = t;
            area[at] = (float)lsf_place_triangle(s->scene, s->state, i, t).area;
        }
    }
}

static bool surfaces_init(surfaces *s, const lsf_scene *scene, const lsf_state *state)
{
    *s = (surfaces){.scene = scene, .state = state};
    for (uint32_t i = 0; i < state->instance_count; i++)
        s->count += triangle_count(s, i);
    if (s->count > TRIANGLES_MAX)
        return false;
    s->instance = lsf_alloc(s->count, sizeof *s->instance);
    s->triangle = lsf_alloc(s->count, sizeof *s->triangle);
    float *area = lsf_alloc(s->count, sizeof *area);
    bool good = s->instance && s->triangle && area;
    if (good) {
        list_triangles(s, area);
        good = lsf_distribution_init(&s->area, area, s->count);
    }
    free(area);
    return good;
}

static void surfaces_finish(surfaces *s)
{
    free(s->instance);
    free(s->triangle);
    lsf_distribution_finish(&s->area);
}

static surface_point surfaces_sample(const surfaces *s, const double u[2])
{
    double rest;
    uint64_t at = lsf_distribution_sample(&s->area, u[0], &rest);
    uint32_t material = s->state->instances[s->instance[at]].material;
    lsf_placed_triangle placed =
        lsf_place_triangle(s->scene, s->state, s->instance[at], s->triangle[at]);
    float weights[3], position[3];
    lsf_sample_triangle((float)rest, (float)u[1], &weights[1], &weights[2]);
    weights[0] = 1.0f - weights[1] - weights[2];
    lsf_placed_triangle_point(&placed, weights, position);
    return (surface_point){
        .position = lsf_f3_load(position),
        .normal = lsf_f3((float)placed.normal[0], (float)placed.normal[1], (float)placed.normal[2]),
        .double_sided = s->state->animated.materials[material].double_sided,
    };
}

/* Light of the emitter's point that the point reflects, over the density of the emitter's point. */
static float reflected(const surface_point *point, const lsf_emitter_sample *emitter)
{
    float radiance = lsf_f3_luminance(lsf_f3_load(emitter->radiance));
    lsf_float3 to = lsf_f3_sub(lsf_f3_load(emitter->position), point->position);
    float squared = lsf_f3_dot(to, to);
    float at_point = lsf_f3_dot(to, point->normal);
    float at_emitter = -lsf_f3_dot(to, lsf_f3_load(emitter->normal));
    if (point->double_sided)
        at_point = fabsf(at_point);
    if (!(at_point > 0.0f) || !(at_emitter > 0.0f))
        return 0.0f;
    /* Divided by r^2 twice: r^4 may underflow to 0 where r^2 does not. */
    float share = (at_point / squared) * (at_emitter / squared) / (3.14159265f * emitter->density);
    return radiance * share;
}

static float reflected_of_all(const surface_point *point, const lsf_emitters *emitters,
                              uint32_t first)
{
    float sum = 0.0f;
    for (uint32_t i = first; i < first + EMITTERS_EACH; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(i, 1, bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        lsf_emitter_sample emitter = lsf_emitters_sample(emitters, u);
        sum += reflected(point, &emitter);
    }
    return sum / EMITTERS_EACH;
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float median_reflected(const surfaces *s, const lsf_emitters *emitters)
{
    float each[POINTS];
    for (uint32_t i = 0; i < POINTS; i++) {
        uint32_t bits[2];
        lsf_sobol_2d_bits(i, 0, bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        surface_point point = surfaces_sample(s, u);
        each[i] = reflected_of_all(&point, emitters, i * EMITTERS_EACH);
    }
    qsort(each, POINTS, sizeof *each, by_size);
    return each[POINTS / 2];
}

float lsf_emitted_light(const lsf_scene *scene, const lsf_state *state)
{
    surfaces all;
    lsf_emitters emitters = {0};
    float median = INFINITY;
    if (surfaces_init(&all, scene, state) && lsf_emitters_init(&emitters, scene, state))
        median = all.area.sum > 0.0 && emitters.power.sum > 0.0 ? median_reflected(&all, &emitters)
                                                                : 0.0f;
    lsf_emitters_finish(&emitters);
    surfaces_finish(&all);
    return median;
}
