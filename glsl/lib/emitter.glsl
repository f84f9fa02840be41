/* Points on emissive surfaces, sampled in proportion to their power. */
#ifndef LSF_LIB_EMITTER
#define LSF_LIB_EMITTER

#include "shared/emitter_data.h"

layout(std430, binding = LSF_BINDING_EMITTERS) readonly buffer lsf_emitter_block
{
    lsf_emitter_point_data emitter_points[];
};

/* `u` in [0, 1)^2: stratified values give points that are stratified over the emitters. */
lsf_emitter_point_data emitter_draw(vec2 u)
{
    uvec2 cell = uvec2(u * float(LSF_EMITTER_CELLS));
    return emitter_points[cell.x * uint(LSF_EMITTER_CELLS) + cell.y];
}

float emitter_luminance(vec3 radiance)
{
    return dot(radiance, vec3(0.2126, 0.7152, 0.0722));
}

#endif
