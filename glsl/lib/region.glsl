/* The part of the picture that a pass works on. With interleaved sampling, the pixels (tile + i * size) form a
 * region of their own. Switch LSF_INTERLEAVE: there is such a pattern. */
#ifndef LSF_LIB_REGION
#define LSF_LIB_REGION

#include "lib/interleave.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_REGION) uniform ivec4 region; /* corner of the region; its tile */

/* The picture's fragment coordinates for a fragment of the region; affine. */
vec2 region_position(vec2 fragment)
{
#if LSF_INTERLEAVE
    return (fragment - 0.5 - vec2(region.xy)) * float(INTERLEAVE_SIZE) + vec2(region.zw) + 0.5;
#else
    return fragment;
#endif
}

/* The picture's fragment coordinates of the current fragment. */
#define region_fragment() region_position(gl_FragCoord.xy)

#endif
