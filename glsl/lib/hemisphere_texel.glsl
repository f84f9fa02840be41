/* Packs a fragment into its texel of a hemisphere's map. */
#ifndef LSF_LIB_HEMISPHERE_TEXEL
#define LSF_LIB_HEMISPHERE_TEXEL

#include "lib/hemisphere.glsl"

layout(r32ui, binding = 0) coherent uniform uimage2D map_image;

/* Call this before any discard, while the whole quad is alive. */
vec2 texel_slope()
{
    float z = gl_FragCoord.z;
    return vec2(dFdx(z), dFdy(z)) / z * (0.5 * light.map_shape.z);
}

void draw_texel(vec2 slope)
{
    imageAtomicMax(map_image, ivec2(gl_FragCoord.xy), hemisphere_pack(gl_FragCoord.z, slope));
}

#endif
