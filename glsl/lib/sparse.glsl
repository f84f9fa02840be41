/* The pixels at which indirect light is gathered: maps positions in the textures that a gathering pass reads and
 * writes to the pixels that they belong to. Switch LSF_SPARSE, 0 where positions are the picture's pixels. Needs
 * what lib/view.glsl needs. */
#ifndef LSF_LIB_SPARSE
#define LSF_LIB_SPARSE

#include "lib/view.glsl"

#if LSF_SPARSE
layout(binding = LSF_UNIT_POSITION_PIXELS) uniform usampler2D position_pixels;

ivec2 position_pixel(ivec2 position)
{
    uint pixel = texelFetch(position_pixels, position, 0).r;
    return ivec2(pixel & 0xffffu, pixel >> 16);
}
#else
#define position_pixel(position) (position)
#endif

/* ndc of the visible point. */
vec2 position_ndc(ivec2 position)
{
    return sample_ndc(vec2(position_pixel(position)) + 0.5);
}

#endif
