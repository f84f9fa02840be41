/* Cones through the pyramid of voxels' radiance: the set that gathers a hemisphere, and how they
 * march. lib/voxel_cone.glsl is the shader's side. */
#ifndef LSF_FRAME_CONE_H
#define LSF_FRAME_CONE_H

#include "frame/iteration.h"
#include "frame/voxel_grid.h"
#include "plan/option.h"

typedef enum lsf_cone_sides {
    LSF_CONE_ISOTROPIC,   /* a texel looks the same from everywhere */
    LSF_CONE_ANISOTROPIC, /* a texel looks different from each of six directions */
} lsf_cone_sides;

typedef struct lsf_cone_params {
    int32_t count;    /* number that gathers a hemisphere */
    int32_t sides;    /* lsf_cone_sides */
    float offset;     /* distance of the start along the normal [voxels] */
    float step;       /* texels of the level that is read */
    float opacity;    /* factor on the opacity of texels, whose product is at most 1 */
    float distance;   /* reach of cones [half extents of the scene] */
    int32_t draws;    /* sides of voxels drawn by their radiance for each point, where sealed */
    int32_t emitters; /* points drawn on emissive surfaces for each point, where sealed */
    bool jitter;      /* elevations vary from iteration to iteration, each within its share */
    bool sealed;      /* cones are rays along their axis, which end where it meets a voxel */
    bool rotate;      /* the set is rotated from pixel to pixel */
} lsf_cone_params;

#define LSF_CONE_PARAMS_DEFAULTS                                                                   \
    .count = 6, .sides = LSF_CONE_ANISOTROPIC, .offset = 1.5f, .step = 1.0f, .opacity = 1.0f,      \
    .distance = 4.0f, .draws = 2, .emitters = 1, .jitter = true, .sealed = true, .rotate = true

#define LSF_CONE_OPTION_COUNT 11
extern const lsf_option_row lsf_cone_options[LSF_CONE_OPTION_COUNT];

/* Levels of radiance that cones read: one where they are sealed, as nothing marches then. */
uint32_t lsf_cone_levels(const lsf_cone_params *params);

/* Whether sides of voxels are drawn by their radiance. */
bool lsf_cone_draws(const lsf_cone_params *params);
/* Whether points on emissive surfaces are drawn. */
bool lsf_cone_emitters(const lsf_cone_params *params, const lsf_plan *plan);
/* Slices of radiance along z. Sealed cones distinguish the surface that they meet, and its side. */
uint32_t lsf_cone_slices(const lsf_cone_params *params);

/* The set about z: xyz is a unit direction, w the ratio of a cone's diameter to its length. Each
 * of `count` cones stands for an equal share of the cosine-weighted hemisphere. `elevation` in
 * [0, 1) says where in its share each lies. */
void lsf_cone_set(uint32_t count, float elevation, lsf_vec4 *cones);

/* Sets the uniforms of lib/voxel_cone.glsl and of a set for the program in use, and binds the
 * pyramid and, unless it is 0, the list of voxel_draw. */
void lsf_cone_bind(const lsf_cone_params *params, const lsf_voxel_grid *grid,
                   const lsf_iteration *iteration, GLuint radiance, GLuint draws);

/* Adds the switches of emission and of points on emitters to the current pass. */
void lsf_cone_emission_switches(lsf_plan *plan, const lsf_cone_params *params);

#endif
