/* Specular lobes that paths through voxels gather. Other samples would widen them: where a lobe is narrower than the
 * samples of a picture can show, paths that begin along it take over. Switch LSF_SPECULAR_PATHS, those of lib/brdf.glsl. */
#ifndef LSF_LIB_SPECULAR_SHARE
#define LSF_LIB_SPECULAR_SHARE

#include "lib/brdf.glsl"
#include "shared/scene_data.h"

#if LSF_SPECULAR_PATHS
/* Solid angle over which the other samples spread a lobe that reflects all light [sr], as in brdf_evaluate. */
layout(location = LSF_LOCATION_SPECULAR_SHARE) uniform float lobe_kernel;

/* Share that paths have of a lobe of this alpha that reflects so much, seen under the cosine nv: all if the kernel would
 * widen it, nothing if it is twice as wide. */
float narrow_share(float alpha, float reflects, float nv)
{
    float wide = kernel_alpha(lobe_kernel, reflects, sqrt(mix(nv * nv, 1.0, alpha * alpha)));
    return clamp(2.0 * wide / alpha - 1.0, 0.0, 1.0);
}

/* Cosine between a view that is lifted to the horizon and the normal. */
float lifted_cosine(vec3 view, vec3 normal)
{
    return max(dot(normal, lift_to_horizon(view, normal)), LSF_COSINE_MIN);
}

/* Share that paths have of the specular light that surfaces send to a visible point: that of its narrower lobe. */
float specular_paths_share(surface s, vec3 view)
{
#if LSF_SCATTER
    if (s.through)
        return 0.0;
#endif
    float nv = lifted_cosine(view, s.normal), alpha = lsf_alpha_from_roughness(s.roughness);
    float share = narrow_share(alpha, largest(surface_specular_fresnel(s, nv)), nv);
#if LSF_COAT
    float coat_nv = lifted_cosine(view, s.coat_normal);
    share = max(share, narrow_share(lsf_alpha_from_roughness(s.coat_roughness),
                                    s.coat * lsf_fresnel_schlick(LSF_COAT_F0, coat_nv), coat_nv));
#endif
    return share;
}

/* Share that paths have of the environment's light that a visible point's specular lobes reflect: the same, but none of
 * that of thin walls that transmit. These are in the picture at random: a pixel would count what paths find at the wall
 * together with what they find behind it. */
float specular_paths_sky_share(surface s, vec3 view)
{
#if LSF_TRANSMISSION
    if (s.transmission > 0.0 && !s.volume)
        return 0.0;
#endif
    return specular_paths_share(s, view);
}
#endif

#endif
