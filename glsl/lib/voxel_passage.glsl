/* Rays that continue straight through voxels of transmitting materials, and their transmittance. A voxel transmits
 * T of lib/straight.glsl, and a medium exp(-a d) over the distance d from its front to its back. Switches
 * LSF_VOXEL_PASSAGE (without it this file is empty), LSF_TRANSMISSION, LSF_STRAIGHT, LSF_VOXEL_SPECULAR_PARAMS,
 * LSF_ABSORPTION (there are media). */
#ifndef LSF_LIB_VOXEL_PASSAGE
#define LSF_LIB_VOXEL_PASSAGE

#ifndef LSF_VOXEL_PASSAGE
#define LSF_VOXEL_PASSAGE 0
#endif

#include "lib/straight.glsl"
#include "lib/voxel_shading.glsl"
#include "lib/voxel_sight.glsl"

#if LSF_VOXEL_PASSAGE
#if LSF_ABSORPTION
#include "lib/scene.glsl"
#endif

layout(binding = LSF_UNIT_VOXEL_ALBEDO) uniform usampler3D passage_albedo;
#if LSF_VOXEL_SPECULAR_PARAMS
layout(binding = LSF_UNIT_VOXEL_SPECULAR_PARAMS) uniform usampler3D passage_specular_params;
#endif
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D passage_transmission;

/* Largest number of surfaces that a ray passes. */
#define VOXEL_PASSAGE_MOST 24

/* A ray may hit several voxels of a sheet that it crosses once, because their planes differ. A plane that faces
 * the same way and passes within this distance of the previous crossing belongs to the same sheet, unless the ray
 * has gone further than this since. [voxels] */
#define VOXEL_SHEET_HEIGHT 1.0
#define VOXEL_SHEET_WAY 4.0

struct voxel_passage {
    vec3 left;       /* of the light */
    vec3 entry;      /* transmittance of the surface through which the ray entered a medium */
    float entered;   /* distance of that along the ray; below 0: it is in no medium */
    float crossed;   /* distance along the ray of the last surface that it crossed */
    float facing;    /* cosine to that normal: below 0 against it, above along it; 0: none crossed */
};

voxel_passage voxel_passage_begin()
{
    return voxel_passage(vec3(1.0), vec3(1.0), -1.0, 0.0, 0.0);
}

/* The members of a voxel's surface that straight_transmittance reads; `n`: the plane's normal. */
surface passage_surface(ivec3 cell, uint normal_bits, vec3 n)
{
    surface s = surface_unpack(uvec4(0u));
    s.geometric_normal = n;
    s.normal = voxel_normal_unpack(voxel_shading_bits(cell, normal_bits));
    s.base_color = voxel_albedo_unpack(texelFetch(passage_albedo, cell, 0).r);
#if LSF_VOXEL_SPECULAR_PARAMS
    vec4 specular_params = unpackUnorm4x8(texelFetch(passage_specular_params, cell, 0).r);
    s.roughness = sqrt(specular_params.x * specular_params.y); /* keeps the product of both alphas */
    s.f0 = specular_params.z * specular_params.z;
    s.metallic = specular_params.w;
#endif
    transmission_unpack(texelFetch(passage_transmission, cell, 0).r, s);
    return s;
}

/* Takes the ray through a voxel that it has hit and left. `sheet`: the voxel belongs to a sheet that the ray has
 * crossed already, or lies within the medium that it has entered, and does not occlude. False: no light is
 * transmitted. */
bool voxel_pass(inout voxel_passage p, voxel_ray ray, ivec3 cell, out bool sheet)
{
    uint point = texelFetch(voxel_point, cell, 0).r, normal_bits = texelFetch(voxel_normal, cell, 0).r;
    vec3 n = voxel_normal_unpack(normal_bits), q = vec3(cell) + voxel_point_unpack(point);
    surface s = passage_surface(cell, normal_bits, n);
    sheet = false;
    if (voxel_unlit(point) || s.transmission == 0.0)
        return false;
    float facing = dot(n, ray.direction);
    float height = dot(n, ray.origin + p.crossed * ray.direction - q);
    sheet = p.facing * facing > 0.0 && abs(height) < VOXEL_SHEET_HEIGHT &&
            ray.distance < p.crossed + VOXEL_SHEET_WAY;
    sheet = sheet || (s.volume && facing < 0.0 && p.entered >= 0.0);
    if (sheet)
        return true;
    float at = clamp(dot(n, q - ray.origin) / (facing == 0.0 ? 1.0 : facing), ray.distance - 2.0, ray.distance);
    p.crossed = max(at, 0.0);
    p.facing = facing;
    vec3 transmittance = straight_transmittance(s, -ray.direction);
    p.left *= transmittance;
    if (s.volume && facing < 0.0) {
        p.entered = p.crossed;
        p.entry = transmittance;
    } else if (s.volume && p.entered >= 0.0) {
#if LSF_ABSORPTION
        p.left *= exp(-materials[s.material].absorption.rgb * ((p.crossed - p.entered) * grid.origin.w));
#endif
        p.entered = -1.0;
    } else if (s.volume) {
        p.left *= transmittance; /* no voxel stores the body's front: it is thinner than one */
    }
    return true;
}

/* Transmittance at the end of the ray. */
vec3 voxel_passed(voxel_passage p)
{
    /* No voxel stores the body's back. */
    return p.entered >= 0.0 ? p.left * p.entry : p.left;
}

/* Transmittance between two surface points, with visibility as in voxel_sees. */
vec3 voxel_seen(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal)
{
    vec3 start = from + voxel_lift_towards(from, from_normal, to, to_normal);
    vec3 span = to + voxel_lift_towards(to, to_normal, from, from_normal) - start;
    float end = length(span);
    voxel_ray ray;
    if (dot(span, to - from) <= 0.0 || !voxel_ray_begin(start, span / end, ray))
        return vec3(1.0);
    voxel_passage passage = voxel_passage_begin();
    for (int i = 0; i < VOXEL_PASSAGE_MOST; i++) {
        ivec3 met;
        bool sheet;
        if (!voxel_ray_meet(ray, end, false, met))
            return voxel_passed(passage);
        if (!voxel_pass(passage, ray, met, sheet))
            break;
    }
    return vec3(0.0);
}
#endif

#endif
