#include "scene/reach.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/hierarchy.h"

static void add_point(lsf_state *state, const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        float at = (float)((point[axis] - state->center[axis]) * state->scale);
        if (!isfinite(at))
            continue;
        state->hull_min[axis] = fminf(state->hull_min[axis], at);
        state->hull_max[axis] = fmaxf(state->hull_max[axis], at);
    }
}

static void add_moment(lsf_state *state, const lsf_scene *scene, const lsf_pose *pose,
                       const double *worlds)
{
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const lsf_primitive *primitive = &pose->primitives[scene->instances[i].primitive];
        const double *world = lsf_pose_world(pose, scene, worlds, i);
        for (int corner = 0; corner < 8 && primitive->index_count > 0; corner++) {
            double point[3], placed[3];
            for (int axis = 0; axis < 3; axis++)
                point[axis] = (double)(corner & (1 << axis) ? primitive->bounds_max
                                                            : primitive->bounds_min)[axis];
            lsf_transform_point(world, point, placed);
            add_point(state, placed);
        }
    }
}

static bool update_hull(lsf_state *state, const lsf_scene *scene)
{
    bool known = state->hull_min[0] < state->hull_max[0];
    if (known && state->hull_edits == scene->edits.nodes)
        return true;
    double *worlds = lsf_alloc(scene->node_count, 16 * sizeof *worlds);
    lsf_pose pose = {0};
    bool enough = worlds != NULL;
    for (int axis = 0; axis < 3; axis++) {
        state->hull_min[axis] = INFINITY;
        state->hull_max[axis] = -INFINITY;
    }
    double first, last;
    uint32_t moments = lsf_scene_moments(scene, &first, &last);
    for (uint32_t i = 0; enough && i < moments; i++) {
        double time = lsf_moment(i, moments, first, last);
        lsf_scene_world_matrices(scene, time, worlds);
        enough = lsf_pose_update(&pose, scene, time, worlds);
        if (enough)
            add_moment(state, scene, &pose, worlds);
    }
    lsf_pose_finish(&pose);
    free(worlds);
    state->hull_edits = scene->edits.nodes;
    return enough;
}

bool lsf_state_update_reach(lsf_state *state, const lsf_scene *scene)
{
    memcpy(state->reach_min, state->bounds_min, sizeof state->reach_min);
    memcpy(state->reach_max, state->bounds_max, sizeof state->reach_max);
    if (!scene->requirements.moving || state->bounds_min[0] > state->bounds_max[0])
        return true;
    if (scene->channel_count > 0 && !update_hull(state, scene))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        float low = state->bounds_min[axis], high = state->bounds_max[axis];
        if (scene->channel_count > 0) {
            low = fminf(low, state->hull_min[axis]);
            high = fmaxf(high, state->hull_max[axis]);
        }
        state->reach_min[axis] = floorf(low / LSF_REACH_STEP) * LSF_REACH_STEP;
        state->reach_max[axis] = ceilf(high / LSF_REACH_STEP) * LSF_REACH_STEP;
    }
    return true;
}
