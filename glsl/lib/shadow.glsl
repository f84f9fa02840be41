/* Visibility from the light's map. Switches LSF_SHADOW_PCF, the side of a filter or 0,
 * LSF_SHADOW_HEMISPHERE for the map of a VPL (see lib/hemisphere.glsl), LSF_SHADOW_SKY for maps of the environment
 * (lib/sky_map.glsl), and LSF_SHADOW_TINT where light may come through thin walls.
 *
 * A texel stores the depth of the surface at its centre; the receiver lies elsewhere in the texel.
 * Depth is affine over a plane, so either surface can be continued to the other's place:
 *  - the occluder's plane, by its stored gradient, to the receiver: at an inner corner the
 *    neighbouring wall then lies behind, not before, the receiver;
 *  - the receiver's plane, by its normal, to the texel's centre: at an outer edge the
 *    neighbouring face then lies behind it.
 * A surface must be in front by both to cast a shadow. Neither test needs a bias that grows with
 * slope; what is left is rounding: of depths, of planes, of the occluder's vertices on the map (LSF_RASTER_STEP), and of
 * the receiver's position, which may lie off its surface by light.map_offset.z and shadow_raster_error. */
#ifndef LSF_LIB_SHADOW
#define LSF_LIB_SHADOW

#include "lib/branch.glsl"
#include "shared/scene_data.h"
#if LSF_SHADOW_SKY
#include "lib/sky_map.glsl"
#else
#include "lib/hemisphere.glsl"
#include "lib/light_projection.glsl"
#endif

#if LSF_SHADOW_HEMISPHERE
layout(binding = LSF_UNIT_SHADOW_DEPTH) uniform usampler2D shadow_map;
#elif LSF_SHADOW_SKY
layout(binding = LSF_UNIT_SHADOW_DEPTH) uniform usampler2DArray shadow_map;
int shadow_sky_map = 0; /* index of the current map */
#else
layout(binding = LSF_UNIT_SHADOW_DEPTH) uniform sampler2DArray shadow_depth;
#endif
#if !LSF_SHADOW_PCF && !LSF_SHADOW_HEMISPHERE && !LSF_SHADOW_SKY
layout(binding = LSF_UNIT_SHADOW_GRADIENT) uniform sampler2DArray shadow_gradient;
#endif

#ifndef LSF_SHADOW_TINT
#define LSF_SHADOW_TINT 0
#endif
#if LSF_SHADOW_TINT
#if LSF_SHADOW_HEMISPHERE
layout(binding = LSF_UNIT_SHADOW_TINT) uniform sampler2D shadow_tint_texture;
#else
layout(binding = LSF_UNIT_SHADOW_TINT) uniform sampler2DArray shadow_tint_texture;
#endif
#endif

/* Largest distance of the receiver from its surface because vertices were moved (LSF_RASTER_STEP). Shaders whose
 * receivers were found by the pipeline set it; for others it is 0. [normalised space] */
float shadow_raster_error = 0.0;

/* Relative rounding error of interpolated depth in a perspective map. */
#define LSF_SHADOW_EPSILON 2e-5

/* Rounding error of an orthographic map: eight roundings (2^-24) of depths, which are 0..1; and, in widths of a
 * texel, the error of planes half a texel from where they are exact. Slopes s are stored as half floats, within
 * 2^-12 s, and normals within 6.5e-5 rad, which is 6.5e-5 (1 + s^2) of a slope. The bound covers s <= 25, 2.3
 * degrees from grazing light. */
#define LSF_SHADOW_DEPTH_ERROR 4.8e-7
#define LSF_SHADOW_SLOPE_ERROR 0.02

/* Step of the tint in a map: 10 bits. */
#define LSF_SHADOW_TINT_STEP (1.0 / 1023.0)

