#include "lib/sky_map_texel.glsl"

void main()
{
    draw_texel();
}
