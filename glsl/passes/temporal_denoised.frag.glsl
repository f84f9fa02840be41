/* Denoised light blended with that of the frames before, which counts the less, the more the denoised brightness has
 * changed (Schied et al. 2018, "Gradient Estimation for Real-Time Adaptive Temporal Filtering", of whose sparse
 * gradients this is one in each pixel). Switch LSF_LOBE: there is specular light. */
#include "lib/luminance.glsl"

layout(binding = 2) uniform sampler2D denoised_textures[1 + LSF_LOBE]; /* A below 0: it tells nothing */
layout(binding = 4) uniform sampler2D carried_textures[1 + LSF_LOBE];  /* A: samples */
layout(location = 1) uniform float iterations;
layout(location = 2) uniform float limit; /* samples of those before, for each of the frame's */
layout(location = 0) out vec4 denoised_out[1 + LSF_LOBE];
layout(location = 1 + LSF_LOBE) out vec2 count_out; /* samples of both parts */

bool finite(vec3 v)
{
    return !any(isnan(v)) && !any(isinf(v));
}

/* The change of brightness, as a share of the brighter of both. */
float gradient(vec3 now, vec3 before)
{
    float a = luminance(now), b = luminance(before), most = max(a, b);
    return most > 0.0 ? min(abs(a - b) / most, 1.0) : 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    count_out = vec2(0.0);
    for (int part = 0; part <= LSF_LOBE; part++) {
        vec4 own = texelFetch(denoised_textures[part], pixel, 0);
        vec4 carried = texelFetch(carried_textures[part], pixel, 0);
        denoised_out[part] = own;
        if (own.a < 0.0 || !finite(own.rgb))
            continue;
        float before = min(carried.a, limit * iterations);
        float share = before / (before + iterations) * (1.0 - gradient(own.rgb, carried.rgb));
        denoised_out[part].rgb += share * (carried.rgb - own.rgb);
        count_out[part] = iterations / (1.0 - share); /* of which the frame's own are 1 - share */
    }
}
