/* The shadow map of one light, for user shaders. */
#ifndef LSF_SANDBOX_SHADOW
#define LSF_SANDBOX_SHADOW

#include "lib/shadow.glsl"
#include "lib/view.glsl"

float lsf_visibility(vec3 position, vec3 normal)
{
    shadow_raster_error = view_raster_error(position, normal);
    return shadow_visibility(position, normal);
}

#endif
