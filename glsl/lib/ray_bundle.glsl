/* A ray-bundle: its projection and its nodes, one for each fragment of the scene along its direction. Switches
 * LSF_BUNDLE_SPECULAR_PARAMS, LSF_BUNDLE_ANISOTROPY, LSF_BUNDLE_EMISSION, LSF_BUNDLE_GAPS;
 * lsf_ray_bundle_reader_switches adds them. Writers define LSF_BUNDLE_ACCESS as coherent.
 *
 * The first `bundle.sliced` fragments of a texel (a multiple of 4 less one, or 0) have slots of their own, in
 * slices of four that one fetch reads; the first slice begins with the number of fragments. Further fragments are
 * chained. The order of a texel's fragments is not deterministic, so that readers must not depend on it. */
#ifndef LSF_LIB_RAY_BUNDLE
#define LSF_LIB_RAY_BUNDLE

#include "lib/bundle_map.glsl"
#include "lib/gbuffer.glsl"
#include "lib/plane_key.glsl"

#ifndef LSF_BUNDLE_ACCESS
#define LSF_BUNDLE_ACCESS readonly
#endif

layout(std140, binding = LSF_BINDING_BUNDLE) uniform lsf_bundle_block
{
    lsf_bundle_data bundle;
};

/* Counters, see shared/bundle_data.h; then for each texel the last link of its chain. */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES) LSF_BUNDLE_ACCESS buffer lsf_bundle_head_block
{
    uint bundle_heads[];
};
/* The coarse plane of a node, which is all that a search needs: depth at the texel's centre, 16 bits | slopes
 * along right and up, 8 bits each. The first word of a texel is the number of its fragments. */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 1) LSF_BUNDLE_ACCESS buffer lsf_bundle_key_block
{
    uint bundle_keys[];
};
/* Chained nodes. x: key; y: the texel's link before this one */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 5) LSF_BUNDLE_ACCESS buffer lsf_bundle_chain_block
{
    uvec2 bundle_chain[];
};
/* Three words a node: shading normal on the side from which the bundle comes, octahedral; base colour; the bits of
 * the plane beyond the key, because maps are looked up at hits, which takes an exact position. */
layout(std430,
       binding = LSF_BINDING_BUNDLE_NODES + 2) LSF_BUNDLE_ACCESS buffer lsf_bundle_surface_block
{
    uint bundle_surfaces[];
};
#if LSF_BUNDLE_ANISOTROPY
/* x: roughness, metallic, f0; y: anisotropy strength unorm16 | angle as in lib/gbuffer.glsl << 16; with
 * LSF_STRAIGHT 12 bits of each | transmission unorm8 << 24 */
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 3) LSF_BUNDLE_ACCESS buffer lsf_bundle_specular_params_block
{
    uvec2 bundle_specular_params[];
};
#elif LSF_BUNDLE_SPECULAR_PARAMS
layout(std430, binding = LSF_BINDING_BUNDLE_NODES + 3) LSF_BUNDLE_ACCESS buffer lsf_bundle_specular_params_block
{
    uint bundle_specular_params[];
};
#endif
#if LSF_BUNDLE_EMISSION
layout(std430,
       binding = LSF_BINDING_BUNDLE_NODES + 4) LSF_BUNDLE_ACCESS buffer lsf_bundle_emission_block
{
    uvec2 bundle_emission[];
};
#endif
/* Texels are stored in tiles of 8 x 8, so that neighbours on the map are close in memory. */
int bundle_texel(ivec2 at)
{
    ivec2 inside = at & 7, tile = at - inside;
    return tile.y * int(bundle.row) + (tile.x << 3) + (inside.y << 3) + inside.x;
}

/* Texels of the map, those included that fill the last tiles. */
uint bundle_texels()
{
    return bundle.row * bundle.row;
}

/* Whether the map has this texel. */
bool bundle_has(ivec2 at)
{
    return min(at.x, at.y) >= 0 && max(at.x, at.y) < int(bundle.side);
}

/* The node of a fragment whose number is below `bundle.sliced`. */
uint bundle_slice_node(uint texel, uint fragment)
{
    uint slot = fragment + 1u;
    return ((slot >> 2) * bundle_texels() + texel) << 2 | (slot & 3u);
}

uint bundle_fragments(uint texel)
{
    return bundle_keys[4u * texel];
}

uint bundle_key(uint node)
{
    if (node < bundle.first_link)
        return bundle_keys[node];
    return bundle_chain[node - bundle.first_link].x;
}

vec3 bundle_coordinates(vec3 p)
{
    return bundle_map_coordinates(bundle, p);
}

