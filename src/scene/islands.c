#include "scene/islands.h"

#include <math.h>
#include <string.h>

/* Number of slabs that a part is divided into along each axis. */
#define SLABS 256

/* Number of empty slabs in a row at which a part is divided. Fewer would gain little. */
#define WIDE_ENOUGH (SLABS / 4)

/* A part of the scene: the triangles within a region of space, whose border no triangle crosses,
 * and their bounds. */
typedef struct part {
    float region[6], bounds[6];
} part;

/* For the slabs across each axis: the number of triangles that begin in a slab less the number
 * that end in the one before. */
typedef struct slab_counts {
    int64_t changes[3][SLABS + 1];
} slab_counts;

typedef void part_visit(part *p, const float triangle[6], void *user);

static bool inside(const float outer[6], const float inner[6])
{
    for (int axis = 0; axis < 3; axis++)
        if (inner[axis] < outer[axis] || inner[3 + axis] > outer[3 + axis])
            return false;
    return true;
}

static void extend(part *p, const float triangle[6], void *unused)
{
    (void)unused;
    for (int axis = 0; axis < 3; axis++) {
        p->bounds[axis] = fminf(p->bounds[axis], triangle[axis]);
        p->bounds[3 + axis] = fmaxf(p->bounds[3 + axis], triangle[3 + axis]);
    }
}

static uint32_t slab_at(const part *p, int axis, float at)
{
    float low = p->bounds[axis], length = p->bounds[3 + axis] - low;
    float slab = length > 0.0f ? (at - low) / length * (float)SLABS : 0.0f;
    return slab >= (float)(SLABS - 1) ? SLABS - 1 : slab > 0.0f ? (uint32_t)slab : 0;
}

static void count(part *p, const float triangle[6], void *user)
{
    slab_counts *counts = user;
    for (int axis = 0; axis < 3; axis++) {
        counts->changes[axis][slab_at(p, axis, triangle[axis])]++;
        counts->changes[axis][slab_at(p, axis, triangle[3 + axis]) + 1]--;
    }
}

static void bound_triangle(const lsf_state *state, const lsf_instance_state *instance,
                           const uint32_t corners[3], float bounds[6])
{
    const float *m = instance->transform;
    for (int axis = 0; axis < 3; axis++) {
        bounds[axis] = INFINITY;
        bounds[3 + axis] = -INFINITY;
    }
    for (int i = 0; i < 3; i++) {
        const float *p = state->pose.vertices.position + 3 * (size_t)corners[i];
        for (int axis = 0; axis < 3; axis++) {
            const float *row = m + 4 * axis;
            float at = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
            bounds[axis] = fminf(bounds[axis], at);
            bounds[3 + axis] = fmaxf(bounds[3 + axis], at);
        }
    }
}

static void visit(part *p, const lsf_scene *scene, const lsf_state *state, part_visit *triangle,
                  void *user)
{
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        const lsf_primitive *primitive = &scene->primitives[instance->primitive];
        const uint32_t *indices = scene->indices + primitive->first_index;
        float bounds[6];
        if (scene->requirements.moving && !instance->skipped) {
            memcpy(bounds, instance->bounds_min, sizeof instance->bounds_min);
            memcpy(bounds + 3, instance->bounds_max, sizeof instance->bounds_max);
            if (inside(p->region, bounds))
                triangle(p, bounds, user);
            continue;
        }
        for (uint32_t k = 0; !instance->skipped && k + 2 < primitive->index_count; k += 3) {
            bound_triangle(state, instance, indices + k, bounds);
            if (inside(p->region, bounds))
                triangle(p, bounds, user);
        }
    }
}

static void set_box(float box[6], float low, float high)
{
    for (int axis = 0; axis < 3; axis++) {
        box[axis] = low;
        box[3 + axis] = high;
    }
}

static void bound(part *p, const lsf_scene *scene, const lsf_state *state)
{
    set_box(p->bounds, INFINITY, -INFINITY);
    visit(p, scene, state, extend, NULL);
}

/* The middle of the longest run of empty slabs along any axis. False: no run is wide enough. */
static bool widest_gap(const part *p, const slab_counts *counts, int *across, float *middle)
{
    uint32_t widest = WIDE_ENOUGH - 1;
    for (int axis = 0; axis < 3; axis++) {
        int64_t here = 0;
        uint32_t run = 0;
        float low = p->bounds[axis], length = p->bounds[3 + axis] - low;
        for (uint32_t slab = 0; slab < SLABS && length > 0.0f; slab++) {
            here += counts->changes[axis][slab];
            run = here == 0 ? run + 1 : 0;
            if (run <= widest)
                continue;
            widest = run;
            *across = axis;
            *middle = low + length * ((float)(slab + 1) - 0.5f * (float)run) / (float)SLABS;
        }
    }
    return widest >= WIDE_ENOUGH;
}

/* Leaves in `p` the triangles before the widest gap, and moves the others to `beyond`. */
static bool divide(part *p, part *beyond, const lsf_scene *scene, const lsf_state *state)
{
    slab_counts counts = {0};
    int across = 0;
    float middle = 0.0f;
    visit(p, scene, state, count, &counts);
    if (!widest_gap(p, &counts, &across, &middle))
        return false;
    *beyond = *p;
    p->region[3 + across] = beyond->region[across] = middle;
    bound(p, scene, state);
    bound(beyond, scene, state);
    return true;
}

void lsf_islands_find(lsf_islands *islands, const lsf_scene *scene, const lsf_state *state)
{
    part parts[LSF_ISLANDS_MAX];
    islands->count = 0;
    if (state->bounds_min[0] > state->bounds_max[0])
        return;
    set_box(parts[0].region, -INFINITY, INFINITY);
    bound(&parts[0], scene, state);
    islands->count = 1;
    for (uint32_t i = 0; i < islands->count; i++)
        while (islands->count < LSF_ISLANDS_MAX &&
               divide(&parts[i], &parts[islands->count], scene, state))
            islands->count++;
    for (uint32_t i = 0; i < islands->count; i++)
        memcpy(islands->bounds[i], parts[i].bounds, sizeof parts[i].bounds);
}

void lsf_island_bounds_along(const float bounds[6], lsf_float3 axis, float *low, float *high)
{
    const float along[3] = {axis.x, axis.y, axis.z};
    *low = *high = 0.0f;
    for (int i = 0; i < 3; i++) {
        float a = along[i] * bounds[i], b = along[i] * bounds[3 + i];
        *low += fminf(a, b);
        *high += fmaxf(a, b);
    }
}
