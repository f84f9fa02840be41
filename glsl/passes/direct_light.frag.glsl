/* Light that one punctual light sends to the eye by one reflection: f V E, added to the target. */
#include "lib/brdf.glsl"
#include "lib/shadow.glsl"
#include "lib/view.glsl"
#include "shared/light.h"

layout(binding = 0) uniform sampler2D depth_texture;
layout(binding = 1) uniform usampler2D surface_texture;
#if LSF_GLOSS
layout(binding = 2) uniform usampler2D gloss_texture;
#endif

layout(location = 0) out vec4 radiance_out;

/* Direction to the light and the irradiance [W/m^2] on a plane that faces it. */
vec3 light_direction(vec3 position, out vec3 irradiance)
{
    irradiance = light.intensity.rgb;
#if LSF_DIRECTIONAL_LIGHT
    if (light.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL)
        return -light.direction.xyz;
#endif
    vec3 to_light = light.position.xyz - position;
    float distance2 = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(max(distance2, 1e-30));
    irradiance *= lsf_distance_attenuation(distance2, light.attenuation.x);
#if LSF_SPOT_LIGHT
    irradiance *= lsf_spot_attenuation(-dot(light.direction.xyz, direction), light.attenuation.y,
                                       light.attenuation.z);
#endif
    return direction;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance_out = vec4(0.0, 0.0, 0.0, 1.0);
    float depth = texelFetch(depth_texture, pixel, 0).r;
    if (depth == 0.0)
        return;
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_GLOSS
    gloss_unpack(texelFetch(gloss_texture, pixel, 0).xy, s);
#endif
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    vec3 position = position_from_depth(ndc, depth);
    vec3 view_direction = -normalize(view_ray_direction(ndc));
    vec3 irradiance;
    vec3 direction = light_direction(position, irradiance);
    float cosine = dot(s.normal, direction);
    if (cosine <= 0.0 || dot(s.geometric_normal, direction) <= 0.0 ||
        max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0)
        return;
    float visibility = shadow_visibility(position, s.geometric_normal);
    if (visibility == 0.0)
        return;
    brdf_value f = brdf_evaluate(s, view_direction, direction);
    radiance_out.rgb = (f.diffuse + f.specular) * irradiance * (cosine * visibility);
}
