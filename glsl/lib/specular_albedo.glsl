/* Directional albedo of the specular lobe, and of what the surface transmits, where paths bring that to the eye with its
 * light: the tint by which this is divided before pixels share it. Switch LSF_REFRACTED: paths begin at media alone. */
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
    vec3 albedo = lobe_albedo(f0, f90, dot(s.normal, view), pow(s.roughness, 4.0));
#if LSF_TRANSMISSION && (!LSF_STRAIGHT || LSF_REFRACTED)
    if (s.volume)
        albedo += (1.0 - largest(albedo)) * s.transmission * (1.0 - s.metallic) * s.base_color;
#endif
    return albedo;
}

#endif
