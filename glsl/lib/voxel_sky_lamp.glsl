/* What voxels that mirror show of the environment, by two strategies: the path's next direction, and the direction of the
 * environment that the voxel keeps; src/passes/voxel_light.md, "Metals". Switches LSF_VOXEL_MIRRORS, LSF_VOXEL_LAMPS,
 * LSF_ENVIRONMENT, and those of the libraries. */
#ifndef LSF_LIB_VOXEL_SKY_LAMP
#define LSF_LIB_VOXEL_SKY_LAMP

#include "lib/brdf_sample.glsl"
#include "lib/environment.glsl"
#include "lib/sky.glsl"
#include "lib/specular_share.glsl"
#include "lib/voxel_surface.glsl"

#define VOXEL_SKY_LAMPS (LSF_VOXEL_MIRRORS && LSF_VOXEL_LAMPS && LSF_ENVIRONMENT)

#if VOXEL_SKY_LAMPS
/* Share that directions drawn by the environment's radiance have of what a voxel mirrors of it, weighted against the
 * path's own: all, unless the lobe is widened to show the lamp that the voxel keeps (lamp_mirrored), or nearly so. 0 for
 * what is not smooth metal, which keeps none. `density`: that of all paths that meet the voxel in this direction [1/sr];
 * 0: it was not drawn by a BRDF. */
float sky_lamp_share(surface s, vec3 direction, float density)
{
    if (lamp_kernel.x < 0.0 || !is_smooth_metal(s.metallic, s.roughness))
        return 0.0;
    float nv = lifted_cosine(-direction, s.normal), alpha = lsf_alpha_from_roughness(s.roughness);
    float kernel = max(density > 0.0 ? lamp_kernel.x / density : 0.0, lamp_kernel.y);
    return 1.0 - narrow_share(widened_twice(kernel, alpha, largest(surface_specular_fresnel(s, nv)), nv));
}

/* What the side of a voxel mirrors towards a ray's start `from` of the environment, by the direction of it that the side
 * keeps, in the grid's unit, but for that share. Its irradiance is weighted against directions that are drawn by the
 * cosine, and now against those of the lobe. */
vec3 sky_lamp_mirrored(surface s, ivec3 cell, int side, vec3 from, vec3 direction, float density)
{
    voxel_lamp lamp;
    if (!voxel_lamp_at(s, cell, side, lamp) || lamp.nearness != VOXEL_LAMP_SKY)
        return vec3(0.0);
    float drawn = sky_density(environment_radiance(lamp.to_lamp));
    float by_cosine = max(dot(s.normal, lamp.to_lamp), 0.0) / LSF_PI;
    float by_lobe = brdf_pdf(brdf_sampler_of(s, -direction, false), lamp.to_lamp);
    return lamp_mirrored(s, lamp, cell, from, direction, density) *
           ((drawn + by_cosine) / max(drawn + by_lobe, 1e-6));
}
#endif

#endif
