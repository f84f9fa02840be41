/* Fragments of surfaces that the camera sees. */
#ifndef LSF_PASSES_GBUFFER_FRAGMENT
#define LSF_PASSES_GBUFFER_FRAGMENT

#include "lib/material.glsl"
#include "lib/view.glsl"

/* Towards the camera, of any length. */
vec3 fragment_to_viewer()
{
#if LSF_ORTHOGRAPHIC
    return -view.forward.xyz;
#else
    return -vertex_position - view.depth.w * view.forward.xyz;
#endif
}

#endif
