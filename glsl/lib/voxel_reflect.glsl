/* What voxels reflect of light from one direction to all sides. Switches LSF_SPECULAR, LSF_VOXEL_GLOSS. */
#ifndef LSF_LIB_VOXEL_REFLECT
#define LSF_LIB_VOXEL_REFLECT

#include "lib/voxel.glsl"
#include "shared/albedo.h"

struct voxel_material {
    vec3 base_color;
    float transmission, roughness, f0, metallic;
};

/* `gloss` as in voxelize.gloss; not looked at without LSF_VOXEL_GLOSS. */
voxel_material voxel_material_unpack(uint albedo, uint gloss, float transmission)
{
    voxel_material m = voxel_material(voxel_albedo_unpack(albedo), transmission, 1.0, 0.04, 0.0);
#if LSF_VOXEL_GLOSS
    vec4 g = unpackUnorm4x8(gloss);
    m.roughness = sqrt(g.x * g.y); /* with it the lobe's peak, 1 / (pi alpha_t alpha_b), is kept */
    m.f0 = g.z * g.z;
    m.metallic = g.w;
#endif
    return m;
}

/* Of light under that cosine, all lobes together. */
vec3 voxel_reflectance(voxel_material m, float cosine)
{
    vec3 diffuse = (1.0 - m.transmission) * m.base_color;
#if LSF_SPECULAR
    diffuse *= (1.0 - m.metallic) * lsf_diffuse_albedo(m.f0, 1.0, cosine);
    float none = lsf_specular_albedo(0.0, 1.0, cosine, m.roughness);
    float all = lsf_specular_albedo(1.0, 1.0, cosine, m.roughness);
    return diffuse + mix(vec3(none), vec3(all), mix(vec3(m.f0), m.base_color, m.metallic));
#else
    return diffuse;
#endif
}

#endif
