/* Rays in a bundle's coordinates, and their hits. Switches LSF_ORTHOGRAPHIC, LSF_SPARSE, LSF_INTERLEAVE, LSF_DEEP,
 * LSF_BUNDLE_SURFACES (nodes store surfaces, which break ties) and those of lib/ray_bundle.glsl.
 *
 * Lists are read as buffer textures, because software GL fetches those for all lanes at once and storage buffers
 * lane by lane. */
#ifndef LSF_PASSES_RAY_BUNDLE_RAY
#define LSF_PASSES_RAY_BUNDLE_RAY

#include "lib/ray_bundle.glsl"
#include "lib/sparse.glsl"
#include "passes/ray_bundle_frame.glsl"

layout(binding = 0) uniform sampler2D origin_depth;
layout(binding = 1) uniform usampler2D origin_surface;
#if LSF_DEEP
layout(binding = 2) uniform sampler2D origin_position;
layout(location = 0) uniform bool from_position;
#endif
layout(binding = 3) uniform usamplerBuffer head_fetch;
layout(binding = 4) uniform usamplerBuffer key_fetch; /* four at once */
layout(binding = 5) uniform usamplerBuffer chain_fetch;

struct bundle_ray {
    int texel;
    float depth;   /* depth of the origin, in steps of the keys */
    vec2 to_depth; /* depth steps for a slope of 1, from the texel's centre to the ray */
    float sign;    /* 1 along the bundle, -1 against it */
    float self;    /* as in bundle_frame */
    uvec4 first;   /* its texel's first slice */
    int count;     /* fragments in its texel, 0 where there is no ray */
};

/* The ray's origin in texels and depth steps. */
bool origin(ivec2 pixel, bundle_frame frame, out vec3 position)
{
#if LSF_DEEP
    if (from_position) {
        vec4 texel = texelFetch(origin_position, pixel, 0);
        vec3 q = bundle_coordinates(texel.xyz);
        position = vec3(bundle_map_position(q), (q.z - bundle.range.x) * frame.scale.z);
        return texel.w != 0.0;
    }
#endif
    float depth = texelFetch(origin_depth, pixel, 0).r;
#if LSF_SPARSE
    vec3 q = bundle_coordinates(position_from_depth(position_ndc(pixel), depth));
    position = vec3(bundle_map_position(q), (q.z - bundle.range.x) * frame.scale.z);
    return depth != 0.0;
#endif
    position = frame.start + view_depth_from_start(depth) * frame.along;
#if LSF_BUNDLE_GAPS
    position = map_position(position, frame.scale.z);
#endif
    return depth != 0.0;
}

/* Sign tells the side of the bundle's plane that a surface faces; not normalised. */
float facing(uint normal, vec3 forward)
{
    ivec2 p = ivec2(int(normal << 16) >> 16, int(normal) >> 16);
    ivec2 size = abs(p);
    int z = 32767 - size.x - size.y;
    ivec2 folded = 32767 - size.yx;
    if (z < 0)
        p = ivec2(p.x < 0 ? -folded.x : folded.x, p.y < 0 ? -folded.y : folded.y);
    return dot(vec3(p, z), forward) > 0.0 ? 1.0 : -1.0;
}

bundle_ray ray_of(ivec2 pixel, bundle_frame frame)
{
    vec3 position;
    bool present = origin(pixel, frame, position);
    ivec2 at = ivec2(floor(position.xy));
    present = present && bundle_has(at);
    bundle_ray ray;
    ray.texel = present ? bundle_texel(at) : 0;
    ray.depth = position.z;
    ray.to_depth = (position.xy - vec2(at) - 0.5) * frame.scale.xy;
    ray.sign = facing(texelFetch(origin_surface, pixel, 0).x, frame.forward);
    ray.self = frame.scale.w;
    ray.first = texelFetch(key_fetch, ray.texel);
    ray.count = present ? int(ray.first.x) : 0;
    return ray;
}

struct bundle_hit {
    float distance; /* steps of depth */
    uint key;
    int node;
    bool tie; /* another node has the same key */
};

/* The node becomes the hit when its plane is nearer. Between equally near planes the key decides, so that the
 * order of the list does not. */
void visit(bundle_ray ray, bool present, uint key, int node, inout bundle_hit hit)
{
    vec2 slope = plane_key_slope(key);
    float depth = bundle_key_depth(key) + dot(slope, ray.to_depth);
    float distance = ray.sign * (depth - ray.depth);
    /* The test excludes the origin's own surface, by the distance from the plane: the distance along the ray over
     * sqrt(1 + slope^2). */
    bool beyond = present && distance > 0.0 &&
                  distance * distance > ray.self * (1.0 + dot(slope, slope));
#if LSF_STRAIGHT
    beyond = beyond && !bundle_is_veil(key);
#endif
#if LSF_BUNDLE_SURFACES
    bool same = beyond && distance == hit.distance;
    bool nearer = (beyond && distance < hit.distance) || (same && key < hit.key);
    hit.tie = !nearer && (hit.tie || (same && key == hit.key));
    hit.key = nearer ? key : hit.key;
#else
    bool nearer = beyond && distance < hit.distance;
#endif
    hit.distance = nearer ? distance : hit.distance;
    hit.node = nearer ? node : hit.node;
}

/* The nearest hit among the fragments in slices. */
bundle_hit search_slices(bundle_ray ray)
{
    int texels = int(bundle_texels()), count = min(ray.count, int(bundle.sliced));
    bundle_hit hit = bundle_hit(1e30, LSF_NO_NODE, -1, false);
    visit(ray, count > 0, ray.first.y, 4 * ray.texel + 1, hit);
    visit(ray, count > 1, ray.first.z, 4 * ray.texel + 2, hit);
    visit(ray, count > 2, ray.first.w, 4 * ray.texel + 3, hit);
    for (int i = 1; 4 * i <= count; i++) {
        int at = i * texels + ray.texel;
        uvec4 keys = texelFetch(key_fetch, at);
        visit(ray, true, keys.x, 4 * at, hit);
        visit(ray, 4 * i < count, keys.y, 4 * at + 1, hit);
        visit(ray, 4 * i + 1 < count, keys.z, 4 * at + 2, hit);
        visit(ray, 4 * i + 2 < count, keys.w, 4 * at + 3, hit);
    }
    return hit;
}

#endif
