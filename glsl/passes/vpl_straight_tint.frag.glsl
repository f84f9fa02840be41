/* Tint of light that has passed the absent surfaces in front of the map's: the product over all of them, in any
 * order. Switches LSF_ABSORPTION (there are media) and those of lib/material.glsl. */
#include "lib/hemisphere.glsl"
#include "lib/material.glsl"
#include "lib/straight.glsl"
#include "lib/map_absorption.glsl"

layout(binding = LSF_UNIT_SEEN_DEPTH) uniform usampler2D map_texture;

layout(location = 0) out vec4 tint_out; /* multiplied */

void main()
{
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(-vertex_position, s, emission, front);
    bool enters = map_light_enters(front, -vertex_position);
    float shown = hemisphere_unpack_depth(texelFetch(map_texture, ivec2(gl_FragCoord.xy), 0).r);
    /* A surface that is present lies at its own depth in the map, within the map's rounding. */
    if (!present || gl_FragCoord.z <= shown * (1.0 + 2.0 * HEMISPHERE_DEPTH_ERROR))
        discard;
    /* Depth is the inverse of distance. */
    float path_length = length(vertex_position) * (gl_FragCoord.z / max(shown, 1e-9) - 1.0);
    tint_out = vec4(straight_tint(s, -vertex_position) * map_absorption(s, enters, path_length), 1.0);
}
