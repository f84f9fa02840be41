/* Copies a G-buffer pixel into a texel of another order or size. */
#ifndef LSF_LIB_GBUFFER_COPY
#define LSF_LIB_GBUFFER_COPY

#include "lib/gbuffer_textures.glsl"

layout(location = 0) out float depth_out;
layout(location = 1) out uvec4 surface_out;
#if LSF_SPECULAR_PARAMS
layout(location = 2) out uvec4 specular_params_out;
#endif

void gbuffer_copy(ivec2 pixel)
{
    depth_out = texelFetch(depth_texture, pixel, 0).r;
    surface_out = texelFetch(surface_texture, pixel, 0);
#if LSF_SPECULAR_PARAMS
    specular_params_out = texelFetch(specular_params_texture, pixel, 0);
#endif
}

#endif
