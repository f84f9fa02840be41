/* Directional albedo of the specular lobe: the tint by which its light is divided before pixels share it. */
#ifndef LSF_LIB_SPECULAR_ALBEDO
#define LSF_LIB_SPECULAR_ALBEDO

#include "lib/brdf.glsl"

/* `view`: unit, towards the viewer. */
vec3 specular_albedo(surface s, vec3 view)
{
    vec3 f0 = mix(surface_f0(s), s.base_color, s.metallic);
    float f90 = mix(surface_f90(s), 1.0, s.metallic);
#if LSF_SCATTER
    if (s.through) {
        f0 = surface_specular_f0(s);
        f90 = surface_specular_f90(s);
    }
#endif
    return lobe_albedo(f0, f90, dot(s.normal, view), pow(s.roughness, 4.0));
}

#endif
