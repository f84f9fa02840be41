/* Where an iteration's ray-bundles go.
 *
 * An axis is used both ways, by points that face along it and against it. Uniform axes have the
 * density p_r = 1 / (2 pi). Under an environment map L they are drawn by its light (Tokuyoshi and
 * Ogaki 2012, section 3.3): p_r(w) = (L(w) + L(-w) + 2 L_u) / integral over the sphere of (L + L_u)
 * with L its luminance averaged over cells as fine as its texels, so that the density is the same
 * number here and in the shaders, and L_u `environment_offset` times its mean, which stands for
 * light that comes from elsewhere. */
#ifndef LSF_TECHNIQUES_BUNDLE_DIRECTIONS_H
#define LSF_TECHNIQUES_BUNDLE_DIRECTIONS_H

#include "math/distribution.h"
#include "passes/ray_bundle.h"

typedef struct lsf_bundle_directions {
    uint32_t width, height; /* cells around the horizon, an even number, so that the opposite of a
                             * cell is a cell; and from pole to pole; 0: uniform */
    float *pdf;             /* p_r of each cell, rows from the zenith */
    lsf_distribution_2d cells;
} lsf_bundle_directions;

/* Lists "bundle.pdf", the texture that lib/bundle_pdf.glsl reads, where the environment is a map.
 */
void lsf_bundle_directions_plan(lsf_plan *plan);
/* False without memory, which `error` says; nothing is left to finish then. */
bool lsf_bundle_directions_init(lsf_bundle_directions *directions,
                                const lsf_environment *environment, float environment_offset,
                                lsf_error *error);
void lsf_bundle_directions_finish(lsf_bundle_directions *directions);

/* Draws `count` axes. All bundles of all iterations are one sequence (see lsf_iteration_sample),
 * unless they are to be `independent` of each other, as paths along several of them need: then each
 * number has its own. */
void lsf_bundle_directions_draw(const lsf_bundle_directions *directions,
                                const lsf_iteration *iteration, uint32_t count, bool independent,
                                lsf_ray_bundle_direction *drawn);
/* p_r of a unit direction. */
float lsf_bundle_directions_pdf(const lsf_bundle_directions *directions, lsf_float3 direction);

#endif
