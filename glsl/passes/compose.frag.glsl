/* The picture as the sum of its parts. */
#include "lib/environment.glsl"
#include "lib/view.glsl"

layout(binding = 0) uniform sampler2D depth_texture;
#if LSF_EMISSION
layout(binding = 1) uniform sampler2D emission_texture;
#endif
#if LSF_DIRECT
layout(binding = 2) uniform sampler2D direct_texture;
#endif
layout(location = 0) out vec4 radiance_out;
#if LSF_SEEN
layout(location = 1) out vec4 seen_out; /* emission and environment alone */
#endif

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 radiance = vec3(0.0);
#if LSF_EMISSION
    radiance += texelFetch(emission_texture, pixel, 0).rgb;
#endif
#if LSF_ENVIRONMENT
    if (texelFetch(depth_texture, pixel, 0).r == 0.0)
        radiance += environment_radiance(normalize(view_ray_direction(sample_ndc(gl_FragCoord.xy))));
#endif
#if LSF_SEEN
    seen_out = vec4(radiance, 1.0);
#endif
#if LSF_DIRECT
    radiance += texelFetch(direct_texture, pixel, 0).rgb;
#endif
    radiance_out = vec4(radiance, 1.0);
}
