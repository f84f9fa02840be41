#include "scene/placed_triangle.h"

#include <math.h>

static void place_corners(const lsf_scene *scene, const lsf_state *state, uint32_t index,
                          uint32_t triangle, double corners[3][3])
{
    const lsf_instance_state *instance = &state->instances[index];
    const lsf_primitive *primitive = &scene->primitives[instance->primitive];
    const uint32_t *indices = scene->indices + primitive->first_index + 3 * (uint64_t)triangle;
    const float *m = instance->transform;
    for (int i = 0; i < 3; i++) {
        const float *v = state->pose.vertices.position + 3 * (uint64_t)indices[i];
        for (int row = 0; row < 3; row++)
            corners[i][row] = (double)m[4 * row] * v[0] + (double)m[4 * row + 1] * v[1] +
                              (double)m[4 * row + 2] * v[2] + m[4 * row + 3];
    }
}

lsf_placed_triangle lsf_place_triangle(const lsf_scene *scene, const lsf_state *state,
                                       uint32_t instance, uint32_t triangle)
{
    lsf_placed_triangle placed;
    place_corners(scene, state, instance, triangle, placed.corners);
    double a[3], b[3], *n = placed.normal;
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = placed.corners[1][axis] - placed.corners[0][axis];
        b[axis] = placed.corners[2][axis] - placed.corners[0][axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        n[axis] = a[next] * b[last] - a[last] * b[next];
    }
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double sign = state->instances[instance].mirrored ? -1.0 : 1.0;
    for (int axis = 0; axis < 3 && length > 0.0; axis++)
        n[axis] *= sign / length;
    placed.area = 0.5 * length;
    return placed;
}

void lsf_placed_triangle_point(const lsf_placed_triangle *triangle, const float weights[3],
                               float position[3])
{
    for (int axis = 0; axis < 3; axis++) {
        double at = 0.0;
        for (int i = 0; i < 3; i++)
            at += (double)weights[i] * triangle->corners[i][axis];
        position[axis] = (float)at;
    }
}
