/* Directional albedo: the share of light from one direction that a surface reflects to all sides. Switch
 * LSF_SPECULAR. */
#ifndef LSF_LIB_REFLECTANCE
#define LSF_LIB_REFLECTANCE

#include "shared/albedo.h"

struct reflector {
    vec3 base_color;
    float transmission, roughness, f0, metallic;
};

/* The albedo of all lobes together for light at that cosine. */
vec3 reflectance(reflector m, float cosine)
{
    vec3 diffuse = (1.0 - m.transmission) * m.base_color;
#if LSF_SPECULAR
    diffuse *= (1.0 - m.metallic) * lsf_diffuse_albedo(m.f0, 1.0, cosine);
    float none = lsf_specular_albedo(0.0, 1.0, cosine, m.roughness);
    float all = lsf_specular_albedo(1.0, 1.0, cosine, m.roughness);
    return diffuse + mix(vec3(none), vec3(all), mix(vec3(m.f0), m.base_color, m.metallic));
#else
    return diffuse;
#endif
}

#endif
