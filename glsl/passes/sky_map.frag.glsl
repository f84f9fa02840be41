#include "lib/mask.glsl"
#include "lib/sky_map_texel.glsl"

void main()
{
    draw_texel();
    if (masked_out())
        discard;
}
