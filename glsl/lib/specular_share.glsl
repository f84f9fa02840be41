/* Specular lobes that paths through voxels gather. Other samples would widen them: where a lobe is narrower than the
 * samples of a picture can show, paths that begin along it take over. Switch LSF_SPECULAR_PATHS, those of lib/brdf.glsl. */
#ifndef LSF_LIB_SPECULAR_SHARE
#define LSF_LIB_SPECULAR_SHARE

#include "lib/brdf.glsl"
#include "shared/scene_data.h"

/* Twice the alpha to which the kernel would widen a lobe that reflects so much, seen under the cosine nv, over its own. */
float widened_twice(float kernel, float alpha, float reflects, float nv)
{
    return 2.0 * kernel_alpha(kernel, reflects, sqrt(mix(nv * nv, 1.0, alpha * alpha))) / alpha;
}

/* Share that paths have of a lobe: all if the kernel would widen it, nothing if it is twice as wide as that. */
float narrow_share(float twice)
{
    return clamp(twice - 1.0, 0.0, 1.0);
}

/* Cosine between a view that is lifted to the horizon and the normal. */
float lifted_cosine(vec3 view, vec3 normal)
{
    return max(dot(normal, lift_to_horizon(view, normal)), LSF_COSINE_MIN);
}

#if LSF_SPECULAR_PATHS
/* Solid angle over which the other samples spread a lobe that reflects all light [sr], as in brdf_evaluate. */
layout(location = LSF_LOCATION_SPECULAR_SHARE) uniform float lobe_kernel;

/* widened_twice of a visible point's narrower lobe; 0: paths have no share. */
float lobe_widened_twice(surface s, vec3 view)
{
#if LSF_SCATTER
    if (s.through)
        return 0.0;
#endif
    float nv = lifted_cosine(view, s.normal), alpha = lsf_alpha_from_roughness(s.roughness);
    float twice = widened_twice(lobe_kernel, alpha, largest(surface_specular_fresnel(s, nv)), nv);
#if LSF_COAT
    float coat_nv = lifted_cosine(view, s.coat_normal);
    twice = max(twice, widened_twice(lobe_kernel, lsf_alpha_from_roughness(s.coat_roughness),
                                     s.coat * lsf_fresnel_schlick(LSF_COAT_F0, coat_nv), coat_nv));
#endif
    return twice;
}

/* Share that paths have of the specular light that surfaces send to a visible point. */
float specular_paths_share(surface s, vec3 view)
{
    return narrow_share(lobe_widened_twice(s, view));
}

/* Share that rays have of light of the environment that one direction finds with this density [1/sr]: directions by
 * radiance are closer where it is bright, and widen lobes less. `twice`: lobe_widened_twice, where the kernel is that of
 * directions drawn uniformly. */
float narrow_sky_share(float twice, float density)
{
    return narrow_share(twice * inversesqrt(4.0 * LSF_PI * max(density, 1e-30)));
}
#endif

#endif
