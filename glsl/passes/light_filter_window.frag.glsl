/* The first of two steps of lib/light_window.glsl, over the outputs of light_filter_divide. */
#include "lib/view.glsl"

layout(binding = 2) uniform sampler2D window_textures[1 + LSF_LOBE];
layout(location = 0) out vec4 window_out[1 + LSF_LOBE];

vec4 window_value(ivec2 at, int part)
{
    return texelFetch(window_textures[part], at, 0);
}

#include "lib/light_window.glsl"

void main()
{
    window_begin(ivec2(gl_FragCoord.xy), window_out);
}
