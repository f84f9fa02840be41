/* The tint of a pixel's specular light. */
#ifndef LSF_PASSES_SPARSE_TINT
#define LSF_PASSES_SPARSE_TINT

#include "lib/specular_albedo.glsl"

/* A lower bound, because light is divided by the tint. */
#define LEAST_TINT 1e-4

vec3 specular_tint(ivec2 pixel)
{
    surface s = surface_unpack(texelFetch(surface_texture, pixel, 0));
#if LSF_SPECULAR_PARAMS
    specular_params_unpack(texelFetch(specular_params_texture, pixel, 0), s);
#endif
    vec3 view = -normalize(view_ray_direction(sample_ndc(vec2(pixel) + 0.5)));
    return max(specular_albedo(s, surface_view(s, view)), LEAST_TINT);
}

#endif
