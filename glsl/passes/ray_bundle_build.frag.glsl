/* Appends every fragment of the scene to the list of its texel. Switches of lib/material.glsl and
 * lib/ray_bundle.glsl. */
#include "lib/material.glsl"
#include "passes/ray_bundle_append.glsl"

void main()
{
    vec2 depth_change = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    surface s;
    vec3 emission;
    bool front;
    if (!material_evaluate(-bundle.forward.xyz, s, emission, front))
        discard;
    append_surface(uint(bundle_texel(ivec2(gl_FragCoord.xy))),
                   bundle_plane_pack(gl_FragCoord.z,
                                     depth_change * bundle.range.y / bundle_texel_size()),
                   s, emission,
                   (material_emits(front) ? LSF_BUNDLE_EMITS_BACK : 0u) |
                       (material_emits(!front) ? LSF_BUNDLE_EMITS_AHEAD : 0u));
}
