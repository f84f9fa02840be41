/* What media leave of light in a map that its surfaces multiply their shares into; after lib/material.glsl and
 * lib/straight.glsl. Switch LSF_ABSORPTION: there are media. */
#ifndef LSF_LIB_MAP_ABSORPTION
#define LSF_LIB_MAP_ABSORPTION

#ifndef LSF_ABSORPTION
#define LSF_ABSORPTION 0
#endif

/* Whether light from `to_light` comes in by this surface of a medium. Maps may be mirrored, and the pipeline's front and
 * back with them. Call it before any discard. */
bool map_light_enters(bool front, vec3 to_light)
{
    return front == (dot(cross(dFdx(vertex_position), dFdy(vertex_position)), to_light) > 0.0);
}

/* The share of one surface: what is left over `way`, which is from there to what the map shows, if light comes in by it,
 * and the inverse if it leaves by it. The product over a closed body is what that leaves. Bounded, for the products of
 * several have to stay finite. */
vec3 map_absorption(surface s, bool enters, float way)
{
#if LSF_ABSORPTION
    vec3 absorption = s.volume ? materials[s.material].absorption.rgb : vec3(0.0);
    return exp(clamp(absorption * (enters ? -way : way), -40.0, 40.0));
#else
    return vec3(1.0);
#endif
}

#endif
