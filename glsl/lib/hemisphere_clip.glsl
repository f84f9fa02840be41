/* Clip-space vertices of one octant of a hemisphere's map, for the pipeline. */
#ifndef LSF_LIB_HEMISPHERE_CLIP
#define LSF_LIB_HEMISPHERE_CLIP

#include "lib/hemisphere.glsl"

out float gl_ClipDistance[2];

/* `octant_index`: bit 0 for x < 0, bit 1 for y < 0; `position` in normalised space. */
void hemisphere_vertex(uint octant_index, vec3 position)
{
    vec2 octant = vec2((octant_index & 1u) == 0u ? 1.0 : -1.0,
                       (octant_index & 2u) == 0u ? 1.0 : -1.0);
    vec3 local = hemisphere_local(position - light.map_origin.xyz);
    vec3 q = hemisphere_project(octant, local);
    gl_Position = vec4(q.xy, light.map_shape.x, q.z);
    float shift = 2.0 * HEMISPHERE_SHIFT * light.map_shape.w * q.z;
    gl_ClipDistance[0] = octant.x * (local.x + shift);
    gl_ClipDistance[1] = octant.y * (local.y + shift);
}

#endif
