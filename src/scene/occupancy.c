#include "scene/occupancy.h"

#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "scene/placed_triangle.h"

#define TRIANGLES_MAX ((uint64_t)1 << 24)
#define POINTS_MAX ((double)(1u << 25))

/* Parts that each edge of a triangle is divided into, for points at most `spacing` apart. */
static double parts_of(const lsf_placed_triangle *triangle, double spacing)
{
    double longest = 0.0;
    for (int i = 0; i < 3; i++) {
        const double *a = triangle->corners[i], *b = triangle->corners[(i + 1) % 3];
        longest = fmax(longest, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
    }
    return fmax(ceil(longest / spacing), 1.0);
}

static bool blocks_light(const lsf_material *material)
{
    return material->transmission == 0.0f && material->alpha_mode != LSF_ALPHA_BLEND;
}

static void take(lsf_occupancy *occupancy, lsf_float3 position)
{
    const float at[3] = {position.x - occupancy->origin.x, position.y - occupancy->origin.y,
                         position.z - occupancy->origin.z};
    size_t index = 0;
    for (int axis = 2; axis >= 0; axis--) {
        int cell = (int)(at[axis] / occupancy->cell);
        cell = cell < 0 ? 0 : cell >= LSF_OCCUPANCY_CELLS ? LSF_OCCUPANCY_CELLS - 1 : cell;
        index = index * LSF_OCCUPANCY_CELLS + (size_t)cell;
    }
    occupancy->taken[index] = 1;
}

static void visit_triangle(lsf_occupancy *occupancy, const lsf_placed_triangle *triangle,
                           uint32_t material, uint32_t parts, lsf_surface_visit visit, void *user)
{
    lsf_surface_point point = {.material = material,
                               .normal =
                                   lsf_f3((float)triangle->normal[0], (float)triangle->normal[1],
                                          (float)triangle->normal[2])};
    for (uint32_t i = 0; i < parts; i++) {
        for (uint32_t j = 0; i + j < parts; j++) {
            float b = ((float)i + 1.0f / 3.0f) / (float)parts;
            float c = ((float)j + 1.0f / 3.0f) / (float)parts, position[3];
            lsf_placed_triangle_point(triangle, (const float[]){1.0f - b - c, b, c}, position);
            point.position = lsf_f3_load(position);
            take(occupancy, point.position);
            visit(user, &point);
        }
    }
}

static uint64_t count_triangles(const lsf_scene *scene, const lsf_state *state)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < state->instance_count; i++)
        count += scene->primitives[state->instances[i].primitive].index_count / 3;
    return count;
}

/* Returns the number of points; visits them once `occupancy` has cells. */
static double visit_triangles(lsf_occupancy *occupancy, const lsf_scene *scene,
                              const lsf_state *state, lsf_surface_visit visit, void *user)
{
    double points = 0.0;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        if (instance->skipped || !blocks_light(&state->animated.materials[instance->material]))
            continue;
        uint32_t count = scene->primitives[instance->primitive].index_count / 3;
        for (uint32_t t = 0; t < count; t++) {
            lsf_placed_triangle triangle = lsf_place_triangle(scene, state, i, t);
            if (!(triangle.area > 0.0))
                continue;
            double parts = parts_of(&triangle, 0.5 * (double)occupancy->cell);
            points += 0.5 * parts * (parts + 1.0);
            if (occupancy->taken)
                visit_triangle(occupancy, &triangle, instance->material, (uint32_t)parts, visit,
                               user);
        }
    }
    return points;
}

bool lsf_occupancy_init(lsf_occupancy *occupancy, const lsf_scene *scene, const lsf_state *state,
                        lsf_surface_visit visit, void *user)
{
    float extent = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        extent = fmaxf(extent, state->bounds_max[axis] - state->bounds_min[axis]);
    *occupancy = (lsf_occupancy){.origin = lsf_f3_load(state->bounds_min),
                                 .cell = fmaxf(extent, 1e-6f) / LSF_OCCUPANCY_CELLS};
    if (count_triangles(scene, state) > TRIANGLES_MAX ||
        visit_triangles(occupancy, scene, state, NULL, NULL) > POINTS_MAX)
        return true;
    occupancy->taken = lsf_alloc(
        (size_t)LSF_OCCUPANCY_CELLS * LSF_OCCUPANCY_CELLS * LSF_OCCUPANCY_CELLS, sizeof(uint8_t));
    if (!occupancy->taken)
        return false;
    visit_triangles(occupancy, scene, state, visit, user);
    return true;
}

void lsf_occupancy_finish(lsf_occupancy *occupancy)
{
    free(occupancy->taken);
}

static bool is_taken(const lsf_occupancy *occupancy, const float cells[3])
{
    size_t index = 0;
    for (int axis = 2; axis >= 0; axis--) {
        if (!(cells[axis] >= 0.0f && cells[axis] < LSF_OCCUPANCY_CELLS))
            return false;
        index = index * LSF_OCCUPANCY_CELLS + (size_t)cells[axis];
    }
    return occupancy->taken[index];
}

/* Where the ray leaves the grid; negative when it does not come through. Cells. */
static float exit_of(const float start[3], const float direction[3])
{
    float exit = INFINITY;
    for (int axis = 0; axis < 3; axis++)
        if (direction[axis] != 0.0f)
            exit =
                fminf(exit, ((direction[axis] > 0.0f ? LSF_OCCUPANCY_CELLS : 0.0f) - start[axis]) /
                                direction[axis]);
    return exit;
}

bool lsf_occupancy_blocks(const lsf_occupancy *occupancy, lsf_float3 from, lsf_float3 direction,
                          float distance)
{
    const float skipped = 1.5f, step = 0.5f, per_cell = 1.0f / occupancy->cell;
    lsf_float3 relative = lsf_f3_scale(lsf_f3_sub(from, occupancy->origin), per_cell);
    const float start[3] = {relative.x, relative.y, relative.z};
    const float along[3] = {direction.x, direction.y, direction.z};
    float end = fminf(distance * per_cell - skipped, exit_of(start, along));
    for (float t = skipped; t < end; t += step) {
        const float cells[3] = {start[0] + t * along[0], start[1] + t * along[1],
                                start[2] + t * along[2]};
        if (is_taken(occupancy, cells))
            return true;
    }
    return false;
}
