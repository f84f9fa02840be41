/* Radiance to 8-bit sRGB, by a curve of shared/tonemap.h. */
#include "shared/tonemap.h"

layout(binding = 0) uniform sampler2D radiance_texture;
layout(location = 0) uniform float exposure_scale; /* 2^EV */
layout(location = 1) uniform int curve;
layout(location = 2) uniform vec4 window; /* its lower left corner, and texels per pixel */
layout(location = 3) uniform bool rows_from_top;
layout(location = 0) out vec4 display_out;

void main()
{
    ivec2 size = textureSize(radiance_texture, 0);
    ivec2 pixel = min(ivec2((gl_FragCoord.xy - window.xy) * window.zw), size - 1);
    if (rows_from_top)
        pixel.y = size.y - 1 - pixel.y;
    vec3 x = texelFetch(radiance_texture, pixel, 0).rgb;
    x = vec3(lsf_tonemap_expose(x.r, exposure_scale), lsf_tonemap_expose(x.g, exposure_scale),
             lsf_tonemap_expose(x.b, exposure_scale));
    display_out =
        vec4(lsf_tonemap_code(curve, 0, x.r, x.g, x.b), lsf_tonemap_code(curve, 1, x.r, x.g, x.b),
             lsf_tonemap_code(curve, 2, x.r, x.g, x.b), 1.0);
}