/* Length of the gaps between two depths: their distance is that much larger than the difference of their
 * coordinates along the bundle. */
float bundle_gaps_between(float from, float to)
{
#if LSF_BUNDLE_GAPS
    return bundle_left_out(to, bundle.gap_starts[2], bundle.gap_lengths[2]) -
           bundle_left_out(from, bundle.gap_starts[2], bundle.gap_lengths[2]);
#else
    return 0.0;
#endif
}

/* Continuous texel coordinates on the map of a point with these coordinates. */
vec2 bundle_map_position(vec3 q)
{
    return ((q.xy - bundle.window.xy) / bundle.window.zw * 0.5 + 0.5) * float(bundle.side);
}

/* Width and height of a texel [normalised space]. */
vec2 bundle_texel_size()
{
    return bundle.window.zw * (2.0 / float(bundle.side));
}

/* Largest distance of a node's position from the plane of its surface, because vertices are moved by
 * LSF_RASTER_STEP. */
float bundle_raster_error(vec3 normal)
{
    vec2 per_texel = abs(vec2(dot(bundle.right.xyz, normal), dot(bundle.up.xyz, normal))) * bundle_texel_size();
    return LSF_RASTER_STEP * (per_texel.x + per_texel.y);
}

/* --- planes: depth at the texel's centre, 0..1 over the scene, and slopes as rise over run in normalised space.
 * Keys are those of lib/plane_key.glsl. Another 16 and twice 8 bits are stored with the surface. */

#define LSF_BUNDLE_DEPTH_STEPS 65535.0

struct bundle_plane_bits {
    uint key, rest;
};

bundle_plane_bits bundle_plane_pack(float depth, vec2 slope)
{
    float steps = clamp(depth, 0.0, 1.0) * LSF_BUNDLE_DEPTH_STEPS;
    float coarse = floor(steps + 0.5);
    slope = clamp(slope, -1e6, 1e6);
    ivec2 c = ivec2(clamp(round(32768.0 * slope / (1.0 + abs(slope))), -32639.0, 32639.0));
    ivec2 high = (c + 128) >> 8, low = c - high * 256;
    bundle_plane_bits bits;
    bits.key = uint(int(coarse)) << 16 | uint(high.x & 255) << 8 | uint(high.y & 255);
    bits.rest = packSnorm2x16(vec2(0.0, 2.0 * (steps - coarse))) | uint(low.x & 255) << 8 |
                uint(low.y & 255);
    return bits;
}

/* In depth steps. */
float bundle_key_depth(uint key)
{
    return float(int(key >> 16)); /* signed: software GL converts those at once */
}


