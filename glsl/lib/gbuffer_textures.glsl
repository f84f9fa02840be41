/* The G-buffer of the picture's pixels, or the same layout for other points. Switch LSF_SPECULAR_PARAMS. */
#ifndef LSF_LIB_GBUFFER_TEXTURES
#define LSF_LIB_GBUFFER_TEXTURES

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_SPECULAR_PARAMS
layout(binding = 2) uniform usampler2D specular_params_texture;
#endif

#endif
