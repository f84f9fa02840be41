/* The picture as the sum of its parts. */
#include "lib/brdf.glsl"
#include "lib/environment.glsl"
#include "lib/view.glsl"
#include "lib/transmittance_to_eye.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
#if LSF_EMISSION
layout(binding = 1) uniform sampler2D emission_texture;
#endif
#if LSF_DIRECT
layout(binding = 2) uniform sampler2D direct_texture;
#endif
#if LSF_INDIRECT || LSF_SKY_LIGHT
layout(binding = 3) uniform usampler2D surface_texture;
#if LSF_TRANSMISSION
layout(binding = 9) uniform usampler2D specular_params_texture;
#endif
#endif
#if LSF_INDIRECT
layout(binding = 4) uniform sampler2D irradiance_texture;
#if LSF_SPECULAR
layout(binding = 6) uniform sampler2D specular_texture;
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
layout(location = 0) uniform vec3 background; /* radiance */
layout(location = 0) out vec4 radiance_out;
#if LSF_SEEN
layout(location = LSF_SEEN) out vec4 seen_out; /* emission and environment alone */
#endif
#if LSF_INDIRECT_DIFFUSE
layout(location = LSF_INDIRECT_DIFFUSE) out vec4 indirect_diffuse_out;
#endif
#if LSF_ALL_DIRECT
layout(location = LSF_ALL_DIRECT) out vec4 direct_out; /* of every kind of light */
#endif

#if LSF_INDIRECT_SPECULAR
layout(location = LSF_INDIRECT_SPECULAR) out vec4 indirect_specular_out;
#endif
#if LSF_COVERAGE
layout(location = LSF_COVERAGE) out vec4 coverage_out;
#endif

/* Whether a surface, or one that transmits light, covers the pixel: what is behind such a surface is no
 * background. */
bool covered(ivec2 pixel, float depth)
{
#ifdef LSF_SEEN_THROUGH
    if (texelFetch(tint_texture, pixel, 0).a == 0.0)
        return true;
#endif
    return depth != 0.0;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_texture, pixel, 0).r;
    vec3 seen = vec3(0.0), direct = vec3(0.0), indirect = vec3(0.0);
    float lost = 0.0; /* luminance that a bound removed */
    vec3 left = transmittance_to_eye(pixel);
#if LSF_EMISSION
    seen += texelFetch(emission_texture, pixel, 0).rgb;
#endif
#if LSF_BACKGROUND
    bool sky = covered(pixel, depth) && depth == 0.0;
    if (!covered(pixel, depth))
        seen += background;
#else
    bool sky = depth == 0.0;
#endif
#if LSF_ENVIRONMENT
    if (sky)
        seen += environment_radiance(normalize(view_ray_direction(sample_ndc(gl_FragCoord.xy))));
#endif
#if LSF_DIRECT
    direct += texelFetch(direct_texture, pixel, 0).rgb;
#endif
#if LSF_INDIRECT || LSF_SKY_LIGHT
    vec3 reflected = vec3(0.0); /* reflectance for an irradiance of 1 */
    if (depth != 0.0) {
        surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
#if LSF_TRANSMISSION
        specular_params_unpack(texelFetch(specular_params_texture, pixel, 0), s);
#endif
        reflected = surface_diffuse(s) / LSF_PI;
    }
#endif
#if LSF_SKY_LIGHT
    direct += reflected * texelFetch(sky_irradiance_texture, pixel, 0).rgb;
#if LSF_SPECULAR
    direct += texelFetch(sky_specular_texture, pixel, 0).rgb;
#endif
#endif
#if LSF_INDIRECT
    vec4 irradiance = texelFetch(irradiance_texture, pixel, 0);
    indirect += reflected * irradiance.rgb;
    lost += dot(reflected, vec3(0.2126, 0.7152, 0.0722)) * irradiance.a;
#if LSF_INDIRECT_DIFFUSE
    indirect_diffuse_out = vec4(indirect * left, 1.0);
#endif
#if LSF_SPECULAR
    vec4 specular = texelFetch(specular_texture, pixel, 0);
#if LSF_INDIRECT_SPECULAR
    indirect_specular_out = vec4(specular.rgb * left, 1.0);
#endif
    indirect += specular.rgb;
    lost += specular.a;
#endif
#if LSF_SPLIT_DIRECT
    direct += reflected * texelFetch(direct_irradiance_texture, pixel, 0).rgb;
#if LSF_SPECULAR
    direct += texelFetch(direct_specular_texture, pixel, 0).rgb;
#endif
#endif
#endif
#if LSF_SEEN
    seen_out = vec4(seen * left, 1.0);
#endif
#if LSF_COVERAGE
    coverage_out = vec4(covered(pixel, depth) ? 1.0 : 0.0);
#endif
#if LSF_ALL_DIRECT
    direct_out = vec4(direct * left, 1.0);
#endif
#ifdef LSF_SEEN_THROUGH
    lost *= dot(left, vec3(0.2126, 0.7152, 0.0722));
#endif
    radiance_out = vec4((seen + direct + indirect) * left, lost);
}
