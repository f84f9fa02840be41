/* Radiance from outside the scene. Switch LSF_ENVIRONMENT_MAP. */
#ifndef LSF_LIB_ENVIRONMENT
#define LSF_LIB_ENVIRONMENT

#include "lib/lat_long.glsl"
#include "shared/scene_data.h"

layout(location = LSF_LOCATION_ENVIRONMENT) uniform vec4 environment_uniform;
/* rgb: radiance, without a map; w: rotation of the map, in full turns */
#if LSF_ENVIRONMENT_MAP
layout(binding = LSF_UNIT_ENVIRONMENT) uniform sampler2D environment_texture;
#endif

#if LSF_ENVIRONMENT_MAP
/* Texture coordinates of a unit direction on the map. */
vec2 environment_uv(vec3 direction)
{
    return lat_long(direction) + vec2(environment_uniform.w, 0.0);
}
#endif

/* `direction` is a unit vector. */
vec3 environment_radiance(vec3 direction)
{
#if LSF_ENVIRONMENT_MAP
    return textureLod(environment_texture, environment_uv(direction), 0.0).rgb;
#else
    return environment_uniform.rgb;
#endif
}

#endif
