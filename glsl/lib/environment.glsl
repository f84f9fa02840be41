/* Radiance from outside the scene. Switch LSF_ENVIRONMENT_MAP. */
#ifndef LSF_LIB_ENVIRONMENT
#define LSF_LIB_ENVIRONMENT

#include "lib/lat_long.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_ENVIRONMENT) uniform vec3 environment_uniform; /* radiance, without a map */
#if LSF_ENVIRONMENT_MAP
layout(binding = LSF_UNIT_ENVIRONMENT) uniform sampler2D environment_texture;
#endif

/* `direction` is a unit vector. */
vec3 environment_radiance(vec3 direction)
{
#if LSF_ENVIRONMENT_MAP
    return textureLod(environment_texture, lat_long(direction), 0.0).rgb;
#else
    return environment_uniform;
#endif
}

#endif