/* Depth at the texel's centre, 0..1, and slopes, with all stored bits. */
vec3 bundle_plane(uint node)
{
    uint key = bundle_key(node), rest = bundle_surfaces[3u * node + 2u];
    vec2 c = vec2(int(key << 16) >> 24, int(key << 24) >> 24) +
             vec2(int(rest << 16) >> 24, int(rest << 24) >> 24) / 256.0;
    float depth = bundle_key_depth(key) + 0.5 * unpackSnorm2x16(rest).y;
    return vec3(depth / LSF_BUNDLE_DEPTH_STEPS, c / (128.0 - abs(c)));
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
uint bundle_specular_params_pack(float roughness, float metallic, float f0)
{
    uvec3 steps = uvec3(clamp(vec3(roughness, metallic, sqrt(f0)), 0.0, 1.0) *
                            vec3(2047.0, 255.0, 8191.0) +
                        0.5);
    return steps.x | steps.y << 11 | steps.z << 19;
}

void bundle_specular_params_unpack(uint bits, inout surface s)
{
    s.roughness = float(bits & 0x7ffu) / 2047.0;
    s.metallic = float(bits >> 11 & 0xffu) / 255.0;
    float root = float(bits >> 19) / 8191.0;
    s.f0 = root * root;
}

/* Three mantissas of 18 bits on the exponent of the largest (8 bits, any float): within 2^-19 of the largest. Two
 * flags name the sides that emit; neither: the surface is unlit and emits to both. */
#define LSF_BUNDLE_EMITS_BACK 1u  /* against the bundle's direction, towards rays along it */
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

#ifndef LSF_ABSORPTION
#define LSF_ABSORPTION 0
#endif
#if LSF_STRAIGHT
/* --- veils: transmitting surfaces that are absent in this iteration. Rays do not hit them, and what lies behind
 * is tinted. The slope along x in the key is -128, a value that no plane has; its bits are stored with the
 * surface, in place of the lower bits of the slope along y. */

bundle_plane_bits bundle_veil_pack(bundle_plane_bits plane)
{
    bundle_plane_bits bits;
    bits.key = (plane.key & 0xffff00ffu) | 0x8000u;
    bits.rest = (plane.rest & 0xffff0000u) | (plane.key & 0xff00u) | (plane.rest >> 8 & 0xffu);
    return bits;
}

bool bundle_is_veil(uint key)
{
    return (key & 0xff00u) == 0x8000u;
}

/* As bundle_plane. */
vec3 bundle_veil_plane(uint node, uint key)
{
    uint rest = bundle_surfaces[3u * node + 2u];
    vec2 c = vec2(float(int(rest << 16) >> 24) + float(int(rest << 24) >> 24) / 256.0,
                  int(key << 24) >> 24);
    float depth = bundle_key_depth(key) + 0.5 * unpackSnorm2x16(rest).y;
    return vec3(depth / LSF_BUNDLE_DEPTH_STEPS, c / (128.0 - abs(c)));
}

/* Tints are stored in steps of 2^(-1/128), of blue 2^(-1/64), down to 2^-16: within 0.3 % (blue 0.6 %). The steps
 * of several veils add up, in any order. */
#define BUNDLE_TINT_STEPS vec3(128.0, 128.0, 64.0)

uint bundle_tint_pack(vec3 tint)
{
    uvec3 steps = uvec3(min(-log2(clamp(tint, 1e-6, 1.0)) * BUNDLE_TINT_STEPS,
                            vec3(2047.0, 2047.0, 1023.0)) + 0.5);
    return steps.r | steps.g << 11 | steps.b << 22;
}

uvec3 bundle_tint_steps(uint bits)
{
    return uvec3(bits & 0x7ffu, bits >> 11 & 0x7ffu, bits >> 22);
}

#if LSF_ABSORPTION
/* Absorption of a medium, in place of a veil's normal: 8 bits a channel, in 255ths of the largest; the exponent of
 * the largest; whether the bundle enters the medium here. */
uint bundle_absorption_pack(vec3 absorption, bool enters)
{
    float most = max(absorption.r, max(absorption.g, absorption.b));
    int exponent = most > 0.0 ? clamp(int(ceil(log2(most))), -63, 63) : -63;
    uvec3 m = uvec3(clamp(ldexp(absorption, ivec3(-exponent)), 0.0, 1.0) * 255.0 + 0.5);
    return m.r | m.g << 8 | m.b << 16 | uint(exponent + 64) << 24 | (enters ? 0x80000000u : 0u);
}

vec3 bundle_absorption_unpack(uint bits, out bool enters)
{
    enters = (bits & 0x80000000u) != 0u;
    vec3 m = vec3(uvec3(bits, bits >> 8, bits >> 16) & 255u) / 255.0;
    return ldexp(m, ivec3(int(bits >> 24 & 127u) - 64));
}

/* Absorption over the length `path_length`, in whole steps like those of tints. */
ivec3 bundle_absorption_steps(vec3 absorption, float path_length)
{
    return ivec3(min(absorption * (path_length / log(2.0)) * BUNDLE_TINT_STEPS, vec3(1e6)) + 0.5);
}
#endif

/* Transmittance of the veils between the origin of a ray and the distance `far` along it. */
vec3 bundle_tint(vec3 origin, vec3 ray_direction, float far)
{
    vec3 q = bundle_coordinates(origin);
    vec2 position = bundle_map_position(q), size = bundle_texel_size();
    ivec2 at = ivec2(floor(position));
    if (!bundle_has(at))
        return vec3(1.0);
    uint texel = uint(bundle_texel(at)), count = bundle_fragments(texel), link = 0u;
    vec2 from_center = (position - vec2(at) - 0.5) * size;
    float side = dot(ray_direction, bundle.forward.xyz) < 0.0 ? -1.0 : 1.0;
    /* As in a search, a veil within this distance is the surface that the ray leaves. */
    float self = LSF_BUNDLE_SELF_TEXELS * max(size.x, size.y) +
                 0.5 * bundle.range.y / LSF_BUNDLE_DEPTH_STEPS;
    uvec3 steps = uvec3(0u);
#if LSF_ABSORPTION
    ivec3 within = ivec3(0), beyond = ivec3(0); /* from the origin to the veils, and from there to `far` */
#endif
    for (uint i = 0u; i < count; i++) {
        uint node = bundle_slice_node(texel, i);
        if (i >= bundle.sliced) {
            link = i == bundle.sliced ? bundle_heads[uint(LSF_BUNDLE_COUNTERS) + texel]
                                      : bundle_chain[link].y;
            node = bundle.first_link + link;
        }
        uint key = bundle_key(node);
        if (!bundle_is_veil(key))
            continue;
        vec3 plane = bundle_veil_plane(node, key);
        float z = bundle.range.x + bundle.range.y * plane.x;
        float t = side * (z + dot(plane.yz, from_center) - q.z + bundle_gaps_between(q.z, z));
        if (!(t > 0.0 && t < far && t * t > self * self * (1.0 + dot(plane.yz, plane.yz))))
            continue;
        steps += bundle_tint_steps(bundle_surfaces[3u * node + 1u]);
#if LSF_ABSORPTION
        bool enters;
        vec3 absorption = bundle_absorption_unpack(bundle_surfaces[3u * node], enters);
        int into = enters == (side > 0.0) ? 1 : -1;
        within -= into * bundle_absorption_steps(absorption, t);
        beyond += far < 1e30 ? into * bundle_absorption_steps(absorption, far) : ivec3(0);
#endif
    }
#if LSF_ABSORPTION
    /* The sum over the veils is also right for a ray that starts in a medium, and for one that ends in it. */
    steps += uvec3(max(within + max(beyond, 0), 0));
#endif
    return exp2(-vec3(steps) / BUNDLE_TINT_STEPS);
}
#endif

/* The point at which a ray from `origin`, along the bundle or against it, meets a node of its texel. The node's
 * plane is exact at the texel's centre only. A steep plane may leave the surface long before the ray and lead out
 * of a closed room, so that no point is farther from the centre than half the texel's diagonal. */
vec3 bundle_position(uint node, vec3 origin)
{
    vec3 plane = bundle_plane(node);
    vec3 q = bundle_coordinates(origin);
    vec2 position = bundle_map_position(q), size = bundle_texel_size();
    vec2 from_center = (position - floor(position) - 0.5) * size;
    vec3 along = vec3(from_center, dot(plane.yz, from_center));
    along *= min(1.0, 0.5 * length(size) / max(length(along), 1e-30));
    float z = bundle.range.x + bundle.range.y * plane.x;
    return origin + (along.x - from_center.x) * bundle.right.xyz +
           (along.y - from_center.y) * bundle.up.xyz +
           (z + along.z - q.z + bundle_gaps_between(q.z, z)) * bundle.forward.xyz;
}

/* The surface of a node as a ray along the bundle, or against it, sees it: normals face the ray, and emission is
 * that of the side that it hits. An unlit surface emits its base colour. */
surface bundle_surface(uint node, vec3 ray_direction, out vec3 emission)
{
    surface s;
    vec2 slope = bundle_plane(node).yz;
    float side = dot(ray_direction, bundle.forward.xyz) < 0.0 ? -1.0 : 1.0;
    s.geometric_normal = side * normalize(slope.x * bundle.right.xyz + slope.y * bundle.up.xyz -
                                          bundle.forward.xyz);
    vec3 normal = octahedral_decode(bundle_surfaces[3u * node]);
    s.normal = side * normal;
    s.base_color = bundle_color_unpack(bundle_surfaces[3u * node + 1u]);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.f0 = 0.04; /* ior 1.5 */
    s.anisotropy = 0.0;
    s.anisotropy_angle = 0.0;
    s.unlit = false;
    emission = vec3(0.0);
    lobes_none(s);
#if LSF_TRANSMISSION
    transmission_none(s);
#endif
#if LSF_BUNDLE_ANISOTROPY
    uvec2 specular_params = bundle_specular_params[node];
    bundle_specular_params_unpack(specular_params.x, s);
    vec2 anisotropy = unpackUnorm2x16(specular_params.y);
#if LSF_STRAIGHT
    anisotropy = vec2(specular_params.y & 0xfffu, specular_params.y >> 12 & 0xfffu) / 4095.0;
    s.transmission = float(specular_params.y >> 24) / 255.0;
#endif
    s.anisotropy = anisotropy.x;
    s.anisotropy_angle = anisotropy.y;
    if (side < 0.0) { /* the same tangent in the basis of the turned normal */
        vec3 t, b, turned_t, turned_b;
        orthonormal_basis(normal, t, b);
        orthonormal_basis(s.normal, turned_t, turned_b);
        float angle = anisotropy.y * 2.0 * LSF_PI;
        vec3 along = cos(angle) * t + sin(angle) * b;
        s.anisotropy_angle =
            fract(atan(dot(along, turned_b), dot(along, turned_t)) / (2.0 * LSF_PI));
    }
#elif LSF_BUNDLE_SPECULAR_PARAMS
    bundle_specular_params_unpack(bundle_specular_params[node], s);
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
