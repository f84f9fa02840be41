/* Radiance from outside the scene. Switch LSF_ENVIRONMENT_MAP. */
#ifndef LSF_LIB_ENVIRONMENT
#define LSF_LIB_ENVIRONMENT

#include "shared/brdf.h"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_ENVIRONMENT) uniform vec3 environment_uniform; /* radiance, without a map */
#if LSF_ENVIRONMENT_MAP
layout(binding = LSF_UNIT_ENVIRONMENT) uniform sampler2D environment_texture;
#endif

/* `direction` is a unit vector; u = 0.5 + atan(z, x) / 2 pi, v = acos(y) / pi from the top. */
vec3 environment_radiance(vec3 direction)
{
#if LSF_ENVIRONMENT_MAP
    vec2 uv = vec2(0.5 + atan(direction.z, direction.x) / (2.0 * LSF_PI),
                   acos(clamp(direction.y, -1.0, 1.0)) / LSF_PI);
    return textureLod(environment_texture, uv, 0.0).rgb;
#else
    return environment_uniform;
#endif
}

#endif
