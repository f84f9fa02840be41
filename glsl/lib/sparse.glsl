/* The pixels at which indirect light is gathered: maps positions in the textures that a gathering pass reads and
 * writes to the pixels that they belong to. Switch LSF_SPARSE, 0 where positions are the picture's pixels. Needs
 * what lib/view.glsl needs. */
#ifndef LSF_LIB_SPARSE
#define LSF_LIB_SPARSE

#include "lib/view.glsl"

#if LSF_SPARSE
layout(binding = LSF_UNIT_PLACES) uniform usampler2D place_pixels;

ivec2 place_pixel(ivec2 place)
{
    uint pixel = texelFetch(place_pixels, place, 0).r;
    return ivec2(pixel & 0xffffu, pixel >> 16);
}
#else
#define place_pixel(place) (place)
#endif

/* ndc of the visible point. */
vec2 place_ndc(ivec2 place)
{
    return sample_ndc(vec2(place_pixel(place)) + 0.5);
}

#endif
