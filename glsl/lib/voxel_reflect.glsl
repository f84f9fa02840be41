/* Materials of voxels, for lib/reflectance.glsl. Switches LSF_SPECULAR, LSF_VOXEL_SPECULAR_PARAMS. */
#ifndef LSF_LIB_VOXEL_REFLECT
#define LSF_LIB_VOXEL_REFLECT

#include "lib/reflectance.glsl"
#include "lib/voxel.glsl"

/* `specular_params` as in voxelize.specular_params; unused without LSF_VOXEL_SPECULAR_PARAMS. */
reflector voxel_material_unpack(uint albedo, uint specular_params, float transmission)
{
    reflector m = reflector(voxel_albedo_unpack(albedo), transmission, 1.0, 0.04, 0.0);
#if LSF_VOXEL_SPECULAR_PARAMS
    vec4 g = unpackUnorm4x8(specular_params);
    m.roughness = sqrt(g.x * g.y); /* keeps the lobe's peak, 1 / (pi alpha_t alpha_b) */
    m.f0 = g.z * g.z;
    m.metallic = g.w;
#endif
    return m;
}

#endif
