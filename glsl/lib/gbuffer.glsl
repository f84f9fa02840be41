/* The contents of a G-buffer texel, and the functions that pack and unpack them.
 *
 * gbuffer.surface RGBA32UI
 *   x  geometric normal, octahedral 2 x snorm16, towards the viewer
 *   y  shading normal, the same
 *   z  base colour R, G as 2 x unorm16
 *   w  base colour B unorm16 | metallic unorm15 << 16 | unlit << 31
 * gbuffer.specular_params R32UI (RG32UI with anisotropy, RGBA32UI with transmission or tints), only where the scene requires it
 *   x  roughness unorm16 | f0 of the dielectric unorm16 << 16
 *   y  anisotropy strength unorm16 | angle of its tangent in the shading normal's
 *      orthonormal_basis, unorm16 of a full turn << 16
 *   z  transmission unorm8 | seen from the front << 8 | surface of a medium << 9 | seen through << 10 |
 *   material << 11
 *   w  tint of f0, weight of the dielectric's reflection, 4 x unorm8 (KHR_materials_specular)
 *   the first of y, z, w that is free holds a clear coat: factor unorm5 | roughness unorm9 << 5 |
 *   normal, octahedral 2 x unorm9 << 14 (KHR_materials_clearcoat)
 *   the next one that is free a sheen: roots of the color 3 x unorm8 | roughness unorm8 (KHR_materials_sheen)
 * gbuffer.tint RGBA16F, only where surfaces are seen through: transmittance between surface and eye, over
 *   the probability of seeing this surface (lib/straight.glsl)
 * gbuffer.absorption RGBA32F, only with media: optical depth between surface and eye
 * Switches LSF_TRANSMISSION, LSF_STRAIGHT, LSF_SCATTER (rough thin walls scatter), LSF_SPECULAR_TINT, LSF_COAT and
 * LSF_SHEEN (their words exist). */
#ifndef LSF_LIB_GBUFFER
#define LSF_LIB_GBUFFER

#include "lib/octahedral.glsl"
#include "shared/brdf.h"

#ifndef LSF_TRANSMISSION
#define LSF_TRANSMISSION 0
#endif
#ifndef LSF_SPECULAR_TINT
#define LSF_SPECULAR_TINT 0
#endif
#ifndef LSF_COAT
#define LSF_COAT 0
#endif
#ifndef LSF_SHEEN
#define LSF_SHEEN 0
#endif
#ifndef LSF_STRAIGHT
#define LSF_STRAIGHT 0
#endif
#ifndef LSF_SCATTER
#define LSF_SCATTER 0
#endif

struct surface {
    vec3 geometric_normal, normal; /* unit, towards the viewer's side */
    vec3 base_color;
    float metallic, roughness, f0;
    float anisotropy;      /* strength, 0..1 */
    float anisotropy_angle; /* the tangent's angle in orthonormal_basis(normal), 0..1 of a full turn */
    bool unlit;
#if LSF_SPECULAR_TINT
    vec3 f0_tint;          /* factor on the f0 of dielectrics */
    float specular_weight; /* reflectance of dielectrics at grazing angles, and a factor on f0 */
#endif
#if LSF_SHEEN
    vec4 sheen; /* color, roughness */
#endif
#if LSF_COAT
    float coat, coat_roughness;
    vec3 coat_normal; /* unit, towards the viewer's side */
#endif
#if LSF_TRANSMISSION
    float transmission; /* share of the light that enters the dielectric */
    float eta;          /* refractive index behind the surface over that on the viewer's side; 1: not refracted */
    bool front, volume; /* seen from the front; surface of a medium, which lies behind the front */
    uint material;
#if LSF_SCATTER
    bool through; /* the visible light is scattered through the surface: normals point to the side that it comes
                   * from */
#endif
#endif
};

/* Sets the values of a surface without extensions. */
void lobes_none(inout surface s)
{
#if LSF_SPECULAR_TINT
    s.f0_tint = vec3(1.0);
    s.specular_weight = 1.0;
#endif
#if LSF_SHEEN
    s.sheen = vec4(0.0);
#endif
#if LSF_COAT
    s.coat = s.coat_roughness = 0.0;
    s.coat_normal = s.normal;
#endif
}

#if LSF_COAT
uint coat_pack(surface s)
{
    vec2 position = octahedral_position(s.coat_normal) * 0.5 + 0.5;
    uvec2 normal = uvec2(clamp(position, 0.0, 1.0) * 511.0 + 0.5);
    return uint(clamp(s.coat, 0.0, 1.0) * 31.0 + 0.5) |
           uint(clamp(s.coat_roughness, 0.0, 1.0) * 511.0 + 0.5) << 5 | normal.x << 14 | normal.y << 23;
}

void coat_unpack(uint bits, inout surface s)
{
    s.coat = float(bits & 31u) / 31.0;
    s.coat_roughness = float((bits >> 5) & 511u) / 511.0;
    s.coat_normal = octahedral_normal(vec2(uvec2(bits >> 14, bits >> 23) & 511u) / 255.5 - 1.0);
}
#endif

/* f0 of the dielectric. */
vec3 surface_f0(surface s)
{
#if LSF_SPECULAR_TINT
    return s.specular_weight * s.f0 * s.f0_tint;
#else
    return vec3(s.f0);
#endif
}

