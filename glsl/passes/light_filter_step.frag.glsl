/* One step of the a-trous filter: 3 x 3 neighbours `stride` pixels apart, weighed 1 : 2 : 1 along both axes, by how
 * far they see one surface and by how far their light differs by no more than noise. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_texture; /* A: variance, below 0 where it tells nothing */
layout(location = 1) uniform int stride;
layout(location = 2) uniform float tolerance; /* differences of luminance that count as noise [standard deviations] */
layout(location = 4) uniform float correlation; /* of the noise of neighbours, for the steps before have mixed it */
layout(location = 0) out vec4 light_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    vec4 own = texelFetch(light_texture, pixel, 0);
    light_out = own;
    light_guide g = light_guide_at(pixel);
    if (g.depth == 0.0 || own.a < 0.0)
        return;
    float y = luminance(own.rgb);
    /* Differences to the pixel's own light are summed: a constant stays what it is to the bit. */
    vec3 difference = vec3(0.0);
    float sum = 1.0, squares = own.a, variances = own.a;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            ivec2 at = pixel + stride * ivec2(i, j);
            if (i == 0 && j == 0)
                continue;
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec4 light = texelFetch(light_texture, at, 0);
            float noise = tolerance * tolerance * (own.a + light.a);
            float d = luminance(light.rgb) - y;
            float w = light_guide_weight(g, pixel, at) * (i == 0 ? 1.0 : 0.5) * (j == 0 ? 1.0 : 0.5);
            w *= d != 0.0 ? exp(-d * d / max(noise, 1e-37)) : 1.0;
            w = inside && light.a >= 0.0 ? w : 0.0;
            difference += w * (light.rgb - own.rgb);
            squares += w * w * light.a;
            variances += w * light.a;
            sum += w;
        }
    light_out = vec4(own.rgb + difference / sum, mix(squares / (sum * sum), variances / sum, correlation));
}
