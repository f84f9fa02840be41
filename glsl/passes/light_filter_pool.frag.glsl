/* Sums what lone pixels have lost over blocks. */
#include "lib/luminance.glsl"
#include "shared/light_filter.h"

layout(binding = 0) uniform sampler2D lost_texture; /* A: 1 where the pixel stands apart, else 0 */
layout(location = 0) out vec4 sum_out;
layout(location = 1) out float squares_out; /* of luminance */

void main()
{
    ivec2 first = ivec2(gl_FragCoord.xy) * LSF_LOST_BLOCK;
    ivec2 end = min(first + LSF_LOST_BLOCK, textureSize(lost_texture, 0));
    sum_out = vec4(0.0);
    squares_out = 0.0;
    for (int y = first.y; y < end.y; y++)
        for (int x = first.x; x < end.x; x++) {
            vec4 lost = texelFetch(lost_texture, ivec2(x, y), 0);
            float l = luminance(lost.rgb);
            sum_out += lost;
            squares_out += l * l;
        }
}
