/* Places a VPL at a point of an emissive surface that the host has drawn (scene/emitters.h). */
#include "lib/vpl_write.glsl"

layout(local_size_x = 1) in;

layout(location = 0) uniform uint index;
layout(location = 1) uniform vec4 position; /* w: the map's turn */
layout(location = 2) uniform vec4 normal;   /* w: density by area */
layout(location = 3) uniform vec4 radiance; /* w: the density that goes into the weights */
layout(location = 4) uniform vec2 map_shape; /* as in vpl_map_write */

void main()
{
    lsf_vpl_data vpl;
    vpl.position = vec4(position.xyz, LSF_VPL_EMITS);
    vpl.geometric_normal = normal;
    vpl.normal = vpl.base_color = vpl.specular_params = vpl.to_light = vec4(0.0);
    vpl.intensity = radiance;
    vpls[index] = vpl;
    vpl_map_write(index, position.xyz, normal.xyz, 0.0, position.w, map_shape);
}
