/* Radiance to 8-bit sRGB, by a curve of shared/tonemap.h. Rows run from the top. */
#include "shared/tonemap.h"

layout(binding = 0) uniform sampler2D radiance_texture;
layout(location = 0) uniform float exposure_scale; /* 2^EV */
layout(location = 1) uniform int curve;
layout(location = 0) out vec4 display_out;

void main()
{
    ivec2 size = textureSize(radiance_texture, 0);
    ivec2 pixel = ivec2(int(gl_FragCoord.x), size.y - 1 - int(gl_FragCoord.y));
    vec3 x = texelFetch(radiance_texture, pixel, 0).rgb;
    x = vec3(lsf_tonemap_expose(x.r, exposure_scale), lsf_tonemap_expose(x.g, exposure_scale),
             lsf_tonemap_expose(x.b, exposure_scale));
    display_out =
        vec4(lsf_tonemap_code(curve, 0, x.r, x.g, x.b), lsf_tonemap_code(curve, 1, x.r, x.g, x.b),
             lsf_tonemap_code(curve, 2, x.r, x.g, x.b), 1.0);
}
