/* A ray-bundle: its projection and its nodes, one for each fragment of the scene along its direction.
 * Switches LSF_BUNDLE_SIDE (texels along a side), LSF_BUNDLE_SLICES, LSF_BUNDLE_GLOSS,
 * LSF_BUNDLE_ANISOTROPY, LSF_BUNDLE_EMISSION; lsf_ray_bundle_reader_switches adds them. Writers define
 * LSF_BUNDLE_ACCESS as coherent.
 *
 * The first LSF_BUNDLE_SLICES (a multiple of 4) fragments of a texel have a place of their own, in
 * slices of four that one fetch reads; further ones are chained. Which fragment comes first depends on
 * the machine's mood: readers use rules that do not. */
#ifndef LSF_LIB_RAY_BUNDLE
#define LSF_LIB_RAY_BUNDLE

#include "lib/gbuffer.glsl"
#include "shared/bundle_data.h"
#include "shared/scene_data.h"

#ifndef LSF_BUNDLE_ACCESS
#define LSF_BUNDLE_ACCESS readonly
#endif

layout(std140, binding = LSF_BINDING_BUNDLE) uniform lsf_bundle_block
{
    lsf_bundle_data bundle;
};

/* For each texel its number of fragments; the number of chained nodes; for each texel the last
 * link of its chain. */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES) LSF_BUNDLE_ACCESS buffer lsf_bundle_texel_block
{
    uint bundle_texels[];
};
#if LSF_BUNDLE_SLICES
/* What a search needs of a node: depth of its plane at the texel's centre and its slopes. */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 1) LSF_BUNDLE_ACCESS buffer lsf_bundle_key_block
{
    uint bundle_keys[];
};
#endif
/* Of chained nodes. x: key, y: the texel's link before this one */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 5) LSF_BUNDLE_ACCESS buffer lsf_bundle_chain_block
{
    uvec2 bundle_chain[];
};
/* x: shading normal on the side from which the bundle comes, octahedral; y: base colour */
layout(std430,
       binding = LSF_BINDING_BUNDLE_NODES + 2) LSF_BUNDLE_ACCESS buffer lsf_bundle_surface_block
{
    uvec2 bundle_surfaces[];
};
#if LSF_BUNDLE_ANISOTROPY
/* x: gloss; y: anisotropy strength unorm16 | angle as in lib/gbuffer.glsl << 16 */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 3) LSF_BUNDLE_ACCESS buffer lsf_bundle_gloss_block
{
    uvec2 bundle_gloss[];
};
#elif LSF_BUNDLE_GLOSS
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 3) LSF_BUNDLE_ACCESS buffer lsf_bundle_gloss_block
{
    uint bundle_gloss[];
};
#endif
#if LSF_BUNDLE_EMISSION
layout(std430,
       binding = LSF_BINDING_BUNDLE_NODES + 4) LSF_BUNDLE_ACCESS buffer lsf_bundle_emission_block
{
    uvec2 bundle_emission[];
};
#endif
#define LSF_BUNDLE_TEXELS (uint(LSF_BUNDLE_SIDE) * uint(LSF_BUNDLE_SIDE))
#define LSF_BUNDLE_FIRST_LINK (uint(LSF_BUNDLE_SLICES) * LSF_BUNDLE_TEXELS) /* its node */

/* The node of a texel's fragment below LSF_BUNDLE_SLICES. */
uint bundle_slice_node(uint texel, uint fragment)
{
    return ((fragment >> 2) * LSF_BUNDLE_TEXELS + texel) << 2 | (fragment & 3u);
}

uint bundle_key(uint node)
{
#if LSF_BUNDLE_SLICES
    if (node < LSF_BUNDLE_FIRST_LINK)
        return bundle_keys[node];
#endif
    return bundle_chain[node - LSF_BUNDLE_FIRST_LINK].x;
}

vec3 bundle_coordinates(vec3 p)
{
    return vec3(dot(bundle.right.xyz, p), dot(bundle.up.xyz, p), dot(bundle.forward.xyz, p));
}

/* Continuous texel coordinates of a point with these coordinates. */
vec2 bundle_place(vec3 q)
{
    return ((q.xy - bundle.window.xy) / bundle.window.zw * 0.5 + 0.5) * float(LSF_BUNDLE_SIDE);
}

/* Width and height of a texel [normalised space]. */
vec2 bundle_texel_size()
{
    return bundle.window.zw * (2.0 / float(LSF_BUNDLE_SIDE));
}

/* --- keys: depth of 16 bits over the scene | slope along x, y of 8 bits each, as rise over run in
 * normalised space. Steep slopes are coarse: s = c / (128 - |c|), c in -127..127, which divides the
 * angle about evenly (within 0.45 degrees) and ends at 89.5 degrees. */

#define LSF_BUNDLE_DEPTH_STEPS 65535.0

uint bundle_slope_pack(float slope)
{
    slope = clamp(slope, -1e6, 1e6);
    return uint(int(clamp(round(128.0 * slope / (1.0 + abs(slope))), -127.0, 127.0))) & 0xffu;
}

uint bundle_key_pack(float depth, vec2 slope)
{
    uint steps = uint(clamp(depth, 0.0, 1.0) * LSF_BUNDLE_DEPTH_STEPS + 0.5);
    return steps << 16 | bundle_slope_pack(slope.x) << 8 | bundle_slope_pack(slope.y);
}

