/* The nearest fragment beyond each origin, along the bundle or against it, by the side that the
 * origin's surface faces. Switches LSF_ORTHOGRAPHIC, LSF_INTERLEAVE, LSF_DEEP and those of
 * lib/ray_bundle.glsl. */
#include "lib/ray_bundle.glsl"
#include "lib/region.glsl"
#include "lib/view.glsl"

layout(binding = 0) uniform sampler2D origin_depth;
layout(binding = 1) uniform usampler2D origin_surface;
#if LSF_DEEP
layout(binding = 2) uniform sampler2D origin_position;
layout(location = 0) uniform bool from_position;
#endif

layout(location = 0) out uvec2 hit_out; /* distance as float bits, node */

/* How far off a node's plane may be at the ray's place and still be the surface that the ray left:
 * a tenth of a texel, for what curves within it, and half a step of the 16-bit depth. */
#define LSF_SELF_TEXELS 0.1

struct bundle_ray {
    uint texel;
    float depth;    /* of the origin, in steps of the keys */
    vec2 to_depth;  /* depth steps for a slope of 1: from the texel's centre to the ray */
    float sign;     /* 1 along the bundle, -1 against it */
    float nearest;  /* steps */
};

struct bundle_hit {
    float distance; /* steps */
    uint key, node;
    bool tie; /* another node has the same key */
};

void visit(bundle_ray ray, uint node, inout bundle_hit hit)
{
    uint key = bundle_keys[node];
    float depth = bundle_key_depth(key) + dot(bundle_key_slope(key), ray.to_depth);
    float distance = ray.sign * (depth - ray.depth);
    if (distance <= ray.nearest || distance > hit.distance)
        return;
    if (distance == hit.distance && key >= hit.key) {
        hit.tie = hit.tie || key == hit.key;
        return;
    }
    hit = bundle_hit(distance, key, node, false);
}

/* A rule between nodes of one key that does not depend on their order in the list. */
bool comes_before(uint a, uint b)
{
    uvec2 x = bundle_surfaces[a].xy, y = bundle_surfaces[b].xy;
    if (x.x != y.x)
        return x.x < y.x;
    if (x.y != y.y)
        return x.y < y.y;
#if LSF_BUNDLE_ANISOTROPY
    if (bundle_gloss[a].x != bundle_gloss[b].x)
        return bundle_gloss[a].x < bundle_gloss[b].x;
    if (bundle_gloss[a].y != bundle_gloss[b].y)
        return bundle_gloss[a].y < bundle_gloss[b].y;
#elif LSF_BUNDLE_GLOSS
    if (bundle_gloss[a] != bundle_gloss[b])
        return bundle_gloss[a] < bundle_gloss[b];
#endif
#if LSF_BUNDLE_EMISSION
    if (bundle_emission[a].x != bundle_emission[b].x)
        return bundle_emission[a].x < bundle_emission[b].x;
    return bundle_emission[a].y < bundle_emission[b].y;
#else
    return false;
#endif
}

/* Software GL needs a low cap on every loop (lanes without work run up to it), so that long lists
 * take several turns. */
#define LSF_STEPS 64
#define LSF_TURNS 65535

bundle_hit search(bundle_ray ray)
{
    bundle_hit hit = bundle_hit(1e30, LSF_NO_NODE, LSF_NO_NODE, false);
    uint texels = bundle_texel_count(), slices = uint(LSF_BUNDLE_SLICES);
    uint count = bundle_texels[ray.texel];
    for (uint i = 0u; i < slices; i++) {
        if (i >= count)
            break;
        visit(ray, i * texels + ray.texel, hit);
    }
    uint left = count > slices ? count - slices : 0u;
    uint node = left > 0u ? bundle_texels[texels + 1u + ray.texel] : 0u;
    for (int turn = 0; turn < LSF_TURNS && left > 0u; turn++)
        for (int i = 0; i < LSF_STEPS && left > 0u; i++) {
            visit(ray, node, hit);
            node = bundle_next[node - slices * texels];
            left--;
        }
    return hit;
}

/* The list once more, for the node that `hit` shares its key with. Seldom needed. */
uint settle_tie(bundle_ray ray, bundle_hit hit)
{
    uint texels = bundle_texel_count(), slices = uint(LSF_BUNDLE_SLICES);
    uint count = hit.tie ? bundle_texels[ray.texel] : 0u;
    uint chosen = hit.node;
    for (uint i = 0u; i < slices; i++) {
        if (i >= count)
            break;
        uint node = i * texels + ray.texel;
        if (bundle_keys[node] == hit.key && comes_before(node, chosen))
            chosen = node;
    }
    uint left = count > slices ? count - slices : 0u;
    uint node = left > 0u ? bundle_texels[texels + 1u + ray.texel] : 0u;
    for (int turn = 0; turn < LSF_TURNS && left > 0u; turn++)
        for (int i = 0; i < LSF_STEPS && left > 0u; i++) {
            if (bundle_keys[node] == hit.key && comes_before(node, chosen))
                chosen = node;
            node = bundle_next[node - slices * texels];
            left--;
        }
    return chosen;
}

bool origin(ivec2 pixel, out vec3 position)
{
#if LSF_DEEP
    if (from_position) {
        vec4 texel = texelFetch(origin_position, pixel, 0);
        position = texel.xyz;
        return texel.w != 0.0;
    }
#endif
    float depth = texelFetch(origin_depth, pixel, 0).r;
    position = position_from_depth(sample_ndc(region_fragment()), depth);
    return depth != 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    hit_out = uvec2(0u, LSF_NO_NODE);
    vec3 position;
    if (!origin(pixel, position))
        return;
    vec3 q = bundle_coordinates(position);
    vec2 place = bundle_place(q), corner = floor(place);
    if (min(place.x, place.y) < 0.0 || max(place.x, place.y) >= bundle.range.z)
        return;
    vec3 normal = octahedral_decode(texelFetch(origin_surface, pixel, 0).x);
    float steps = LSF_BUNDLE_DEPTH_STEPS / bundle.range.y; /* a unit of length */
    vec2 texel = bundle_texel_size();
    bundle_ray ray;
    ray.texel = uint(corner.y) * bundle_side() + uint(corner.x);
    ray.depth = (q.z - bundle.range.x) * steps;
    ray.to_depth = (place - corner - 0.5) * texel * steps;
    ray.sign = dot(normal, bundle.forward.xyz) > 0.0 ? 1.0 : -1.0;
    ray.nearest = LSF_SELF_TEXELS * max(texel.x, texel.y) * steps + 0.5;
    bundle_hit hit = search(ray);
    uint node = settle_tie(ray, hit);
    if (node != LSF_NO_NODE)
        hit_out = uvec2(floatBitsToUint(hit.distance / steps), node);
}
