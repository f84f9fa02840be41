/* The reflective shadow map of one light, for user shaders. */
#ifndef LSF_SANDBOX_REFLECTIVE
#define LSF_SANDBOX_REFLECTIVE

#include "lib/gbuffer.glsl"
#include "lib/shadow.glsl"
#include "shared/sandbox_data.h"

layout(binding = LSF_UNIT_REFLECTIVE_SURFACE) uniform usampler2DArray reflective_surface;
#if LSF_SPECULAR_PARAMS
layout(binding = LSF_UNIT_REFLECTIVE_SPECULAR_PARAMS) uniform usampler2DArray reflective_specular_params;
#endif

ivec3 lsf_reflective_size()
{
    return ivec3(ivec2(light.map_shape.zz), int(light.map_origin.w));
}

bool lsf_reflective(ivec3 texel, out vec3 position, out surface s)
{
    float depth = texelFetch(shadow_depth, texel, 0).r;
    vec2 face_position = (vec2(texel.xy) + 0.5) * (2.0 * light.map_shape.w) - 1.0;
    s = surface_unpack(texelFetch(reflective_surface, texel, 0));
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(reflective_specular_params, texel, 0), s);
#endif
    position = light_projection_position(texel.z, face_position, depth);
    return depth > 0.0;
}

#endif
