#include "lib/hemisphere_texel.glsl"
#include "lib/mask.glsl"

void main()
{
    vec2 slope = texel_slope();
    if (masked_out())
        discard;
    draw_texel(slope);
}
