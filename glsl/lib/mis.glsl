/* Multiple importance sampling of the two strategies that find a path. Equations are those of Tokuyoshi and Ogaki
 * 2012. */
#ifndef LSF_LIB_MIS
#define LSF_LIB_MIS

#include "shared/scene_data.h"

/* x: number of VPLs that the vertex is connected to; y: number of bundles that continue it (0: that strategy is
 * not in use); z: exponent beta of the power heuristic; w: weight of a sample, one over the number of samples of
 * the current strategy. */
layout(location = LSF_LOCATION_STRATEGY) uniform vec4 strategy;
/* x: m' over the iterations that the picture will have, 0: no suppression; y: squared distance below which 1/d^2
 * is clamped, times the density of VPLs by area, 0: never; z: m'/d of the samples that reached the vertex from the
 * one before, 0 for the eye's pinhole; w: probability of having chosen the current light. */
layout(location = LSF_LOCATION_SUPPRESSION) uniform vec4 suppression;

/* Densities by area of x_j between x0 and x3: as a VPL, and as the hit of a bundle. Both are equations 4 and 5
 * with the common geometry term divided out. */
struct path_density {
    float vpl, bundle;
};

/* `cosine_0`, `cosine_3`: between the geometric normal of x_j and the directions to x0 and x3; `distance2_`:
 * squared distances to them; p_e, p_r: densities of emission and of bundles [1/sr]. */
path_density path_density_at(float cosine_0, float distance2_0, float cosine_3, float distance2_3,
                             float p_e, float p_r)
{
    path_density p;
    p.vpl = strategy.x * p_e * cosine_0 / distance2_0;
    p.bundle = strategy.y * p_r * cosine_3 / distance2_3;
    return p;
}

/* The same for a point x_j that emits light itself and is found from x3 alone; `by_area`: density with which a VPL
 * is placed there. */
path_density emitter_density_at(float by_area, float cosine_3, float distance2_3, float p_r)
{
    path_density p;
    p.vpl = strategy.x * by_area;
    p.bundle = strategy.y * p_r * cosine_3 / distance2_3;
    return p;
}

/* Power heuristic (equation 6) from the ratio of the densities, which cannot overflow to inf / inf. The ratio is
 * bounded so that its logarithm is finite: pow multiplies that by beta, which may be 0. */
float mis_weight(float density, float other)
{
    return density > 0.0 ? 1.0 / (1.0 + pow(clamp(other / density, 1e-30, 1e30), strategy.z)) : 0.0;
}

/* m'/d towards a vertex: as x_j moves over its surface with this density by area, its direction sweeps a solid
 * angle of cosine / distance2 per area. At x3 that is the whole kernel. */
float suppression_kernel(float density, float cosine, float distance2)
{
    return density > 0.0 ? suppression.x * cosine / (distance2 * density) : 0.0;
}

/* The kernel at x_j, where those of its two sides add up (equations 13 and 15 to 17). */
float hidden_kernel(float kernel_0, float kernel_3)
{
    return (kernel_0 + kernel_3) * LSF_HIDDEN_KERNEL;
}

#endif
