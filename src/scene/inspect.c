/* Queries of a scene by a program: the hierarchy of nodes, their transforms, and rays. */
#include <lightsheaf/edit.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"
#include "scene/hierarchy.h"
#include "scene/placed_triangle.h"

static bool check_node(const lsf_scene *scene, uint32_t node, lsf_error *error)
{
    return lsf_scene_given(scene, error) &&
           (node < scene->node_count ||
            lsf_error_set(error, LSF_ERROR_USAGE, "node %u does not exist: the scene has %u", node,
                          scene->node_count));
}

bool lsf_scene_get_node_info(const lsf_scene *scene, uint32_t node, lsf_node_info *info,
                             lsf_error *error)
{
    if (!check_node(scene, node, error) || !lsf_given(info, "info", error))
        return false;
    const lsf_node *n = &scene->nodes[node];
    *info = (lsf_node_info){n->parent, n->mesh, n->light, n->camera};
    return true;
}

bool lsf_scene_get_node_world(const lsf_scene *scene, uint32_t node, double time, double matrix[16],
                              lsf_error *error)
{
    if (!check_node(scene, node, error) || !lsf_given(matrix, "matrix", error))
        return false;
    double *worlds = lsf_alloc(scene->node_count, 16 * sizeof(double));
    if (!worlds)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u nodes",
                             scene->node_count);
    lsf_scene_world_matrices(scene, time, worlds);
    memcpy(matrix, worlds + 16 * (size_t)node, 16 * sizeof(double));
    free(worlds);
    return true;
}

/* --- rays --- */

typedef struct ray {
    double origin[3], direction[3]; /* normalised space; unit */
} ray;

/* The distance at which a ray enters a box; infinity: it misses. */
static double meet_box(const ray *r, const float low[3], const float high[3])
{
    double enter = 0.0, leave = INFINITY;
    for (int i = 0; i < 3; i++) {
        double a = ((double)low[i] - r->origin[i]) / r->direction[i];
        double b = ((double)high[i] - r->origin[i]) / r->direction[i];
        if (r->direction[i] == 0.0) { /* a division would give NaN where the ray grazes the box */
            bool within = r->origin[i] >= (double)low[i] && r->origin[i] <= (double)high[i];
            a = within ? -INFINITY : INFINITY;
            b = within ? INFINITY : -INFINITY;
        }
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    return enter <= leave ? enter : INFINITY;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* T. Moeller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997. */
static double meet_triangle(const ray *r, const double corners[3][3])
{
    double a[3], b[3], to[3], p[3], q[3];
    for (int i = 0; i < 3; i++) {
        a[i] = corners[1][i] - corners[0][i];
        b[i] = corners[2][i] - corners[0][i];
        to[i] = r->origin[i] - corners[0][i];
    }
    cross(r->direction, b, p);
    double determinant = dot(a, p);
    if (determinant == 0.0)
        return INFINITY;
    double u = dot(to, p) / determinant;
    cross(to, a, q);
    double v = dot(r->direction, q) / determinant, t = dot(b, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 ? t : INFINITY;
}

static void set_hit(lsf_hit *hit, const lsf_scene *scene, const lsf_state *state, uint32_t instance,
                    uint32_t triangle, const ray *r, double distance)
{
    const lsf_placed_triangle placed = lsf_place_triangle(scene, state, instance, triangle);
    double side = dot(placed.normal, r->direction) > 0.0 ? -1.0 : 1.0;
    hit->node = scene->instances[instance].node;
    hit->material = state->instances[instance].material;
    hit->distance = distance;
    for (int i = 0; i < 3; i++)
        hit->normal[i] = (float)(side * placed.normal[i]);
}

static void find(lsf_hit *hit, const lsf_scene *scene, const lsf_state *state, const ray *r)
{
    double nearest = INFINITY;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        if (instance->skipped ||
            !(meet_box(r, instance->bounds_min, instance->bounds_max) < nearest))
            continue;
        uint32_t triangles = scene->primitives[instance->primitive].index_count / 3;
        for (uint32_t k = 0; k < triangles; k++) {
            const lsf_placed_triangle placed = lsf_place_triangle(scene, state, i, k);
            double distance = meet_triangle(r, placed.corners);
            if (distance < nearest) {
                nearest = distance;
                set_hit(hit, scene, state, i, k, r, distance);
            }
        }
    }
}

bool lsf_scene_trace(const lsf_scene *scene, double time, const double origin[3],
                     const double direction[3], lsf_hit *hit, lsf_error *error)
{
    static const lsf_view anywhere = {
        .forward = {0.0f, 0.0f, -1.0f}, .up = {0.0f, 1.0f, 0.0f}, .fov_y = 45.0f};
    if (!lsf_scene_given(scene, error) || !lsf_given(origin, "origin", error) ||
        !lsf_given(direction, "direction", error) || !lsf_given(hit, "hit", error))
        return false;
    double length = sqrt(dot(direction, direction));
    if (!(length > 0.0) || !isfinite(length + origin[0] + origin[1] + origin[2]))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "a ray's origin and direction must be finite, and not 0");
    lsf_view view = anywhere;
    memcpy(view.position, scene->requirements.center, sizeof view.position);
    const lsf_view_params params = {.time = time, .view = &view, .aspect = 1.0f};
    lsf_state state = {0};
    bool good = lsf_state_update(&state, scene, &params, error);
    *hit = (lsf_hit){.node = LSF_NONE, .material = LSF_NONE};
    if (good) {
        ray r;
        for (int i = 0; i < 3; i++) {
            r.origin[i] = (origin[i] - state.center[i]) * state.scale;
            r.direction[i] = direction[i] / length;
        }
        find(hit, scene, &state, &r);
        hit->distance /= state.scale;
        for (int i = 0; i < 3 && hit->node != LSF_NONE; i++)
            hit->position[i] = origin[i] + hit->distance * r.direction[i];
    }
    lsf_state_finish(&state);
    return good;
}
