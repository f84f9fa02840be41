/* Running means of the parts of reflected light and of the factors that reflected them; see
 * src/passes/light_mean.md. Switches LSF_INDIRECT, LSF_SPLIT_DIRECT, LSF_SKY_LIGHT: there is light of that kind;
 * LSF_PIXEL_SIDE. */
#include "lib/brdf.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/luminance.glsl"
#include "lib/pixel_side.glsl"
#if LSF_SPECULAR
#include "lib/specular_albedo.glsl"
#endif
#include "lib/view.glsl"
#include "lib/transmittance_to_eye.glsl"

#if LSF_INDIRECT
layout(binding = 3) uniform sampler2D irradiance_texture;
#if LSF_SPECULAR
layout(binding = 4) uniform sampler2D specular_texture;
#endif
#endif
#if LSF_SKY_LIGHT
layout(binding = 12) uniform sampler2D sky_irradiance_texture;
#if LSF_SPECULAR
layout(binding = 13) uniform sampler2D sky_specular_texture;
#endif
#endif
#if LSF_SPLIT_DIRECT
layout(binding = 7) uniform sampler2D direct_irradiance_texture;
#if LSF_SPECULAR
layout(binding = 8) uniform sampler2D direct_specular_texture;
#endif
#endif
layout(binding = 0, rgba32f) uniform image2D guide_image;
layout(binding = 1, rgba32f) uniform image2D diffuse_image;
layout(binding = 2, rgba32f) uniform image2D diffuse_factor_image;
#if LSF_SPECULAR
layout(binding = 3, rgba32f) uniform image2D specular_image;
layout(binding = 4, rgba32f) uniform image2D specular_factor_image;
#endif
layout(binding = 5, rg32f) uniform image2D half_image;
layout(location = 0) uniform float weight; /* 1 / n */
layout(location = 1) uniform bool keep;    /* keep the luminance of the previous means */

/* The mean with one more value, by Welford 1962; A is the sum of squared deviations of the luminance. */
vec4 with_light(vec4 mean, vec3 x)
{
    vec3 next = mean.rgb + (x - mean.rgb) * weight;
    return vec4(next, mean.a + (luminance(x) - luminance(mean.rgb)) * (luminance(x) - luminance(next)));
}

/* What an iteration sees at a sample point, or the mean over those of a pixel. */
struct seen_light {
    vec4 guide; /* normal, depth */
    vec3 diffuse, diffuse_factor, specular, specular_factor;
    float roughness;
};

seen_light seen_at(ivec2 point)
{
    seen_light l = seen_light(vec4(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
    float depth = texelFetch(depth_texture, point, 0).r;
    if (depth == 0.0)
        return l;
    vec3 left = transmittance_to_eye(point);
    surface s = surface_unpack(texelFetch(surface_texture, point, 0));
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, point, 0), s);
#endif
    l.guide = vec4(s.normal, depth);
#if LSF_SCATTER
    if (s.through)
        l.guide.xyz = -l.guide.xyz;
#endif
    vec3 irradiance = vec3(0.0);
#if LSF_INDIRECT
    irradiance += texelFetch(irradiance_texture, point, 0).rgb;
#endif
#if LSF_SKY_LIGHT
    irradiance += texelFetch(sky_irradiance_texture, point, 0).rgb;
#endif
#if LSF_SPLIT_DIRECT
    irradiance += texelFetch(direct_irradiance_texture, point, 0).rgb;
#endif
    if (!s.unlit)
        l.diffuse_factor = left * surface_diffuse(s) / LSF_PI;
    l.diffuse = l.diffuse_factor * irradiance;
#if LSF_SPECULAR
#if LSF_INDIRECT
    l.specular += texelFetch(specular_texture, point, 0).rgb;
#endif
#if LSF_SKY_LIGHT
    l.specular += texelFetch(sky_specular_texture, point, 0).rgb;
#endif
#if LSF_SPLIT_DIRECT
    l.specular += texelFetch(direct_specular_texture, point, 0).rgb;
#endif
    l.specular *= left;
    l.roughness = s.roughness;
    if (!s.unlit) {
        vec3 view = -normalize(view_ray_direction(sample_ndc(vec2(point) + 0.5)));
        l.specular_factor = left * specular_albedo(s, surface_view(s, view));
    }
#endif
    return l;
}

/* Also the variance of depth among the pixel's sample points. */
seen_light seen_in(ivec2 pixel, out float variance)
{
    variance = 0.0;
    seen_light sum = seen_at(pixel * LSF_PIXEL_SIDE);
#if LSF_PIXEL_SIDE > 1
    const float part = 1.0 / float(LSF_PIXEL_SIDE * LSF_PIXEL_SIDE);
    float first = sum.guide.a, apart = 0.0;
    for (int i = 1; i < LSF_PIXEL_SIDE * LSF_PIXEL_SIDE; i++) {
        seen_light l = seen_at(pixel * LSF_PIXEL_SIDE + ivec2(i % LSF_PIXEL_SIDE, i / LSF_PIXEL_SIDE));
        sum.guide += l.guide;
        sum.diffuse += l.diffuse;
        sum.diffuse_factor += l.diffuse_factor;
        sum.specular += l.specular;
        sum.specular_factor += l.specular_factor;
        sum.roughness += l.roughness;
        apart += l.guide.a - first;
        variance += (l.guide.a - first) * (l.guide.a - first);
    }
    variance = max(part * variance - part * part * apart * apart, 0.0);
    sum = seen_light(part * sum.guide, part * sum.diffuse, part * sum.diffuse_factor, part * sum.specular,
                     part * sum.specular_factor, part * sum.roughness);
#endif
    return sum;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float variance;
    seen_light l = seen_in(pixel, variance);
    bool first = weight == 1.0;
    vec4 mean = first ? vec4(0.0) : imageLoad(guide_image, pixel);
    vec4 next = mean + (l.guide - mean) * weight;
    float spread = first ? 0.0 : (l.guide.a - mean.a) * (l.guide.a - next.a);
    imageStore(guide_image, pixel, next);
    mean = first ? vec4(0.0) : imageLoad(diffuse_image, pixel);
    vec2 before = vec2(luminance(mean.rgb), 0.0);
    imageStore(diffuse_image, pixel, with_light(mean, l.diffuse));
    mean = first ? vec4(0.0) : imageLoad(diffuse_factor_image, pixel);
    imageStore(diffuse_factor_image, pixel,
               vec4(mean.rgb + (l.diffuse_factor - mean.rgb) * weight, mean.a + spread + variance));
#if LSF_SPECULAR
    mean = first ? vec4(0.0) : imageLoad(specular_image, pixel);
    before.y = luminance(mean.rgb);
    imageStore(specular_image, pixel, with_light(mean, l.specular));
    mean = first ? vec4(0.0) : imageLoad(specular_factor_image, pixel);
    imageStore(specular_factor_image, pixel, mean + (vec4(l.specular_factor, l.roughness) - mean) * weight);
#endif
    if (keep)
        imageStore(half_image, pixel, vec4(before, 0.0, 0.0));
}
