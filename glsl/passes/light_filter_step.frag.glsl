/* One step of the a-trous filter: 3 x 3 neighbours `stride` pixels apart, weighted 1 : 2 : 1 along both axes, by
 * the probability that they show one surface, and by how little their light differs beyond the noise. The first
 * step also takes out what a single sample brings to a lone pixel. */
#include "lib/view.glsl"

#include "lib/light_guide.glsl"
#include "lib/light_lone.glsl"

layout(binding = 2) uniform sampler2D light_textures[1 + LSF_LOBE]; /* A: variance, below 0: unknown */
layout(binding = 4) uniform sampler2D lone_texture;
layout(location = 1) uniform int stride;
layout(location = 2) uniform vec2 tolerances; /* differences of luminance that count as noise [standard deviations]:
                                               * of a pixel that shows one surface, and of one that an edge crosses */
layout(location = 4) uniform float correlation; /* of the noise of neighbours, which earlier steps have mixed */
layout(location = 0) out vec4 light_out[1 + LSF_LOBE];

/* Weight by which a neighbour counts beside a pixel even where it shows another surface. */
#define LSF_OTHER 0.05

bvec2 lone_at(ivec2 pixel)
{
    vec2 marks = texelFetch(lone_texture, pixel, 0).xy;
    return stride == 1 ? bvec2(lone_marked(marks.x, LONE), lone_marked(marks.y, LONE)) : bvec2(false);
}

struct tally {
    vec3 difference; /* from the pixel's own light: a constant is kept to the bit */
    float sum, squares, variances;
    vec4 beside; /* the same difference over all neighbours, whatever their light; A: the sum of weights */
    float beside_squares;
};

void add(inout tally t, vec4 own, vec4 light, float w, float tolerance)
{
    if (light.a < 0.0)
        return;
    float noise = tolerance * tolerance * (own.a + light.a);
    float d = luminance(light.rgb) - luminance(own.rgb);
    float beside = w + LSF_OTHER;
    t.beside += beside * vec4(light.rgb - own.rgb, 1.0);
    t.beside_squares += beside * d * d;
    w *= d != 0.0 ? exp(-d * d / max(noise, 1e-37)) : 1.0;
    t.difference += w * (light.rgb - own.rgb);
    t.squares += w * w * light.a;
    t.variances += w * light.a;
    t.sum += w;
}

/* Light of a lone pixel, drawn towards the mean of the light beside it by its own share of both variances. */
vec4 lone_light(vec4 own, tally t)
{
    if (t.beside.a == 0.0)
        return own;
    vec3 apart = t.beside.rgb / t.beside.a;
    float d = luminance(apart), differ = max(t.beside_squares / t.beside.a - d * d, 0.0);
    float share = own.a / (own.a + differ);
    return vec4(own.rgb + share * apart, (1.0 - share) * own.a);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(guide_texture, 0);
    light_guide g = light_guide_at(pixel);
    float tolerance = mix(tolerances.y, tolerances.x, g.alike * g.alike);
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
            bvec2 lone = lone_at(at);
            for (int part = 0; part <= LSF_LOBE; part++)
                if (!lone[part])
                    add(tallies[part], own[part], texelFetch(light_textures[part], at, 0), w[part], tolerance);
        }
    for (int part = 0; part <= LSF_LOBE; part++) {
        tally t = tallies[part];
        if (lone_at(pixel)[part])
            light_out[part] = lone_light(own[part], t);
        else if (own[part].a >= 0.0)
            light_out[part] = vec4(own[part].rgb + t.difference / t.sum,
                                   mix(t.squares / (t.sum * t.sum), t.variances / t.sum, correlation));
    }
}
