/* For shaders that place VPLs: the buffers that they write, and the map over each VPL. */
#ifndef LSF_LIB_VPL_WRITE
#define LSF_LIB_VPL_WRITE

#include "lib/octahedral.glsl"
#include "shared/brdf.h"
#include "shared/light_data.h"
#include "shared/scene_data.h"
#include "shared/vpl_data.h"

struct vpl_map_slot {
    lsf_light_data map;
    vec4 unused; /* pads to a multiple of a uniform buffer's alignment */
};
layout(std430, binding = LSF_BINDING_VPL) writeonly buffer lsf_vpl_block
{
    lsf_vpl_data vpls[];
};
layout(std430, binding = 2) writeonly buffer lsf_vpl_map_block
{
    vpl_map_slot vpl_maps[];
};

/* Distance of the nearest occluder in a VPL's map. */
#define VPL_NEAR_PLANE 1e-5

/* The map over a VPL. `shape`: texels along a side; rounding error of positions. The map's origin is that far
 * above the VPL's surface, plus `error`, the further error of the VPL's position, because the surface would shadow
 * its own light otherwise. `rotation`: rotation about the normal, 0..1. */
void vpl_map_write(uint index, vec3 position, vec3 normal, float error, float rotation, vec2 shape)
{
    lsf_light_data map;
    vec3 t, b;
    orthonormal_basis(normal, t, b);
    float angle = 2.0 * LSF_PI * rotation;
    vec3 origin = position + (shape.y + error) * normal;
    map.position = vec4(origin, 0.0);
    map.direction = vec4(normal, 0.0);
    map.intensity = map.attenuation = vec4(0.0);
    map.map_offset = vec4(0.0, 0.0, shape.y, 0.0);
    map.map_origin = vec4(origin, 1.0);
    map.map_shape = vec4(VPL_NEAR_PLANE, 0.0, shape.x, 1.0 / shape.x);
    map.map_window[0] = vec4(0.0, 0.0, 1.0, 1.0);
    map.map_right[0] = vec4(cos(angle) * t + sin(angle) * b, 0.0);
    map.map_up[0] = vec4(cos(angle) * b - sin(angle) * t, 0.0);
    map.map_forward[0] = vec4(normal, 0.0);
    for (int face = 1; face < 6; face++)
        map.map_window[face] = map.map_right[face] = map.map_up[face] = map.map_forward[face] =
            vec4(0.0);
    vpl_maps[index].map = map;
}

#endif
