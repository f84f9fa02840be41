/* The G-buffer of the picture's pixels, or the same layout for other points. Switch LSF_GLOSS. */
#ifndef LSF_LIB_GBUFFER_TEXTURES
#define LSF_LIB_GBUFFER_TEXTURES

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_GLOSS
layout(binding = 2) uniform usampler2D gloss_texture;
#endif

#endif
