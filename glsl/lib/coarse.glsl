/* The grid on which light is traced; see src/frame/coarse_grid.h. Switch LSF_COARSE, 0 when its
 * texels are the picture's pixels. Needs what lib/view.glsl needs. */
#ifndef LSF_LIB_COARSE
#define LSF_LIB_COARSE

#include "lib/view.glsl"

#if LSF_COARSE
layout(location = LSF_LOCATION_COARSE) uniform ivec4 coarse; /* its size; offset in blocks, 2^16 */

/* a / b, rounded down, for positive numbers: software GL divides vectors of integers one by one,
 * floats all at once. Off by one at most, which the rest tells. */
ivec2 coarse_divide(ivec2 a, ivec2 b)
{
    ivec2 quotient = ivec2(vec2(a) / vec2(b)), rest = a - quotient * b;
    return quotient + ivec2(greaterThanEqual(rest, b)) - ivec2(lessThan(rest, ivec2(0)));
}

/* The pixel that a texel sees. */
ivec2 coarse_pixel(ivec2 texel)
{
    ivec2 size = ivec2(view.size.xy);
    ivec2 corner = coarse_divide(texel * size, coarse.xy);
    ivec2 block = coarse_divide((texel + 1) * size, coarse.xy) - corner;
    return corner + (block * coarse.zw >> 16);
}

/* The texel that stands for a pixel. */
ivec2 coarse_texel(ivec2 pixel)
{
    return coarse_divide((pixel + 1) * coarse.xy - 1, ivec2(view.size.xy));
}

vec2 coarse_size()
{
    return vec2(coarse.xy);
}
#else
#define coarse_pixel(texel) (texel)
#define coarse_texel(pixel) (pixel)
#define coarse_size() view.size.xy
#endif

/* ndc of the point that a texel samples. */
vec2 coarse_ndc(ivec2 texel)
{
    return sample_ndc(vec2(coarse_pixel(texel)) + 0.5);
}

#endif