/* The receiver's position on the map and its plane there. */
struct shadow_receiver {
    vec2 texel;    /* continuous texel coordinates */
    float depth;
    float error;   /* rounding error of the depth */
    vec2 gradient; /* change of depth per texel over the receiver's plane */
    ivec2 at;      /* the texel that holds it */
    int face;
};

/* Error of a depth on the map, of a plane with this gradient, because vertices are moved (LSF_RASTER_STEP). */
float shadow_vertex_error(vec2 gradient)
{
    return LSF_RASTER_STEP * (abs(gradient.x) + abs(gradient.y));
}

#if LSF_SHADOW_HEMISPHERE

/* The receiver is projected in the octant of the texel's centre, where the texel's plane is known. It is lifted
 * off its surface, because a VPL may be close to the receiver and light near the map's origin is bright. */
shadow_receiver shadow_project(vec3 position, vec3 normal)
{
    shadow_receiver r;
    float lift = light.map_offset.z + shadow_raster_error;
    vec3 local = hemisphere_local(position + lift * normal - light.map_origin.xyz);
    float texels = light.map_shape.z;
    vec3 q = hemisphere_project(hemisphere_octant(local), local);
    r.at = clamp(ivec2((q.xy / q.z * 0.5 + 0.5) * texels), ivec2(0), ivec2(int(texels) - 1));
    vec2 octant = hemisphere_octant_of_texel(r.at, int(texels));
    q = hemisphere_project(octant, local);
    vec3 local_normal = hemisphere_local(normal);
    vec3 n = hemisphere_project_normal(octant, local_normal);
    r.face = 0;
    r.texel = (q.xy / q.z * 0.5 + 0.5) * texels;
    r.depth = light.map_shape.x / q.z;
    r.gradient = light.map_shape.x * 2.0 / (texels * dot(local_normal, local)) * n.xy;
    r.error = (LSF_SHADOW_EPSILON + HEMISPHERE_DEPTH_ERROR) * r.depth + shadow_vertex_error(r.gradient);
    return r;
}

#elif LSF_SHADOW_SKY

shadow_receiver shadow_project(vec3 position, vec3 normal)
{
    shadow_receiver r;
    r.face = shadow_sky_map;
    vec3 projected = sky_map_project(r.face, position);
    vec4 texel = sky_maps[r.face].texel;
    /* Slopes along unit axes. */
    vec3 n = vec3(dot(sky_maps[r.face].right.xyz, normal) * texel.x,
                  dot(sky_maps[r.face].up.xyz, normal) * texel.y,
                  dot(sky_maps[r.face].to_sky.xyz, normal));
    r.texel = projected.xy;
    r.depth = projected.z;
    r.gradient = texel.xy * n.xy / (-n.z * texel.z);
    r.error = LSF_SHADOW_DEPTH_ERROR + SKY_MAP_DEPTH_ERROR +
              (LSF_SHADOW_SLOPE_ERROR * max(texel.x, texel.y) +
               (sky_maps[r.face].error.x + shadow_raster_error) / abs(n.z)) / texel.z +
              shadow_vertex_error(r.gradient);
    r.at = clamp(ivec2(floor(r.texel)), ivec2(0), ivec2(int(texel.w) - 1));
    return r;
}

#else

