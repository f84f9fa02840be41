#include "scene/seen.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"

typedef struct picture {
    const lsf_scene *scene;
    const lsf_state *state;
    lsf_seen_point *pixels; /* depth INFINITY: none */
} picture;

/* The coordinate in ndc that has `axis` as its unit, of a vector from the picture's centre. */
static float ndc(lsf_float3 across, const float axis[3])
{
    lsf_float3 a = lsf_f3_load(axis);
    return lsf_f3_dot(across, a) / lsf_f3_dot(a, a);
}

static bool hides_back(const picture *p, uint32_t material)
{
    return !p->state->animated.materials[material].double_sided && !p->scene->show_back_faces;
}

/* Keeps the point where it is the nearest that its pixel shows. */
static void see(void *user, const lsf_surface_point *point)
{
    picture *p = user;
    const lsf_camera_state *camera = &p->state->camera;
    lsf_float3 forward = lsf_f3_load(camera->forward);
    lsf_float3 from = lsf_f3_sub(point->position, lsf_f3_load(camera->start));
    float beyond = lsf_f3_dot(from, forward), depth = camera->start_depth + beyond;
    if (!(beyond > camera->near_plane))
        return;
    bool parallel = camera->orthographic;
    float scale = parallel ? 1.0f : 1.0f / depth;
    float x = scale * ndc(from, parallel ? camera->start_dx : camera->forward_dx);
    float y = scale * ndc(from, parallel ? camera->start_dy : camera->forward_dy);
    /* Bounds are checked after all rounding. */
    float column = (0.5f * x + 0.5f) * LSF_SEEN_SIDE, row = (0.5f * y + 0.5f) * LSF_SEEN_SIDE;
    if (!(column >= 0.0f && column < LSF_SEEN_SIDE && row >= 0.0f && row < LSF_SEEN_SIDE))
        return;
    lsf_seen_point *pixel = &p->pixels[(int)row * LSF_SEEN_SIDE + (int)column];
    lsf_float3 ray = parallel ? forward : lsf_f3_mad(from, forward, camera->start_depth);
    bool back = lsf_f3_dot(ray, point->normal) > 0.0f;
    if (depth < pixel->depth && !(back && hides_back(p, point->material)))
        *pixel = (lsf_seen_point){.depth = depth,
                                  .position = point->position,
                                  .normal = lsf_f3_scale(point->normal, back ? -1.0f : 1.0f),
                                  .material = point->material};
}

lsf_seen *lsf_seen_create(const lsf_scene *scene, const lsf_state *state)
{
    lsf_seen *seen = lsf_alloc(1, sizeof *seen);
    if (!seen)
        return NULL;
    for (uint32_t i = 0; i < LSF_SEEN_SIDE * LSF_SEEN_SIDE; i++)
        seen->points[i].depth = INFINITY;
    picture p = {.scene = scene, .state = state, .pixels = seen->points};
    if (!lsf_occupancy_init(&seen->occupancy, scene, state, see, &p)) {
        lsf_seen_free(seen);
        return NULL;
    }
    for (uint32_t i = 0; i < LSF_SEEN_SIDE * LSF_SEEN_SIDE; i++)
        if (!isinf(seen->points[i].depth))
            seen->points[seen->count++] = seen->points[i];
    return seen;
}

void lsf_seen_free(lsf_seen *seen)
{
    if (!seen)
        return;
    lsf_occupancy_finish(&seen->occupancy);
    free(seen);
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

float lsf_seen_median(float *values, uint32_t count)
{
    qsort(values, count, sizeof *values, by_size);
    return values[count / 2];
}
