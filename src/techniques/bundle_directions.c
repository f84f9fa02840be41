#include "techniques/bundle_directions.h"

#include "math/sampling.h"
#include "shared/brdf.h"

#define PURPOSE_DIRECTION 0x30000

void lsf_bundle_directions_draw(const lsf_iteration *iteration, uint32_t count, bool independent,
                                lsf_ray_bundle_direction *directions)
{
    for (uint32_t i = 0; i < count; i++) {
        float point[2];
        uint32_t index = independent ? iteration->index : iteration->index * count + i;
        uint32_t purpose = PURPOSE_DIRECTION + (independent ? i : 0);
        lsf_sobol_2d(index, lsf_iteration_seed(iteration, purpose), point);
        lsf_f3_store(directions[i].direction, lsf_sample_sphere(point[0], point[1]));
        directions[i].pdf = 0.5f / LSF_PI;
    }
}
