/* The lobe that a VPL sheds light in whose surface has reflected it by microfacets (GGX, shared/brdf.h): g = pi D V / A,
 * with A the albedo, so that the flux is pi I as of a diffuse VPL, whose lobe is 1. In a record it is 6 bits of
 * roughness, counted from 1, and 2 x 10 of the direction that the light came from; 0 where light is diffuse. */
#ifndef LSF_LIB_VPL_LOBE
#define LSF_LIB_VPL_LOBE

#include "lib/octahedral.glsl"
#include "lib/visible_normal.glsl"
#include "shared/albedo.h"
#include "shared/vpl_record.h"

struct vpl_lobe {
    vec3 from; /* unit, towards where the light came from */
    float roughness;
};

bool vpl_has_lobe(lsf_vpl_record v)
{
    return v.depth_and_lobe > LSF_VPL_DEPTH_MASK;
}

/* Above the normal's horizon, by as much as cosines in denominators want. */
vec3 vpl_lobe_lift(vec3 direction, vec3 n)
{
    float cosine = dot(n, direction);
    return cosine >= 0.01 ? direction : normalize(direction + (0.01 - cosine) * n);
}

uint vpl_lobe_pack(vpl_lobe lobe)
{
    uvec2 place = uvec2(clamp(octahedral_position(lobe.from) * 0.5 + 0.5, 0.0, 1.0) * 1023.0 + 0.5);
    uint roughness = 1u + uint(clamp(lobe.roughness, 0.0, 1.0) * 62.0 + 0.5);
    return (roughness << 6) | (place.x << 12) | (place.y << 22);
}

/* Of one that has a lobe. */
vpl_lobe vpl_lobe_unpack(lsf_vpl_record v)
{
    uint bits = v.depth_and_lobe;
    vec2 place = vec2((bits >> 12) & 1023u, bits >> 22) * (2.0 / 1023.0) - 1.0;
    vec3 n = octahedral_decode(v.normal);
    return vpl_lobe(vpl_lobe_lift(octahedral_normal(place), n), float(((bits >> 6) & 63u) - 1u) / 62.0);
}

float vpl_lobe_albedo(float nv, float roughness)
{
    return max(lsf_specular_albedo(1.0, 1.0, nv, roughness), 1e-3);
}

/* g, towards a direction above the surface. */
float vpl_lobe_towards(vec3 n, vec3 from, vec3 direction, float alpha)
{
    float nv = dot(n, from), nl = dot(n, direction);
    vec3 h = normalize(from + direction), nxh = cross(n, h);
    float d = lsf_ggx_d(clamp(dot(n, h), 0.0, 1.0), dot(nxh, nxh), alpha);
    return LSF_PI * d * lsf_ggx_v(nl, nv, alpha) / vpl_lobe_albedo(nv, sqrt(alpha));
}

/* A direction drawn by the microfacets' normals, and g cos / (pi p); 0: it is below the surface. */
vec3 vpl_lobe_draw(vec3 n, vpl_lobe lobe, vec2 u, out float weight)
{
    vec3 t, b;
    orthonormal_basis(n, t, b);
    float alpha = lsf_alpha_from_roughness(lobe.roughness);
    vec3 view = vec3(dot(t, lobe.from), dot(b, lobe.from), dot(n, lobe.from));
    vec3 h = visible_normal(view, alpha, alpha, disc_draw(u));
    vec3 local = 2.0 * dot(view, h) * h - view;
    weight = 0.0;
    if (local.z > 0.0)
        weight = 2.0 * local.z * (view.z + length(vec3(alpha, alpha, 1.0) * view)) *
                 lsf_ggx_v(local.z, view.z, alpha) / vpl_lobe_albedo(view.z, lobe.roughness);
    return normalize(local.x * t + local.y * b + local.z * n);
}

/* Where most of it goes. */
vec3 vpl_lobe_axis(vec3 n, vpl_lobe lobe)
{
    return reflect(-lobe.from, n);
}

/* Mean of the cosine to the axis, of a distribution of von Mises and Fisher with the same peak, kappa / 2 pi = 1 / (4 pi
 * alpha^2). */
float vpl_lobe_mean_cosine(float alpha)
{
    float inverse = 2.0 * alpha * alpha, e = exp(-2.0 / inverse);
    return (1.0 + e) / (1.0 - e) - inverse;
}

#endif
