/* Depth of the nearest back of a medium behind the visible surface, on the straight line of sight. */
#include "passes/gbuffer_fragment.glsl"

layout(binding = LSF_UNIT_SEEN_DEPTH) uniform sampler2D depth_texture;

void main()
{
    vec3 to_viewer = fragment_to_viewer();
    surface s;
    vec3 emission;
    bool front;
    bool present = material_evaluate(to_viewer, s, emission, front);
    if (!present || front || !s.volume || gl_FragCoord.z >= texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r)
        discard;
}
