/* Running means of the parts of reflected light and of the factors that reflected them; see
 * src/passes/light_mean.md. Switches LSF_INDIRECT, LSF_SPLIT_DIRECT, LSF_SKY_LIGHT: there is light of that kind. */
#include "lib/brdf.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/luminance.glsl"
#if LSF_SPECULAR
#include "lib/specular_albedo.glsl"
#endif
#include "lib/view.glsl"
#include "lib/way_to_eye.glsl"

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

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 guide = vec4(0.0);
    vec3 diffuse = vec3(0.0), diffuse_factor = vec3(0.0);
    vec3 specular = vec3(0.0), specular_factor = vec3(0.0);
    float depth = texelFetch(depth_texture, pixel, 0).r, roughness = 0.0;
    if (depth != 0.0) {
        vec3 left = left_on_the_way(pixel);
        surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
#if LSF_GLOSS
        gloss_unpack(texelFetch(gloss_texture, pixel, 0), s);
#endif
        guide = vec4(s.normal, depth);
#if LSF_SCATTER
        if (s.through)
            guide.xyz = -guide.xyz;
#endif
        vec3 irradiance = vec3(0.0);
#if LSF_INDIRECT
        irradiance += texelFetch(irradiance_texture, pixel, 0).rgb;
#endif
#if LSF_SKY_LIGHT
        irradiance += texelFetch(sky_irradiance_texture, pixel, 0).rgb;
#endif
#if LSF_SPLIT_DIRECT
        irradiance += texelFetch(direct_irradiance_texture, pixel, 0).rgb;
#endif
        if (!s.unlit)
            diffuse_factor = left * surface_diffuse(s) / LSF_PI;
        diffuse = diffuse_factor * irradiance;
#if LSF_SPECULAR
#if LSF_INDIRECT
        specular += texelFetch(specular_texture, pixel, 0).rgb;
#endif
#if LSF_SKY_LIGHT
        specular += texelFetch(sky_specular_texture, pixel, 0).rgb;
#endif
#if LSF_SPLIT_DIRECT
        specular += texelFetch(direct_specular_texture, pixel, 0).rgb;
#endif
        specular *= left;
        roughness = s.roughness;
        if (!s.unlit) {
            vec3 view = -normalize(view_ray_direction(sample_ndc(gl_FragCoord.xy)));
            specular_factor = left * specular_albedo(s, surface_view(s, view));
        }
#endif
    }
    bool first = weight == 1.0;
    vec4 mean = first ? vec4(0.0) : imageLoad(guide_image, pixel);
    vec4 next = mean + (guide - mean) * weight;
    float spread = first ? 0.0 : (guide.a - mean.a) * (guide.a - next.a);
    imageStore(guide_image, pixel, next);
    mean = first ? vec4(0.0) : imageLoad(diffuse_image, pixel);
    vec2 before = vec2(luminance(mean.rgb), 0.0);
    imageStore(diffuse_image, pixel, with_light(mean, diffuse));
    mean = first ? vec4(0.0) : imageLoad(diffuse_factor_image, pixel);
    imageStore(diffuse_factor_image, pixel,
               vec4(mean.rgb + (diffuse_factor - mean.rgb) * weight, mean.a + spread));
#if LSF_SPECULAR
    mean = first ? vec4(0.0) : imageLoad(specular_image, pixel);
    before.y = luminance(mean.rgb);
    imageStore(specular_image, pixel, with_light(mean, specular));
    mean = first ? vec4(0.0) : imageLoad(specular_factor_image, pixel);
    imageStore(specular_factor_image, pixel, mean + (vec4(specular_factor, roughness) - mean) * weight);
#endif
    if (keep)
        imageStore(half_image, pixel, vec4(before, 0.0, 0.0));
}