shadow_receiver shadow_project(vec3 position, vec3 normal)
{
    shadow_receiver r;
    r.face = light_projection_face(position);
    vec3 q = light_projection_coordinates(r.face, position);
    vec3 n = vec3(dot(light.map_right[r.face].xyz, normal), dot(light.map_up[r.face].xyz, normal),
                  dot(light.map_forward[r.face].xyz, normal));
    vec2 extent = light.map_window[r.face].zw;
    float off = light.map_offset.z + shadow_raster_error;
    if (light_projection_perspective()) {
        /* On the plane n.q = c, near / q.z = near / c (n.z + n.xy extent (x, y)). */
        float c = dot(n, q);
        r.depth = light.map_shape.x / q.z;
        r.gradient = light.map_shape.x / c * extent * n.xy;
        r.error = r.depth * (LSF_SHADOW_EPSILON + off / abs(c));
    } else {
        /* q.z = (c - n.xy extent (x, y)) / n.z */
        float range = light.map_shape.y - light.map_shape.x;
        r.depth = (light.map_shape.y - q.z) / range;
        r.gradient = extent * n.xy / (n.z * range);
        r.error = LSF_SHADOW_DEPTH_ERROR +
                  (LSF_SHADOW_SLOPE_ERROR * 2.0 * light.map_shape.w * max(extent.x, extent.y) +
                   off / abs(n.z)) / range;
    }
    float texels = light.map_shape.z;
    r.texel = (light_projection_face_position(r.face, q) * 0.5 + 0.5) * texels;
    r.gradient *= 2.0 / texels;
    r.error += shadow_vertex_error(r.gradient);
    r.at = clamp(ivec2(floor(r.texel)), ivec2(0), ivec2(int(texels) - 1));
    return r;
}

#endif

int shadow_texels(shadow_receiver r)
{
#if LSF_SHADOW_SKY
    return int(sky_maps[r.face].texel.w);
#else
    return int(light.map_shape.z);
#endif
}

#if LSF_SHADOW_PCF

/* Percentage-closer filter (Reeves et al. 1987) over LSF_SHADOW_PCF texels along each axis about the receiver, an
 * even number. Each texel is compared with the receiver's plane. */
float shadow_visibility(vec3 position, vec3 normal, bool transmits)
{
    const int squares = LSF_SHADOW_PCF / 2; /* of 2 x 2 texels, which one gather reads */
    shadow_receiver r = shadow_project(position, normal);
    float side = float(shadow_texels(r));
    vec2 corner = floor(r.texel - 0.5) - float(squares - 1);
    vec4 lit = vec4(0.0);
    for (int i = 0; i < squares * squares; i++) {
        vec2 at = corner + 2.0 * vec2(i % squares, i / squares); /* lower left texel of the four */
        at = clamp(at, vec2(0.0), vec2(side - 2.0));
#if LSF_SHADOW_SKY
        uvec4 keys = textureGather(shadow_map, vec3((at + 1.0) / side, r.face));
        vec4 depth = vec4(sky_map_depth(keys.x), sky_map_depth(keys.y), sky_map_depth(keys.z),
                          sky_map_depth(keys.w));
#else
        vec4 depth = textureGather(shadow_depth, vec3((at + 1.0) / side, r.face));
#endif
        vec4 receiver = r.depth + r.gradient.x * (vec4(at.x) + vec4(0.5, 1.5, 1.5, 0.5) - r.texel.x) +
                        r.gradient.y * (vec4(at.y) + vec4(1.5, 1.5, 0.5, 0.5) - r.texel.y);
        lit += vec4(lessThanEqual(depth, receiver + r.error));
    }
    return dot(lit, vec4(1.0)) / float(LSF_SHADOW_PCF * LSF_SHADOW_PCF);
}

#else

/* 1 where both planes put a texel's surface in front of the receiver, -1 where both put it behind; otherwise (0)
 * the surfaces are the same or meet within the texel. */
