/* Demodulation: light divided by the reflectance of the surface that reflected it. */
#ifndef LSF_LIB_LIGHT_CLEAR
#define LSF_LIB_LIGHT_CLEAR

#include "lib/luminance.glsl"

#define LSF_CLEAR_MOST 1e18

/* `light`: as in lsf_light_mean_part; `clear`: the same divided by its factor, A the sum of squared deviations of
 * its luminance. False where nothing is reflected, or where a value is not finite or its square overflows. */
bool light_clear(vec4 light, vec3 factor, out vec4 clear)
{
    float tint = luminance(factor);
    clear = vec4(0.0);
    if (!(tint > 0.0))
        return false;
    /* A channel that the surface does not reflect is set to the brightness of the others. */
    float grey = luminance(light.rgb) / tint;
    vec4 divided = vec4(factor.r > 0.0 ? light.r / factor.r : grey, factor.g > 0.0 ? light.g / factor.g : grey,
                        factor.b > 0.0 ? light.b / factor.b : grey, light.a / (tint * tint));
    /* No comparison holds for NaN. */
    if (!(all(lessThan(abs(divided.rgb), vec3(LSF_CLEAR_MOST))) && divided.a < LSF_CLEAR_MOST * LSF_CLEAR_MOST))
        return false;
    clear = divided;
    return true;
}

#endif
