/* One step of the a-trous filter: 3 x 3 neighbours `stride` pixels apart, weighted 1 : 2 : 1 along both axes, by
 * the probability that they show one surface, and by how little their light differs beyond the noise. The first
 * step also takes out what single samples bring to pixels without such neighbours. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(location = 1) uniform int stride;
layout(location = 2) uniform float tolerance; /* differences of luminance that count as noise [standard deviations] */
layout(location = 4) uniform float correlation; /* of the noise of neighbours, which earlier steps have mixed */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];

/* Weight by which a neighbour counts beside a pixel even where it shows another surface. */
#define LSF_OTHER 0.05

struct tally {
    vec3 difference; /* from the pixel's own light: a constant is kept to the bit */
    float sum, squares, variances;
    vec4 beside; /* the same difference over all neighbours, whatever their light; A: the sum of weights */
    float beside_squares;
};

void add(inout tally t, vec4 own, vec4 light, float w)
{
    float noise = tolerance * tolerance * (own.a + light.a);
    float d = luminance(light.rgb) - luminance(own.rgb);
    bool known = light.a >= 0.0;
    float beside = known ? w + LSF_OTHER : 0.0;
    t.beside += beside * vec4(light.rgb - own.rgb, 1.0);
    t.beside_squares += beside * d * d;
    w *= d != 0.0 ? exp(-d * d / max(noise, 1e-37)) : 1.0;
    w = known ? w : 0.0;
    t.difference += w * (light.rgb - own.rgb);
    t.squares += w * w * light.a;
    t.variances += w * light.a;
    t.sum += w;
}

/* Whether the neighbours are darker and few are on the pixel's surface (their weights may sum to 3), and less than two
 * samples bring its light: if m of n samples bring equal parts, the mean's square is m times its variance. */
bool is_lone(vec4 own, tally t)
{
    float light = luminance(own.rgb);
    return luminance(t.beside.rgb) < 0.0 && t.beside.a < 2.0 + 8.0 * LSF_OTHER && light * light < 2.0 * own.a;
}

/* The light of such a pixel, drawn towards the mean of the light beside it by its own share of both variances. */
vec4 lone_light(vec4 own, tally t)
{
    vec3 apart = t.beside.rgb / t.beside.a;
    float d = luminance(apart), differ = max(t.beside_squares / t.beside.a - d * d, 0.0);
    float share = own.a / (own.a + differ);
    return vec4(own.rgb + share * apart, (1.0 - share) * own.a);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    vec4 own[1 + LSF_LOBE];
    tally tallies[1 + LSF_LOBE];
    for (int part = 0; part <= LSF_LOBE; part++) {
        light_out[part] = own[part] = texelFetch(light_textures[part], pixel, 0);
        tallies[part] = tally(vec3(0.0), 1.0, own[part].a, own[part].a, vec4(0.0), 0.0);
    }
    if (g.depth == 0.0)
        return;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            if (i == 0 && j == 0)
                continue;
            ivec2 at = pixel + stride * ivec2(i, j);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size)))
                continue;
            vec2 w = light_guide_weights(g, pixel, at);
            w *= (i == 0 ? 1.0 : 0.5) * (j == 0 ? 1.0 : 0.5);
            for (int part = 0; part <= LSF_LOBE; part++)
                add(tallies[part], own[part], texelFetch(light_textures[part], at, 0), w[part]);
        }
    for (int part = 0; part <= LSF_LOBE; part++) {
        tally t = tallies[part];
        bool first = stride == 1;
#if LSF_LOBE
        first = first && (part == 0 || g.alpha > 0.0); /* a mirror does not share its light */
#endif
        if (first && is_lone(own[part], t))
            light_out[part] = lone_light(own[part], t);
        else if (own[part].a >= 0.0)
            light_out[part] = vec4(own[part].rgb + t.difference / t.sum,
                                   mix(t.squares / (t.sum * t.sum), t.variances / t.sum, correlation));
    }
}
