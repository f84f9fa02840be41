/* Transmittance between the surface in a pixel and the eye. Switches LSF_SEEN_THROUGH, LSF_ABSORPTION: there
 * may be surfaces in front of it that transmit light, and media. */
#ifndef LSF_LIB_TRANSMITTANCE_TO_EYE
#define LSF_LIB_TRANSMITTANCE_TO_EYE

#ifdef LSF_SEEN_THROUGH
layout(binding = 10) uniform sampler2D tint_texture;
#if LSF_ABSORPTION
layout(binding = 11) uniform sampler2D absorption_texture;
#endif
#endif

vec3 transmittance_to_eye(ivec2 pixel)
{
    vec3 tint = vec3(1.0);
#ifdef LSF_SEEN_THROUGH
    tint = texelFetch(tint_texture, pixel, 0).rgb;
#if LSF_ABSORPTION
    tint *= exp(-max(texelFetch(absorption_texture, pixel, 0).rgb, 0.0));
#endif
#endif
    return tint;
}

#endif
