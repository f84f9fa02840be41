/* The picture of a technique, for user shaders. A pixel is given by its fragment coordinates. */
#ifndef LSF_SANDBOX_PICTURE
#define LSF_SANDBOX_PICTURE

#include "shared/sandbox_data.h"

layout(binding = LSF_UNIT_PICTURE) uniform sampler2D sandbox_picture;
layout(binding = LSF_UNIT_PICTURE_DIRECT) uniform sampler2D sandbox_direct;
layout(binding = LSF_UNIT_PICTURE_DIFFUSE) uniform sampler2D sandbox_diffuse;
layout(binding = LSF_UNIT_PICTURE_SPECULAR) uniform sampler2D sandbox_specular;

vec3 picture_texel(sampler2D layer, vec2 pixel)
{
    return texelFetch(layer, clamp(ivec2(floor(pixel)), ivec2(0), textureSize(layer, 0) - 1), 0).rgb;
}

vec3 lsf_picture(vec2 pixel)
{
    return picture_texel(sandbox_picture, pixel);
}

vec3 lsf_direct(vec2 pixel)
{
    return picture_texel(sandbox_direct, pixel);
}

vec3 lsf_indirect_diffuse(vec2 pixel)
{
    return picture_texel(sandbox_diffuse, pixel);
}

vec3 lsf_indirect_specular(vec2 pixel)
{
    return picture_texel(sandbox_specular, pixel);
}

#endif
