/* The camera, for user shaders. Lengths and positions are those of normalised space; a pixel is given by its
 * fragment coordinates. */
#ifndef LSF_SANDBOX_VIEW
#define LSF_SANDBOX_VIEW

#include "lib/view.glsl"

vec3 lsf_camera_position(vec2 pixel)
{
    return position_from_depth(sample_ndc(pixel), 1.0);
}

vec3 lsf_camera_direction(vec2 pixel)
{
    return normalize(view_ray_direction(sample_ndc(pixel)));
}

float lsf_metres(float length)
{
    return length * view.depth.z;
}

#endif
