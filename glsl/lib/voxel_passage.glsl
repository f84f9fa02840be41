/* Rays that go straight on through voxels of materials that transmit: what is left of their light, in each colour.
 * Such a voxel lets T of lib/straight.glsl through, and exp(-a d) is left of light that goes d from the front of a
 * medium to its back. Switches LSF_VOXEL_PASSAGE (without it nothing is here), LSF_TRANSMISSION, LSF_STRAIGHT,
 * LSF_VOXEL_GLOSS, LSF_ABSORPTION (there are media). */
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
#if LSF_VOXEL_GLOSS
layout(binding = LSF_UNIT_VOXEL_GLOSS) uniform usampler3D passage_gloss;
#endif
layout(binding = LSF_UNIT_VOXEL_TRANSMISSION) uniform usampler3D passage_transmission;

/* A ray goes through no more surfaces than that. */
#define VOXEL_PASSAGE_MOST 24

/* Voxels of one sheet may each be met by a ray that crosses it once, for their planes differ. A plane that looks the
 * same way, and passes no further than this from where the ray crossed the one before, is of the same sheet, if the ray
 * has not gone further than that since. [voxels] */
#define VOXEL_SHEET_HEIGHT 1.0
#define VOXEL_SHEET_WAY 4.0

struct voxel_passage {
    vec3 left;       /* of the light */
    vec3 entry;      /* what the surface by which the ray came into a medium let through */
    float entered;   /* how far along the ray; below 0: it is in no medium */
    float crossed;   /* how far along the ray it crossed the last surface ... */
    float facing;    /* ... against its normal (below 0), or with it; 0: it has crossed none */
};

voxel_passage voxel_passage_begin()
{
    return voxel_passage(vec3(1.0), vec3(1.0), -1.0, 0.0, 0.0);
}

/* The surface of a voxel as far as straight_transmittance looks at it; `n`: the plane's normal. */
surface passage_surface(ivec3 cell, uint normal_bits, vec3 n)
{
    surface s = surface_unpack(uvec4(0u));
    s.geometric_normal = n;
    s.normal = voxel_normal_unpack(voxel_shading_bits(cell, normal_bits));
    s.base_color = voxel_albedo_unpack(texelFetch(passage_albedo, cell, 0).r);
#if LSF_VOXEL_GLOSS
    vec4 gloss = unpackUnorm4x8(texelFetch(passage_gloss, cell, 0).r);
    s.roughness = sqrt(gloss.x * gloss.y); /* with it the product of both alphas is kept */
    s.f0 = gloss.z * gloss.z;
    s.metallic = gloss.w;
#endif
    transmission_unpack(texelFetch(passage_transmission, cell, 0).r, s);
    return s;
}

/* The ray has met that voxel, and is beyond it. `sheet`: it is one of a sheet that it has crossed already, or within
 * the medium that it has come into, and is not in the way. False: no light comes through. */
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
        p.left *= transmittance; /* its front is in no voxel of its own: the body is thinner than one */
    }
    return true;
}

/* What is left where the ray ends. */
vec3 voxel_passed(voxel_passage p)
{
    /* A body whose back is in no voxel of its own. */
    return p.entered >= 0.0 ? p.left * p.entry : p.left;
}

/* What comes of light from one point of surface to another, as voxel_sees has it. */
vec3 voxel_seen(vec3 from, vec3 from_normal, vec3 to, vec3 to_normal)
{
    vec3 start = from + voxel_lift(from_normal);
    vec3 span = to + voxel_lift(to_normal) - start;
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
