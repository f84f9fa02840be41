/* The environment's radiance, for user shaders. */
#ifndef LSF_SANDBOX_ENVIRONMENT
#define LSF_SANDBOX_ENVIRONMENT

#include "lib/environment.glsl"

vec3 lsf_environment(vec3 direction)
{
    return environment_radiance(direction);
}

#endif
