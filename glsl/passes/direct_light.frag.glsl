/* Light that one punctual light sends to the eye by one reflection: f V E, added to the target. */
#include "lib/brdf.glsl"
#include "lib/gbuffer_textures.glsl"
#include "lib/light.glsl"
#include "lib/shadow.glsl"
#include "lib/view.glsl"

layout(location = 0) out vec4 radiance_out;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    radiance_out = vec4(0.0);
    float depth = texelFetch(depth_texture, pixel, 0).r;
    if (depth == 0.0)
        return;
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
    if (s.unlit)
        return;
#if LSF_GLOSS
    gloss_unpack(texelFetch(gloss_texture, pixel, 0), s);
#endif
    vec2 ndc = sample_ndc(gl_FragCoord.xy);
    vec3 position = position_from_depth(ndc, depth);
    vec3 view_direction = -normalize(view_ray_direction(ndc));
    vec3 irradiance;
    float distance2;
    vec3 direction = light_direction(position, irradiance, distance2);
    float cosine = dot(s.normal, direction);
    if (cosine <= 0.0 || dot(s.geometric_normal, direction) <= 0.0 ||
        max(irradiance.r, max(irradiance.g, irradiance.b)) <= 0.0)
        return;
    float visibility = shadow_visibility(position, s.geometric_normal);
    if (visibility == 0.0)
        return;
#if LSF_SHADOW_TINT
    irradiance *= shadow_tint(position, s.geometric_normal, s.transmission > 0.0);
#endif
    brdf_value f = brdf_evaluate(s, view_direction, direction, 0.0);
    radiance_out.rgb = brdf_sum(s, f) * irradiance * (cosine * visibility);
}
