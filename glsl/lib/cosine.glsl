/* Cosine-distributed directions about z. */
#ifndef LSF_LIB_COSINE
#define LSF_LIB_COSINE

#include "shared/brdf.h"

/* Maps the square to the disc: P. Shirley, K. Chiu, JGT 2(3), 1997. */
vec2 disc_draw(vec2 u)
{
    vec2 a = 2.0 * u - 1.0;
    if (a == vec2(0.0))
        return a;
    bool wide = abs(a.x) > abs(a.y);
    float phi = wide ? LSF_PI / 4.0 * (a.y / a.x) : LSF_PI / 2.0 - LSF_PI / 4.0 * (a.x / a.y);
    return (wide ? a.x : a.y) * vec2(cos(phi), sin(phi));
}

/* The direction above a point of the disc. Uniform points give directions of density cos / pi. */
vec3 cosine_direction(vec2 disc)
{
    return vec3(disc, sqrt(max(0.0, 1.0 - dot(disc, disc))));
}

#endif
