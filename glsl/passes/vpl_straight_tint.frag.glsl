/* Tint of light that has passed what is not there, before what the map shows: of all of it the product, in any
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
    /* What is there itself lies at its own depth, but for the map's rounding. */
    if (!present || gl_FragCoord.z <= shown * (1.0 + 2.0 * HEMISPHERE_DEPTH_ERROR))
        discard;
    /* Depths are as the inverse of distances. */
    float way = length(vertex_position) * (gl_FragCoord.z / max(shown, 1e-9) - 1.0);
    tint_out = vec4(straight_tint(s, -vertex_position) * map_absorption(s, enters, way), 1.0);
}
