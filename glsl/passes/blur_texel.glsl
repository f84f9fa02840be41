/* What the blur compares of a texel, RGBA32UI; all 0 where no lit surface is.
 *   x, y, z  position, float bits [normalised space]
 *   w        geometric normal, octahedral 2 x 7 bits; shading normal << 14, the same;
 *            phases that blur the specular part, plus 1, << 28
 * Seven bits hold a normal to 1 degree, which its cosine and the slope do not notice. */
#ifndef LSF_PASSES_BLUR_TEXEL
#define LSF_PASSES_BLUR_TEXEL

#include "lib/octahedral.glsl"

/* Packs 2 x snorm16, as in the G-buffer, with rounding. */
uint guide_normal_pack(uint normal)
{
    ivec2 p = ivec2(round(unpackSnorm2x16(normal) * 63.0)) & 127;
    return uint(p.x | p.y << 7);
}

vec3 guide_normal(uint bits)
{
    /* The shifts extend the sign, the highest bit of each. */
    vec2 p = vec2(int(bits << 25) >> 25, int(bits << 18) >> 25) / 63.0;
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * octahedral_sign(n.xy);
    return normalize(n);
}

uvec4 guide_pack(vec3 position, uint geometric_normal, uint normal, uint phases)
{
    return uvec4(floatBitsToUint(position), guide_normal_pack(geometric_normal) |
                                                guide_normal_pack(normal) << 14 |
                                                (phases + 1u) << 28);
}

vec3 guide_position(uvec4 texel)
{
    return uintBitsToFloat(texel.xyz);
}

vec3 guide_geometric_normal(uvec4 texel)
{
    return guide_normal(texel.w);
}

vec3 guide_shading_normal(uvec4 texel)
{
    return guide_normal(texel.w >> 14);
}

bool guide_lit(uvec4 texel)
{
    return texel.w != 0u;
}

int guide_phases(uvec4 texel)
{
    return int(texel.w >> 28) - 1;
}

#endif
