#include "lib/hemisphere_texel.glsl"

void main()
{
    draw_texel(texel_slope());
}
