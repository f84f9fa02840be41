/* The part of the picture that a pass works on. With interleaved sampling, pixels (tile + i * size)
 * lie side by side in a region of their own; switch LSF_INTERLEAVE is the size, 1 without. */
#ifndef LSF_LIB_REGION
#define LSF_LIB_REGION

#include "shared/scene_data.h"

layout(location = LSF_LOCATION_REGION) uniform ivec4 region; /* its corner; its tile */

/* The picture's fragment coordinates of the fragment at hand. */
vec2 region_fragment()
{
#if LSF_INTERLEAVE > 1
    return vec2((ivec2(gl_FragCoord.xy) - region.xy) * LSF_INTERLEAVE + region.zw) + 0.5;
#else
    return gl_FragCoord.xy;
#endif
}

#endif