/* Depth in steps of the 16 bits. */
float bundle_key_depth(uint key)
{
    return float(int(key >> 16)); /* signed: software GL converts those at once */
}

vec2 bundle_key_slope(uint key)
{
    vec2 c = vec2(int(key << 16) >> 24, int(key << 24) >> 24);
    return c / (128.0 - abs(c));
}

/* --- surfaces */

/* 11, 11 and 10 bits of the square root: within 0.25 % (blue 0.5 %) above 0.04. */
uint bundle_color_pack(vec3 color)
{
    uvec3 steps = uvec3(sqrt(clamp(color, 0.0, 1.0)) * vec3(2047.0, 2047.0, 1023.0) + 0.5);
    return steps.r | steps.g << 11 | steps.b << 22;
}

vec3 bundle_color_unpack(uint bits)
{
    vec3 root = vec3(bits & 0x7ffu, bits >> 11 & 0x7ffu, bits >> 22) /
                vec3(2047.0, 2047.0, 1023.0);
    return root * root;
}

/* Roughness 11 bits, metallic 8, square root of f0 13. */
uint bundle_gloss_pack(float roughness, float metallic, float f0)
{
    uvec3 steps = uvec3(clamp(vec3(roughness, metallic, sqrt(f0)), 0.0, 1.0) *
                            vec3(2047.0, 255.0, 8191.0) +
                        0.5);
    return steps.x | steps.y << 11 | steps.z << 19;
}

void bundle_gloss_unpack(uint bits, inout surface s)
{
    s.roughness = float(bits & 0x7ffu) / 2047.0;
    s.metallic = float(bits >> 11 & 0xffu) / 255.0;
    float root = float(bits >> 19) / 8191.0;
    s.f0 = root * root;
}

/* Three mantissas of 18 bits on the exponent of the largest (8 bits, any float): within 2^-19 of
 * the largest. Two flags say to which side it emits; neither: it is unlit, and emits to both. */
#define LSF_BUNDLE_EMITS_BACK 1u  /* against the bundle's direction: rays along it see it */
#define LSF_BUNDLE_EMITS_AHEAD 2u

uvec2 bundle_emission_pack(vec3 emission, uint sides)
{
    int exponent;
    float largest = max(emission.r, max(emission.g, emission.b));
    frexp(clamp(largest, 1e-37, 1e38), exponent);
    uvec3 m = min(uvec3(ldexp(emission, ivec3(18 - exponent)) + 0.5), uvec3(0x3ffffu));
    return uvec2(m.r | m.g << 18,
                 m.g >> 14 | m.b << 4 | uint(exponent + 126) << 22 | sides << 30);
}

vec3 bundle_emission_unpack(uvec2 bits, out uint sides)
{
    uvec3 m = uvec3(bits.x & 0x3ffffu, bits.x >> 18 | (bits.y & 0xfu) << 14,
                    bits.y >> 4 & 0x3ffffu);
    sides = bits.y >> 30;
    return ldexp(vec3(m), ivec3(int(bits.y >> 22 & 0xffu) - 126 - 18));
}

/* The surface of a node as a ray along the bundle, or against it, sees it: normals turned against
 * the ray, emission of the side it meets. An unlit surface emits its base colour. */
surface bundle_surface(uint node, vec3 ray_direction, out vec3 emission)
{
    surface s;
    uvec2 bits = bundle_surfaces[node];
    vec2 slope = bundle_key_slope(bundle_key(node));
    float side = dot(ray_direction, bundle.forward.xyz) < 0.0 ? -1.0 : 1.0;
    s.geometric_normal = side * normalize(slope.x * bundle.right.xyz + slope.y * bundle.up.xyz -
                                          bundle.forward.xyz);
    vec3 normal = octahedral_decode(bits.x);
    s.normal = side * normal;
    s.base_color = bundle_color_unpack(bits.y);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = 0.04; /* ior 1.5 */
    s.anisotropy = 0.0;
    s.anisotropy_turn = 0.0;
    s.unlit = false;
    emission = vec3(0.0);
#if LSF_BUNDLE_ANISOTROPY
    uvec2 gloss = bundle_gloss[node];
    bundle_gloss_unpack(gloss.x, s);
    vec2 anisotropy = unpackUnorm2x16(gloss.y);
    s.anisotropy = anisotropy.x;
    s.anisotropy_turn = anisotropy.y;
    if (side < 0.0) { /* the same tangent in the basis of the turned normal */
        vec3 t, b, turned_t, turned_b;
        orthonormal_basis(normal, t, b);
        orthonormal_basis(s.normal, turned_t, turned_b);
        float angle = anisotropy.y * 2.0 * LSF_PI;
        vec3 along = cos(angle) * t + sin(angle) * b;
        s.anisotropy_turn =
            fract(atan(dot(along, turned_b), dot(along, turned_t)) / (2.0 * LSF_PI));
    }
#elif LSF_BUNDLE_GLOSS
    bundle_gloss_unpack(bundle_gloss[node], s);
#endif
#if LSF_BUNDLE_EMISSION
    uint sides;
    vec3 radiance = bundle_emission_unpack(bundle_emission[node], sides);
    s.unlit = sides == 0u;
    if (s.unlit || (sides & (side < 0.0 ? LSF_BUNDLE_EMITS_AHEAD : LSF_BUNDLE_EMITS_BACK)) != 0u)
        emission = radiance;
#endif
    return s;
}

#endif
