/* Microfacets' normals, drawn as they are seen. */
#ifndef LSF_LIB_VISIBLE_NORMAL
#define LSF_LIB_VISIBLE_NORMAL

#include "lib/cosine.glsl"

/* E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018. */
vec3 visible_normal(vec3 view, float alpha_t, float alpha, vec2 disc)
{
    vec3 stretched = normalize(vec3(alpha_t, alpha, 1.0) * view);
    /* The half of the disc on the side of the horizon is compressed. */
    float side = length(stretched.xy);
    vec3 across = side > 1e-7 ? vec3(-stretched.y, stretched.x, 0.0) / side : vec3(1.0, 0.0, 0.0);
    float share = 0.5 * (1.0 + stretched.z);
    disc.y = mix(sqrt(max(0.0, 1.0 - disc.x * disc.x)), disc.y, share);
    vec3 q = cosine_direction(disc);
    vec3 n = q.x * across + q.y * cross(stretched, across) + q.z * stretched;
    return normalize(vec3(alpha_t * n.x, alpha * n.y, max(n.z, 1e-7)));
}

#endif