/* Reflectance of the dielectric at grazing angles. */
float surface_f90(surface s)
{
#if LSF_SPECULAR_TINT
    return s.specular_weight;
#else
    return 1.0;
#endif
}

float largest(vec3 v)
{
    return max(v.x, max(v.y, v.z));
}

#if LSF_TRANSMISSION
/* Packs transmission, flags and material; holds up to 2^21 materials. */
uint transmission_pack(surface s)
{
    uint bits = uint(clamp(s.transmission, 0.0, 1.0) * 255.0 + 0.5) | (s.front ? 1u << 8 : 0u) |
                (s.volume ? 1u << 9 : 0u) | (s.material << 11);
#if LSF_SCATTER
    bits |= s.through ? 1u << 10 : 0u;
#endif
    return bits;
}

/* Sets `eta` and the flags for a surface seen from the front or from the back. Needs s.f0, which encodes the
 * refractive index n: f0 = ((n - 1) / (n + 1))^2. */
void transmission_set_side(inout surface s, bool front)
{
    s.front = front;
    s.eta = 1.0;
    if (s.volume && LSF_STRAIGHT == 0) {
        /* A surface that reflects everything (f0 = 1) transmits nothing, whatever its index. */
        float root = min(sqrt(s.f0), 0.99);
        s.eta = lsf_relative_ior((1.0 + root) / (1.0 - root), front);
        /* Without a change of index nothing is refracted, however rough the surface. */
        if (s.eta == 1.0)
            s.roughness = s.anisotropy = 0.0;
    }
}

void transmission_none(inout surface s)
{
    s.transmission = 0.0;
    s.eta = 1.0;
    s.front = true;
    s.volume = false;
    s.material = 0u;
#if LSF_SCATTER
    s.through = false;
#endif
}

void transmission_unpack(uint bits, inout surface s)
{
    s.transmission = float(bits & 0xffu) / 255.0;
    s.volume = (bits & (1u << 9)) != 0u;
    s.material = bits >> 11;
#if LSF_SCATTER
    s.through = (bits & (1u << 10)) != 0u;
#endif
    transmission_set_side(s, (bits & (1u << 8)) != 0u);
}
#endif

uvec4 surface_pack(surface s)
{
    uint metallic = uint(clamp(s.metallic, 0.0, 1.0) * 32767.0 + 0.5);
    uint blue = packUnorm2x16(vec2(s.base_color.b, 0.0));
    return uvec4(octahedral_encode(s.geometric_normal), octahedral_encode(s.normal),
                 packUnorm2x16(s.base_color.rg),
                 blue | (metallic << 16) | (s.unlit ? 0x80000000u : 0u));
}

uvec4 specular_params_pack(surface s)
{
    uvec4 texel = uvec4(packUnorm2x16(vec2(s.roughness, s.f0)),
                        packUnorm2x16(vec2(s.anisotropy, s.anisotropy_angle)), 0u, 0u);
#if LSF_TRANSMISSION
    texel.z = transmission_pack(s);
#endif
#if LSF_SPECULAR_TINT
    texel.w = packUnorm4x8(vec4(s.f0_tint, s.specular_weight));
#endif
#if LSF_COAT
    texel[LSF_COAT] = coat_pack(s);
#endif
#if LSF_SHEEN
    texel[LSF_SHEEN] = packUnorm4x8(vec4(sqrt(s.sheen.rgb), s.sheen.a));
#endif
    return texel;
}

bool surface_texel_unlit(uvec4 texel)
{
    return (texel.w & 0x80000000u) != 0u;
}

surface surface_unpack(uvec4 texel)
{
    surface s;
    s.geometric_normal = octahedral_decode(texel.x);
    s.normal = octahedral_decode(texel.y);
    s.base_color = vec3(unpackUnorm2x16(texel.z), unpackUnorm2x16(texel.w & 0xffffu).x);
    s.metallic = float((texel.w >> 16) & 0x7fffu) / 32767.0;
    s.unlit = surface_texel_unlit(texel);
    s.roughness = 1.0;
    s.f0 = 0.04; /* ior 1.5 */
    s.anisotropy = 0.0;
    s.anisotropy_angle = 0.0;
    lobes_none(s);
#if LSF_TRANSMISSION
    transmission_unpack(0u, s);
#endif
    return s;
}

void specular_params_unpack(uvec4 texel, inout surface s)
{
    vec2 specular_params = unpackUnorm2x16(texel.x);
    s.roughness = specular_params.x;
    s.f0 = specular_params.y;
    vec2 anisotropy = unpackUnorm2x16(texel.y);
    s.anisotropy = anisotropy.x;
    s.anisotropy_angle = anisotropy.y;
#if LSF_SPECULAR_TINT
    vec4 tint = unpackUnorm4x8(texel.w);
    s.f0_tint = tint.rgb;
    s.specular_weight = tint.a;
#endif
#if LSF_COAT
    coat_unpack(texel[LSF_COAT], s);
#endif
#if LSF_SHEEN
    s.sheen = unpackUnorm4x8(texel[LSF_SHEEN]);
    s.sheen.rgb *= s.sheen.rgb;
#endif
#if LSF_TRANSMISSION
    transmission_unpack(texel.z, s);
#endif
}

#endif
