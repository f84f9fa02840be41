/* Weight of directions drawn by the environment's radiance at a visible point where rays drawn by the BRDF find
 * the environment, too. Switch LSF_SKY_CHANCE, lsf_sky_chance; those of lib/brdf_sample.glsl. */
#ifndef LSF_LIB_SKY_CHANCE
#define LSF_LIB_SKY_CHANCE

#if LSF_SKY_CHANCE
#include "lib/brdf_sample.glsl"
#include "shared/scene_data.h"

#define LSF_SKY_CHANCE_PATHS 1
#define LSF_SKY_CHANCE_LOBES 2

/* Range of the number of paths, or rays, of a pixel, as in surface_path_count. */
layout(location = LSF_LOCATION_SKY_CHANCE) uniform vec2 sky_paths;

/* Weights light of the environment from a direction that is drawn with `density`. */
void share_sky(surface s, vec3 view_direction, vec3 direction, float density, inout brdf_value f)
{
    float count = surface_path_count(s, sky_paths);
    brdf_sampler p = brdf_sampler_of(s, view_direction, true);
#if LSF_SKY_CHANCE == LSF_SKY_CHANCE_PATHS
    float left = density / (density + count * brdf_pdf(p, direction));
    f.diffuse *= left;
    f.specular *= left;
#else
    f.diffuse *= density / (density + count * dot(s.normal, direction) / LSF_PI);
#if LSF_SPECULAR && LSF_SKY_CHANCE == LSF_SKY_CHANCE_LOBES
    p.specular = 1.0;
    f.specular *= density / (density + brdf_pdf(p, direction));
#else
    f.specular = vec3(0.0);
#endif
#endif
}
#endif

#endif
