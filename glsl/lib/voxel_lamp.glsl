/* Lamps that voxels of smooth metal mirror: punctual lights and directions of the environment. Each side of such a
 * voxel keeps one, drawn by what the side reflects of it; src/passes/voxel_light.md, "Metals". Switch LSF_VOXEL_LAMPS:
 * there are both. */
#ifndef LSF_LIB_VOXEL_LAMP
#define LSF_LIB_VOXEL_LAMP

#include "lib/octahedral.glsl"
#include "lib/voxel.glsl"
#include "shared/brdf.h"

/* The largest density of directions that are drawn by the cosine [1/sr]. */
#define COSINE_DENSITY (1.0 / LSF_PI)

/* Whether a metal shows what it reflects in its lobe, which has to be denser than diffuse ones. Its peak, seen along
 * the normal, is 1 / (4 pi alpha^2). */
bool is_smooth_metal(float metallic, float roughness)
{
    float alpha = lsf_alpha_from_roughness(roughness);
    return metallic >= 0.5 && 4.0 * LSF_PI * COSINE_DENSITY * alpha * alpha < 1.0;
}

/* In the place of a lamp's nearness: it is a direction of the environment. */
#define VOXEL_LAMP_SKY -1.0

#if LSF_VOXEL_LAMPS
bool voxel_is_smooth_metal(uint specular_params)
{
    vec4 p = unpackUnorm4x8(specular_params);
    return is_smooth_metal(p.w, p.y);
}

/* Light of the lamps that shine on a side of a voxel, in the grid's unit. */
struct voxel_lamp {
    vec3 to_lamp;
    float nearness;  /* 1 over the squared distance to the lamp [1/voxel^2]; 0: it is infinitely far; or
                      * VOXEL_LAMP_SKY */
    vec3 irradiance; /* of the lamp that is kept, the cosine included, over the probability of keeping it */
    vec3 spread;     /* radiance of the side by all lamps, reflected as by a diffuse surface */
};

uvec4 voxel_lamp_pack(voxel_lamp l)
{
    return uvec4(octahedral_encode(l.to_lamp), floatBitsToUint(l.nearness), voxel_emission_pack(l.irradiance),
                 voxel_emission_pack(l.spread));
}

voxel_lamp voxel_lamp_unpack(uvec4 bits)
{
    return voxel_lamp(octahedral_decode(bits.x), uintBitsToFloat(bits.y), voxel_emission_unpack(bits.z),
                      voxel_emission_unpack(bits.w));
}
#endif

#endif
