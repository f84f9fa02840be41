/* Radiance from outside by direction: a direction's position on the map, and the radiance there.
 * Both the rasterised techniques and the reference look it up here. */
#ifndef LSF_SCENE_ENVIRONMENT_H
#define LSF_SCENE_ENVIRONMENT_H

#include "math/vector.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the members of lsf_environment that depend on the rotation, in degrees. */
void lsf_environment_rotate(lsf_environment *environment, float rotation);

/* Position of a unit direction on the map, u in [0, 1) around the horizon, v in [0, 1] from the
 * zenith. */
void lsf_environment_uv(const lsf_environment *environment, lsf_float3 direction, double *u,
                        double *v);

/* The unit direction at `u` around the horizon of the map, whose angle from the zenith has the
 * cosine `zenith_cosine`: cos(pi v) of a position (u, v). */
lsf_float3 lsf_environment_direction(const lsf_environment *environment, double u,
                                     double zenith_cosine);

/* Radiance from the unit `direction`: bilinear between texel centres, around the horizon without a
 * seam; (0, 0, 0) without an environment. */
lsf_float3 lsf_environment_radiance(const lsf_environment *environment, lsf_float3 direction);

/* Mean luminance of the bilinear radiance over the texel in column `x` and row `y`: it vanishes
 * only where the radiance does. */
float lsf_environment_texel_luminance(const lsf_environment *environment, uint32_t x, uint32_t y);

/* Solid angle of a cell in `row` of a grid of width x height cells over the map [sr]. */
double lsf_environment_cell_solid_angle(uint32_t width, uint32_t height, uint32_t row);

#ifdef __cplusplus
}
#endif
#endif