int shadow_order(shadow_receiver r, ivec2 at)
{
    vec2 to_center = vec2(at) + 0.5 - r.texel;
    float slope_error = 0.0; /* at the receiver */
#if LSF_SHADOW_HEMISPHERE
    uint texel = texelFetch(shadow_map, at, 0).r;
    float depth = hemisphere_unpack_depth(texel);
    vec2 gradient = hemisphere_unpack_slope(texel) * (depth * 2.0 * light.map_shape.w);
#elif LSF_SHADOW_SKY
    uint key = texelFetch(shadow_map, ivec3(at, r.face), 0).r;
    float depth = sky_map_depth(key);
    vec2 slope = plane_key_slope(key), steeper = 1.0 + abs(slope);
    vec2 unit = sky_maps[r.face].texel.xy / sky_maps[r.face].texel.z;
    vec2 gradient = slope * unit;
    slope_error = SKY_MAP_SLOPE_ERROR * dot(steeper * steeper, abs(to_center) * unit);
#else
    float depth = texelFetch(shadow_depth, ivec3(at, r.face), 0).r;
    vec2 gradient = vec2(0.0);
    if (depth > 0.0) /* empty texels have no gradient */
        gradient = texelFetch(shadow_gradient, ivec3(at, r.face), 0).rg * light_projection_depth_unit(depth);
#endif
    float at_receiver = depth - dot(gradient, to_center) - r.depth;
    float at_center = depth - r.depth - dot(r.gradient, to_center);
    if (min(at_receiver - slope_error, at_center) > r.error)
        return 1;
    return max(at_receiver + slope_error, at_center) < -r.error ? -1 : 0;
}

/* A texel that shows something behind the receiver says nothing about the receiver: its centre is past an edge,
 * either of the receiver's own surface, which is then lit, or of one that occludes it, as at the edges of a closed
 * room lit from outside. The texels on the receiver's other sides decide: any of them that shows the receiver's
 * surface proves the first, else any that shows one in front proves the second. Where the receiver transmits
 * light, it and others are present in a texel with some probability only, and prove nothing. */
float shadow_visibility(vec3 position, vec3 normal, bool transmits)
{
    shadow_receiver r = shadow_project(position, normal);
    int order = shadow_order(r, r.at);
#if !LSF_SHADOW_HEMISPHERE
    BRANCH(order < 0 && !transmits) {
        ivec2 last = ivec2(shadow_texels(r) - 1);
        ivec2 step_to = ivec2(r.texel.x - float(r.at.x) >= 0.5 ? 1 : -1,
                              r.texel.y - float(r.at.y) >= 0.5 ? 1 : -1);
        for (int i = 1; i < 4; i++) {
            ivec2 at = clamp(r.at + step_to * ivec2(i & 1, i >> 1), ivec2(0), last);
            int beside = shadow_order(r, at);
            if (beside == 0)
                return 1.0;
            order = max(order, beside);
        }
    }
#endif
    return order > 0 ? 0.0 : 1.0;
}

#endif

float shadow_visibility(vec3 position, vec3 normal)
{
    return shadow_visibility(position, normal, false);
}

/* Transmittance of the surfaces between light and receiver, where the receiver is visible from the light. `own`:
 * the receiver's tint for light that it transmits, 1 where it transmits none. A receiver that the map does not
 * show was absent there, so that the map's tint includes its own. */
vec3 shadow_tint(vec3 position, vec3 normal, vec3 own)
{
#if LSF_SHADOW_TINT
    shadow_receiver r = shadow_project(position, normal);
#if LSF_SHADOW_HEMISPHERE
    float shown = hemisphere_unpack_depth(texelFetch(shadow_map, r.at, 0).r);
    vec3 tint = texelFetch(shadow_tint_texture, r.at, 0).rgb;
#elif LSF_SHADOW_SKY
    float shown = sky_map_depth(texelFetch(shadow_map, ivec3(r.at, r.face), 0).r);
    vec3 tint = texelFetch(shadow_tint_texture, ivec3(r.at, r.face), 0).rgb;
#else
    float shown = texelFetch(shadow_depth, ivec3(r.at, r.face), 0).r;
    vec3 tint = texelFetch(shadow_tint_texture, ivec3(r.at, r.face), 0).rgb;
#endif
    float here = r.depth + dot(r.gradient, vec2(r.at) + 0.5 - r.texel);
    return min(shown < here - r.error ? tint / max(own, LSF_SHADOW_TINT_STEP) : tint, 1.0);
#else
    return vec3(1.0);
#endif
}

#endif
