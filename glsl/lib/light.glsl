/* The current punctual light. Switches LSF_SPOT_LIGHT, LSF_DIRECTIONAL_LIGHT. */
#ifndef LSF_LIB_LIGHT
#define LSF_LIB_LIGHT

#include "lib/light_projection.glsl"
#include "shared/light.h"

/* Direction to the light and the irradiance [W/m^2] on a plane that faces it. `distance2` is 1 for
 * a directional light. */
vec3 light_direction(vec3 position, out vec3 irradiance, out float distance2)
{
    irradiance = light.intensity.rgb;
    distance2 = 1.0;
#if LSF_DIRECTIONAL_LIGHT
    if (light.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL)
        return -light.direction.xyz;
#endif
    vec3 to_light = light.position.xyz - position;
    distance2 = dot(to_light, to_light);
    vec3 direction = to_light * inversesqrt(max(distance2, 1e-30));
    irradiance *= lsf_distance_attenuation(distance2, light.attenuation.x);
#if LSF_SPOT_LIGHT
    irradiance *= lsf_spot_attenuation(-dot(light.direction.xyz, direction), light.attenuation.y,
                                       light.attenuation.z);
#endif
    return direction;
}

#endif
