/* One step of the a-trous filter: 3 x 3 neighbours `stride` pixels apart, weighted 1 : 2 : 1 along both axes, by
 * the probability that they show one surface, and by how little their light differs beyond the noise. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(location = 1) uniform int stride;
layout(location = 2) uniform float tolerance; /* differences of luminance that count as noise [standard deviations] */
layout(location = 4) uniform float correlation; /* of the noise of neighbours, which earlier steps have mixed */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];

struct tally {
    vec3 difference; /* from the pixel's own light: a constant is kept to the bit */
    float sum, squares, variances;
};

void add(inout tally t, vec4 own, vec4 light, float w)
{
    float noise = tolerance * tolerance * (own.a + light.a);
    float d = luminance(light.rgb) - luminance(own.rgb);
    w *= d != 0.0 ? exp(-d * d / max(noise, 1e-37)) : 1.0;
    w = light.a >= 0.0 ? w : 0.0;
    t.difference += w * (light.rgb - own.rgb);
    t.squares += w * w * light.a;
    t.variances += w * light.a;
    t.sum += w;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    vec4 own[1 + LSF_LOBE];
    tally tallies[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++) {
        light_out[part] = own[part] = texelFetch(light_textures[part], pixel, 0);
        tallies[part] = tally(vec3(0.0), 1.0, own[part].a, own[part].a);
    }
    if (g.depth == 0.0)
        return;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            if (i == 0 && j == 0)
                continue;
            ivec2 at = pixel + stride * ivec2(i, j);
            bool inside = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
            vec2 w = inside ? light_guide_weights(g, pixel, at) : vec2(0.0);
            w *= (i == 0 ? 1.0 : 0.5) * (j == 0 ? 1.0 : 0.5);
            for (int part = 0; part <= LSF_LOBE; part++)
                add(tallies[part], own[part], texelFetch(light_textures[part], at, 0), w[part]);
        }
    for (int part = 0; part <= LSF_LOBE; part++) {
        tally t = tallies[part];
        if (own[part].a >= 0.0)
            light_out[part] = vec4(own[part].rgb + t.difference / t.sum,
                                   mix(t.squares / (t.sum * t.sum), t.variances / t.sum, correlation));
    }
}
