/* The pixels at which indirect light is gathered, for passes that gather it: which of the picture's sees
 * what is at a place of the textures they read and write. Switch LSF_SPARSE, 0 where places are the
 * picture's pixels. Needs what lib/view.glsl needs. */
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

/* ndc of what is seen there. */
vec2 place_ndc(ivec2 place)
{
    return sample_ndc(vec2(place_pixel(place)) + 0.5);
}

#endif
