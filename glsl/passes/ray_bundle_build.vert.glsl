#include "lib/bundle_map.glsl"
#include "lib/material_vertex.glsl"

layout(std140, binding = LSF_BINDING_BUNDLE) uniform lsf_bundle_block
{
    lsf_bundle_data bundle;
};

void main()
{
    vec3 p = instance_position(position);
    vec3 q = bundle_map_coordinates(bundle, p);
    gl_Position = vec4((q.xy - bundle.window.xy) / bundle.window.zw,
                       (q.z - bundle.range.x) / bundle.range.y, 1.0);
    material_vertex(p);
}
