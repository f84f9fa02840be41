/* Directional albedo: the share of light from one direction that a surface reflects to all sides. Switch
 * LSF_SPECULAR. */
#ifndef LSF_LIB_REFLECTANCE
#define LSF_LIB_REFLECTANCE

#include "shared/albedo.h"

struct reflector {
    vec3 base_color;
    float transmission, roughness, f0, metallic;
};

/* The albedos of the diffuse and of the specular lobe for light at that cosine. */
void reflectances(reflector m, float cosine, out vec3 diffuse, out vec3 specular)
{
    diffuse = (1.0 - m.transmission) * m.base_color;
    specular = vec3(0.0);
#if LSF_SPECULAR
    diffuse *= (1.0 - m.metallic) * lsf_diffuse_albedo(m.f0, 1.0, cosine);
    float none = lsf_specular_albedo(0.0, 1.0, cosine, m.roughness);
    float all = lsf_specular_albedo(1.0, 1.0, cosine, m.roughness);
    specular = mix(vec3(none), vec3(all), mix(vec3(m.f0), m.base_color, m.metallic));
#endif
}

/* The albedo of all lobes together for light at that cosine. */
vec3 reflectance(reflector m, float cosine)
{
    vec3 diffuse, specular;
    reflectances(m, cosine, diffuse, specular);
    return diffuse + specular;
}

#endif
