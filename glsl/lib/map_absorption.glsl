/* Absorption by media in a light's map: each surface of a medium multiplies its share into the map's tint. Include
 * it after lib/material.glsl and lib/straight.glsl. Switch LSF_ABSORPTION: there are media. */
#ifndef LSF_LIB_MAP_ABSORPTION
#define LSF_LIB_MAP_ABSORPTION

#ifndef LSF_ABSORPTION
#define LSF_ABSORPTION 0
#endif

/* Whether light from `to_light` enters the medium through this surface. Projections of maps may be mirrored, and
 * the pipeline's front and back with them. Call this before any discard. */
bool map_light_enters(bool front, vec3 to_light)
{
    return front == (dot(cross(dFdx(vertex_position), dFdy(vertex_position)), to_light) > 0.0);
}

/* The share of one surface: the transmittance over `path_length`, the vector from the surface to the point that the map
 * shows, if light enters through it, and the inverse if light leaves through it. The product over a closed body is
 * that body's transmittance. It is bounded, because the product of several shares has to stay finite. */
vec3 map_absorption(surface s, bool enters, float path_length)
{
#if LSF_ABSORPTION
    vec3 absorption = s.volume ? materials[s.material].absorption.rgb : vec3(0.0);
    return exp(clamp(absorption * (enters ? -path_length : path_length), -40.0, 40.0));
#else
    return vec3(1.0);
#endif
}

#endif
