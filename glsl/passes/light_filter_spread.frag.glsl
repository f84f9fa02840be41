/* Spreads what lone pixels have lost over the pixels around that stand apart, as far as it is known: if m pixels have
 * found the light, its mean has the relative variance 1 / m. */
#include "lib/luminance.glsl"
#include "shared/light_filter.h"

layout(binding = 0) uniform sampler2D lost_texture;
layout(binding = 1) uniform sampler2D sum_texture;     /* of blocks; A: number of pixels that stand apart */
layout(binding = 2) uniform sampler2D squares_texture; /* of blocks: of luminance */
layout(location = 0) out vec4 change_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(sum_texture, 0) - 1;
    change_out = vec4(0.0);
    if (texelFetch(lost_texture, pixel, 0).a == 0.0)
        return;
    vec2 place = gl_FragCoord.xy / float(LSF_LOST_BLOCK) - 0.5, part = fract(place);
    vec4 sum = vec4(0.0);
    float squares = 0.0;
    for (int i = 0; i < 4; i++) {
        ivec2 corner = ivec2(i & 1, i >> 1), block = clamp(ivec2(floor(place)) + corner, ivec2(0), last);
        vec2 along = mix(1.0 - part, part, vec2(corner));
        sum += along.x * along.y * texelFetch(sum_texture, block, 0);
        squares += along.x * along.y * texelFetch(squares_texture, block, 0).r;
    }
    float lost = luminance(sum.rgb);
    if (lost > 0.0)
        change_out.rgb = sum.rgb / sum.a * max(1.0 - squares / lost / lost, 0.0);
}
