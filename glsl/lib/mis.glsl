/* How the two strategies share a path. Equations are of Tokuyoshi and Ogaki 2012. */
#ifndef LSF_LIB_MIS
#define LSF_LIB_MIS

#include "shared/scene_data.h"

/* x: VPLs that the vertex is connected to, y: bundles it is continued through (0: that strategy is
 * not in use), z: exponent beta of the power heuristic, w: what a sample counts for, one over the
 * number of samples of the strategy at hand. */
layout(location = LSF_LOCATION_STRATEGY) uniform vec4 strategy;
/* x: m' over the iterations that the picture will have, 0: no suppression; y: squared distance below
 * which 1/d^2 is held, times the density of VPLs by area, 0: never; z: m'/d of the samples that came to the vertex from the one before,
 * 0 for the eye's pinhole; w: probability of having picked the light in turn. */
layout(location = LSF_LOCATION_SUPPRESSION) uniform vec4 suppression;

/* Densities, by area, with which x_j is found between x0 and x3: as a VPL, and as a bundle's hit.
 * Both are equations 4 and 5 with the geometry term, common to both, divided out. */
struct path_density {
    float vpl, bundle;
};

/* `cosine_0`, `cosine_3`: between x_j's geometric normal and the directions to x0 and x3;
 * `distance2_`: squared distances to them; p_e, p_r: densities of emission and of bundles [1/sr]. */
path_density path_density_at(float cosine_0, float distance2_0, float cosine_3, float distance2_3,
                             float p_e, float p_r)
{
    path_density p;
    p.vpl = strategy.x * p_e * cosine_0 / distance2_0;
    p.bundle = strategy.y * p_r * cosine_3 / distance2_3;
    return p;
}

/* Of a point x_j that emits itself, and is found from x3 alone: `by_area`, with which a VPL is placed
 * there. */
path_density emitter_density_at(float by_area, float cosine_3, float distance2_3, float p_r)
{
    path_density p;
    p.vpl = strategy.x * by_area;
    p.bundle = strategy.y * p_r * cosine_3 / distance2_3;
    return p;
}

/* Power heuristic (equation 6) by the ratio of densities, which cannot overflow to inf / inf; the ratio
 * keeps a finite logarithm, for pow multiplies that by beta, which may be 0. */
float mis_weight(float density, float other)
{
    return density > 0.0 ? 1.0 / (1.0 + pow(clamp(other / density, 1e-30, 1e30), strategy.z)) : 0.0;
}

/* m'/d towards a vertex: as x_j moves over its surface, with this density by area, its direction
 * sweeps a solid angle of cosine / distance2 for each area. At x3 that is the whole kernel; at x_j
 * those of its two sides add up (equations 13 and 15 to 17). */
float suppression_kernel(float density, float cosine, float distance2)
{
    return density > 0.0 ? suppression.x * cosine / (distance2 * density) : 0.0;
}

#endif
