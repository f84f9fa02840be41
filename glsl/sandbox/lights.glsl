/* The scene's lights, for user shaders. */
#ifndef LSF_SANDBOX_LIGHTS
#define LSF_SANDBOX_LIGHTS

#include "shared/light.h"
#include "shared/light_data.h"
#include "shared/sandbox_data.h"

layout(std430, binding = LSF_BINDING_SANDBOX_LIGHTS) readonly buffer lsf_sandbox_light_block
{
    lsf_sandbox_light_data sandbox_lights[];
};

int lsf_light_count()
{
    return LSF_LIGHT_COUNT;
}

vec3 lsf_light(int i, vec3 position, out vec3 direction)
{
    lsf_sandbox_light_data l = sandbox_lights[i];
    direction = -l.direction.xyz;
    if (l.attenuation.w == LSF_LIGHT_TYPE_DIRECTIONAL)
        return l.intensity.rgb;
    vec3 to_light = l.position.xyz - position;
    float distance2 = dot(to_light, to_light);
    direction = to_light * inversesqrt(max(distance2, 1e-30));
    vec3 irradiance = l.intensity.rgb * lsf_distance_attenuation(distance2, l.attenuation.x);
    if (l.attenuation.w == LSF_LIGHT_TYPE_SPOT)
        irradiance *= lsf_spot_attenuation(-dot(l.direction.xyz, direction), l.attenuation.y, l.attenuation.z);
    return irradiance;
}

#endif
