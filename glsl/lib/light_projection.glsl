/* The current light and the projection of its map; see shared/light_data.h. */
#ifndef LSF_LIB_LIGHT_PROJECTION
#define LSF_LIB_LIGHT_PROJECTION

#include "shared/light_data.h"
#include "shared/scene_data.h"

layout(std140, binding = LSF_BINDING_LIGHT) uniform lsf_light_block
{
    lsf_light_data light;
};

bool light_projection_perspective()
{
    return light.map_shape.y == 0.0;
}

/* The unit of a stored gradient: the depth itself in perspective maps, where depths span many orders of magnitude,
 * so that half floats hold it. */
float light_projection_depth_unit(float depth)
{
    return light_projection_perspective() ? depth : 1.0;
}

/* Coordinates of a point along right, up and forward of a face. */
vec3 light_projection_coordinates(int face, vec3 position)
{
    vec3 p = position - light.map_origin.xyz;
    return vec3(dot(light.map_right[face].xyz, p), dot(light.map_up[face].xyz, p),
                dot(light.map_forward[face].xyz, p));
}

/* Position on the face, -1..1, of a point with these coordinates. */
vec2 light_projection_face_position(int face, vec3 q)
{
    vec4 window = light.map_window[face];
    vec2 face_position = light_projection_perspective() ? q.xy / (q.z * window.zw) : (q.xy - window.xy) / window.zw;
    return face_position + light.map_offset.xy;
}

/* The point at a position on a face with this depth. */
vec3 light_projection_position(int face, vec2 face_position, float depth)
{
    vec4 window = light.map_window[face];
    vec3 q;
    if (light_projection_perspective()) {
        q.z = light.map_shape.x / depth;
        q.xy = (face_position - light.map_offset.xy) * window.zw * q.z;
    } else {
        q.z = light.map_shape.y - depth * (light.map_shape.y - light.map_shape.x);
        q.xy = (face_position - light.map_offset.xy) * window.zw + window.xy;
    }
    return light.map_origin.xyz + q.x * light.map_right[face].xyz + q.y * light.map_up[face].xyz +
           q.z * light.map_forward[face].xyz;
}

/* Largest distance of a texel's point from the plane of its surface, because vertices are moved by LSF_RASTER_STEP.
 * `distance`: to the light, or along the face's forward axis. */
float light_projection_raster_error(int face, vec3 normal, float distance)
{
    vec2 per_texel = abs(vec2(dot(light.map_right[face].xyz, normal), dot(light.map_up[face].xyz, normal)));
    per_texel *= 2.0 * light.map_shape.w * light.map_window[face].zw;
    return LSF_RASTER_STEP * (per_texel.x + per_texel.y) * (light_projection_perspective() ? distance : 1.0);
}

vec4 light_projection_clip(int face, vec3 position)
{
    vec3 q = light_projection_coordinates(face, position);
    vec4 window = light.map_window[face];
    if (light_projection_perspective())
        return vec4(q.xy / window.zw + light.map_offset.xy * q.z, light.map_shape.x, q.z);
    return vec4(light_projection_face_position(face, q),
                (light.map_shape.y - q.z) / (light.map_shape.y - light.map_shape.x), 1.0);
}

/* The face that shows the point: of a cube by the largest coordinate, of cascades the smallest window that holds
 * it. */
int light_projection_face(vec3 position)
{
    int faces = int(light.map_origin.w);
    if (!light_projection_perspective()) {
        vec3 q = light_projection_coordinates(0, position);
        for (int face = 0; face < faces - 1; face++) {
            vec2 face_position = abs(light_projection_face_position(face, q));
            if (max(face_position.x, face_position.y) < 1.0)
                return face;
        }
        return faces - 1;
    }
    if (faces == 1)
        return 0;
    vec3 p = position - light.map_origin.xyz;
    vec3 c = vec3(dot(light.map_forward[0].xyz, p), dot(light.map_forward[2].xyz, p),
                  dot(light.map_forward[4].xyz, p));
    vec3 a = abs(c);
    if (a.x >= a.y && a.x >= a.z)
        return c.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z)
        return c.y >= 0.0 ? 2 : 3;
    return c.z >= 0.0 ? 4 : 5;
}

#endif
