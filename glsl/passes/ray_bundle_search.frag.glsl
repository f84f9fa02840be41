/* The nearest fragment beyond each origin, along the bundle or against it, by the side that the
 * origin's surface faces. Switches LSF_ORTHOGRAPHIC, LSF_INTERLEAVE, LSF_DEEP and those of
 * lib/ray_bundle.glsl.
 *
 * Lists are read as buffer textures, which software GL fetches for all lanes at once and storage
 * buffers lane by lane. */
#define LSF_BUNDLE_TIE_ACCESS coherent
#include "lib/ray_bundle.glsl"
#include "lib/view.glsl"
#include "passes/ray_bundle_ties.glsl"

layout(binding = 0) uniform sampler2D origin_depth;
layout(binding = 1) uniform usampler2D origin_surface;
#if LSF_DEEP
layout(binding = 2) uniform sampler2D origin_position;
layout(location = 0) uniform bool from_position;
#endif
layout(binding = 3) uniform usamplerBuffer texel_fetch;
layout(binding = 4) uniform usamplerBuffer key_fetch; /* four at once */
layout(binding = 5) uniform usamplerBuffer chain_fetch;
/* LSF_BUNDLE_SLICES / 4; not known when compiled, or software GL unrolls the loop and walks through
 * empty slices, too. */
layout(location = 2) uniform int slices_of_four;

in vec3 view_start, view_along;
flat in vec3 bundle_forward;
flat in vec4 ray_scale;

layout(location = 0) out uvec2 hit_out; /* distance as float bits, node */

struct bundle_ray {
    int texel;
    float depth;   /* of the origin, in steps of the keys */
    vec2 to_depth; /* steps for a slope of 1: from the texel's centre to the ray */
    float sign;    /* 1 along the bundle, -1 against it */
};

/* On the map: texels, texels, steps of depth. */
bool origin(ivec2 pixel, out vec3 place)
{
#if LSF_DEEP
    if (from_position) {
        vec4 texel = texelFetch(origin_position, pixel, 0);
        vec3 q = bundle_coordinates(texel.xyz);
        place = vec3(bundle_place(q), (q.z - bundle.range.x) * ray_scale.z);
        return texel.w != 0.0;
    }
#endif
    float depth = texelFetch(origin_depth, pixel, 0).r;
    place = view_start + view_depth(depth) * view_along;
    return depth != 0.0;
}

/* Which side of the bundle's plane a surface faces; no need for unit length. */
float facing(uint normal)
{
    vec2 p = unpackSnorm2x16(normal);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * octahedral_sign(n.xy);
    return dot(n, bundle_forward) > 0.0 ? 1.0 : -1.0;
}

/* `count`: fragments in its texel, 0 when there is no ray. */
bundle_ray ray_of(ivec2 pixel, out int count)
{
    vec3 place;
    bool present = origin(pixel, place);
    ivec2 at = ivec2(floor(place.xy));
    present = present && min(at.x, at.y) >= 0 && max(at.x, at.y) < LSF_BUNDLE_SIDE;
    bundle_ray ray;
    ray.texel = at.y * LSF_BUNDLE_SIDE + at.x;
    ray.depth = place.z;
    ray.to_depth = (place.xy - vec2(at) - 0.5) * ray_scale.xy;
    ray.sign = facing(texelFetch(origin_surface, pixel, 0).x);
    count = present ? int(texelFetch(texel_fetch, ray.texel).x) : 0;
    return ray;
}

struct bundle_hit {
    float distance; /* steps of depth */
    uint key;
    int node;
    bool tie; /* another node has the same key */
};

/* The node becomes the hit when its plane is nearer; between planes equally near the key decides, so
 * that the list's order does not. */
void visit(bundle_ray ray, bool present, uint key, int node, inout bundle_hit hit)
{
    vec2 slope = bundle_key_slope(key);
    float depth = bundle_key_depth(key) + dot(slope, ray.to_depth);
    float distance = ray.sign * (depth - ray.depth);
    /* The origin's own surface: its distance from the plane is the one along the ray over
     * sqrt(1 + slope^2). */
    bool beyond = present && distance > 0.0 &&
                  distance * distance > ray_scale.w * (1.0 + dot(slope, slope));
    bool same = beyond && distance == hit.distance;
    bool nearer = (beyond && distance < hit.distance) ||
                  (same && key < hit.key);
    hit.tie = !nearer && (hit.tie || (same && key == hit.key));
    hit.distance = nearer ? distance : hit.distance;
    hit.key = nearer ? key : hit.key;
    hit.node = nearer ? node : hit.node;
}

bundle_hit search(bundle_ray ray, int count)
{
    const int texels = int(LSF_BUNDLE_TEXELS);
    bundle_hit hit = bundle_hit(1e30, LSF_NO_NODE, -1, false);
#if LSF_BUNDLE_SLICES
    for (int i = 0; i < slices_of_four; i++) {
        if (4 * i >= count)
            break;
        int at = i * texels + ray.texel;
        uvec4 keys = texelFetch(key_fetch, at);
        visit(ray, true, keys.x, 4 * at, hit);
        visit(ray, 4 * i + 1 < count, keys.y, 4 * at + 1, hit);
        visit(ray, 4 * i + 2 < count, keys.z, 4 * at + 2, hit);
        visit(ray, 4 * i + 3 < count, keys.w, 4 * at + 3, hit);
    }
#endif
    int left = count - LSF_BUNDLE_SLICES;
    int link = left > 0 ? int(texelFetch(texel_fetch, int(LSF_BUNDLE_FIRST_HEAD) + ray.texel).x) : 0;
    for (uint turn = 0u; turn < LSF_TURNS && left > 0; turn++)
        for (uint i = 0u; i < LSF_STEPS && left > 0; i++) {
            uvec4 node = texelFetch(chain_fetch, link);
            visit(ray, true, node.x, int(LSF_BUNDLE_FIRST_LINK) + link, hit);
            link = int(node.y);
            left--;
        }
    return hit;
}

void main()
{
    int count;
    bundle_ray ray = ray_of(ivec2(gl_FragCoord.xy), count);
    bundle_hit hit = search(ray, count);
    if (hit.tie)
        ties[atomicAdd(tie_count, 1u)] = uint(gl_FragCoord.x) | uint(gl_FragCoord.y) << 16;
    /* -1 is LSF_NO_NODE */
    hit_out = uvec2(hit.node < 0 ? 0u : floatBitsToUint(hit.distance / ray_scale.z),
                    uint(hit.node));
}
