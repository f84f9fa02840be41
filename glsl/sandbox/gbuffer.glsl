/* The surfaces that pixels show, for user shaders. A pixel is given by its fragment coordinates; outside of the
 * picture the nearest one is used. */
#ifndef LSF_SANDBOX_GBUFFER
#define LSF_SANDBOX_GBUFFER

#include "lib/brdf.glsl"
#include "lib/gbuffer.glsl"
#include "lib/gbuffer_textures.glsl"
#include "sandbox/view.glsl"
#include "shared/sandbox_data.h"

#if LSF_SEEN_EMISSION
layout(binding = LSF_UNIT_SEEN_EMISSION) uniform sampler2D seen_emission;
#endif
#if LSF_SEEN_MOTION
layout(binding = LSF_UNIT_SEEN_MOTION) uniform sampler2D seen_motion;
#endif

ivec2 seen_texel(vec2 pixel)
{
    return clamp(ivec2(floor(pixel)), ivec2(0), ivec2(view.size.xy) - 1);
}

bool lsf_seen(vec2 pixel)
{
    return texelFetch(depth_texture, seen_texel(pixel), 0).r != 0.0;
}

float lsf_depth(vec2 pixel)
{
    float depth = texelFetch(depth_texture, seen_texel(pixel), 0).r;
    return depth == 0.0 ? 1.0 / 0.0 : view_depth(depth);
}

vec3 lsf_position(vec2 pixel)
{
    ivec2 texel = seen_texel(pixel);
    float depth = texelFetch(depth_texture, texel, 0).r;
    return position_from_depth(sample_ndc(vec2(texel) + 0.5), depth);
}

surface lsf_surface(vec2 pixel)
{
    ivec2 texel = seen_texel(pixel);
    surface s = surface_unpack(texelFetch(surface_texture, texel, 0));
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, texel, 0), s);
#endif
    return s;
}

vec3 lsf_normal(vec2 pixel)
{
    return octahedral_decode(texelFetch(surface_texture, seen_texel(pixel), 0).y);
}

vec3 lsf_albedo(vec2 pixel)
{
    return surface_unpack(texelFetch(surface_texture, seen_texel(pixel), 0)).base_color;
}

vec3 lsf_emission(vec2 pixel)
{
#if LSF_SEEN_EMISSION
    return texelFetch(seen_emission, seen_texel(pixel), 0).rgb;
#else
    return vec3(0.0);
#endif
}

vec2 lsf_motion(vec2 pixel)
{
#if LSF_SEEN_MOTION
    return texelFetch(seen_motion, seen_texel(pixel), 0).rg;
#else
    return vec2(0.0);
#endif
}

#endif
