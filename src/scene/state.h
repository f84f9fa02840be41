/* The scene at one instant, in normalised space: what the passes and the reference render.
 *
 * Normalised space is the scene moved to its centre in double precision and scaled by a power of
 * two so that its largest half extent lies in (0.5, 1]. Radiance is unchanged: point and spot
 * intensities are scaled by the square, directional ones not at all. A scene scaled by a power of
 * two thus gives the same bits, and every epsilon is relative to the scene. */
#ifndef LSF_SCENE_STATE_H
#define LSF_SCENE_STATE_H

#include "math/vector.h"
#include "scene/animated.h"
#include "scene/pose.h"
#include "scene/scene.h"
#include <lightsheaf/renderer.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_instance_state {
    float transform[12];       /* rows of the 3x4 object-to-normalised matrix */
    float normal_transform[9]; /* rows of its inverse transpose, scaled to keep floats in range;
                                * normals need normalising after it */
    uint32_t primitive;
    uint32_t material;
    bool mirrored; /* negative determinant: the winding flips */
    bool skipped;  /* the transform collapses it, or its node is hidden: nothing to draw */
    float bounds_min[3], bounds_max[3]; /* normalised space */
} lsf_instance_state;

typedef struct lsf_light_state {
    lsf_light_type type;
    float position[3];          /* normalised space */
    float direction[3];         /* unit, the way the light shines */
    float tangent[3];           /* unit, perpendicular to direction */
    float intensity[3];         /* point, spot: W/sr in normalised units; directional: W/m^2 */
    float range;                /* normalised units; INFINITY: none */
    float cos_inner, cos_outer; /* spot only */
} lsf_light_state;

/* At ndc (x right, y up, -1..1) a view ray runs along forward + x * forward_dx + y * forward_dy
 * (not normalised: its view depth is 1) and passes start + x * start_dx + y * start_dy at view
 * depth start_depth. That is where the camera is, at depth 0, unless it is so far off that its
 * position could not be told from its neighbours' in floats: then it is the far plane, right behind
 * the scene. */
typedef struct lsf_camera_state {
    bool orthographic;
    float start[3], start_dx[3], start_dy[3], start_depth;
    float forward[3], forward_dx[3], forward_dy[3];
    float near_plane, far_plane; /* view depths less start_depth; far INFINITY: none */
} lsf_camera_state;

typedef struct lsf_state {
    uint32_t instance_count, light_count;
    lsf_instance_state *instances; /* index as in scene->instances */
    lsf_pose pose;                 /* their vertices */
    lsf_animated animated;         /* materials, and what lights are made of */
    lsf_light_state *lights;       /* one for each node that carries a light, then those added by
                                    * default: the key light, the lamp */
    lsf_camera_state camera;
    lsf_view view;                      /* the same, as a program would place it */
    float bounds_min[3], bounds_max[3]; /* normalised space; min > max when empty */
    float reach_min[3], reach_max[3];   /* what the bounds stay within while animations play */
    double center[3], scale;
    /* Of the last update: node to scene, 16 of each node; its time; what was edited by then. */
    double *worlds;
    double time;
    lsf_edits edits;
    lsf_camera framed; /* that was found for `framed_aspect` and edited nodes; 0: none was */
    float framed_aspect;
    uint64_t framed_edits;
    float hull_min[3], hull_max[3]; /* of all moments, for as many edited nodes */
    uint64_t hull_edits;
} lsf_state;

typedef struct lsf_view_params {
    double time;                    /* seconds */
    const struct lsf_view *view;    /* replaces all below but the aspect; NULL: they count */
    const char *camera;             /* name or index; NULL: the first */
    const float *position, *target; /* scene units, three floats; NULL: the camera's own */
    float fov_y;                    /* degrees; NAN: the camera's own */
    float aspect; /* width / height of the picture; the vertical field of view is kept */
} lsf_view_params;

/* Evaluates animations, the hierarchy and the camera; of what has neither moved nor been edited
 * since the last call, nothing. Reuses the arrays in `state`, which must be zeroed before the first
 * call and go with one scene. LSF_ERROR_USAGE when the camera does not exist, or cannot be. */
bool lsf_state_update(lsf_state *state, const lsf_scene *scene, const lsf_view_params *params,
                      lsf_error *error);
/* Bounds of the scene along three axes; false, and nothing set, when it is empty. */
bool lsf_state_bounds_along(const lsf_state *state, const lsf_float3 axes[3], float low[3],
                            float high[3]);
void lsf_state_finish(lsf_state *state);

/* Radiant power of a light, up to a common factor: how often it is to be picked. A directional
 * light is taken over the disc that bounds normalised space. */
float lsf_light_power(const lsf_light_state *light);

#ifdef __cplusplus
}
#endif
#endif
