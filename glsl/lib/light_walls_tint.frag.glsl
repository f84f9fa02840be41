/* Tint of light that has passed the thin walls in front of the map's surface: the product over all of them, in any
 * order. Switches LSF_ABSORPTION (there are media) and those of lib/material.glsl. */
#include "lib/light_projection.glsl"
#include "lib/material.glsl"
#include "lib/straight.glsl"
#include "lib/map_absorption.glsl"

layout(location = 0) uniform int face;
layout(binding = LSF_UNIT_SEEN_DEPTH) uniform sampler2DArray depth_texture;

layout(location = 0) out vec4 tint_out; /* multiplied */

void main()
{
    vec3 to_light = light_projection_perspective() ? -vertex_position : -light.direction.xyz;
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(to_light, s, emission, front);
    bool enters = map_light_enters(front, to_light);
    float shown = texelFetch(depth_texture, ivec3(gl_FragCoord.xy, face), 0).r;
    if (!present || gl_FragCoord.z <= shown)
        discard;
    /* Media transmit light of the sky alone, whose maps are orthographic. */
    float path_length = (gl_FragCoord.z - shown) * (light.map_shape.y - light.map_shape.x);
    tint_out = vec4(straight_tint(s, to_light) * map_absorption(s, enters, path_length), 1.0);
}
