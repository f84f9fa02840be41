/* Light of emissive surfaces in voxels, found by points on them that are drawn by power as well as by rays
 * that meet them, and how the two share it: by the power heuristic with exponent 2 (Veach and Guibas 1995,
 * "Optimally Combining Sampling Techniques for Monte Carlo Rendering", section 4).
 *
 * A point's density by area of sides, for weights, is its luminance times `emitters.x`, which a voxel tells of
 * its surface, too; a vertex that sees either side takes both for one. Where a texture varies within a triangle, points are drawn by its mean instead. */
#ifndef LSF_LIB_VOXEL_EMITTER
#define LSF_LIB_VOXEL_EMITTER

#include "lib/emitter.glsl"
#include "lib/voxel_sight.glsl"

layout(binding = LSF_UNIT_VOXEL_EMISSION) uniform usampler3D voxel_emission;

/* x: density by area of a point of luminance 1, y: points that are drawn at a vertex. */
layout(location = 2) uniform vec2 emitters;

/* Of what has the density `own` in one of the two ways and `other` in the other. By their ratio, whose square
 * may overflow to a share of 0. */
float emitter_share(float own, float other)
{
    float ratio = other / own;
    return 1.0 / (1.0 + ratio * ratio);
}

/* A point on an emitter as a vertex sees it. */
struct emitter_view {
    vec3 position, normal; /* [voxels]; unit, towards the vertex */
    vec3 direction;        /* unit, to the point */
    vec3 radiance;         /* times `density` over that with which it was drawn */
    float density;         /* with which this direction is drawn, for weights [1/sr] */
};

/* Density by direction of what is drawn with `by_area`, whose squared distance is in voxels. */
float emitter_density(float by_area, float distance2, float cosine)
{
    return by_area * distance2 * grid.origin.w * grid.origin.w / cosine;
}

/* As the voxel has it that the point is in; if another surface has won that, or a mask leaves it empty, with
 * what it held before, as the point itself. */
float emitter_point_luminance(vec3 place, vec3 radiance)
{
    ivec3 cell = ivec3(floor(place));
    vec3 held = voxel_emission_unpack(texelFetch(voxel_emission, cell, 0).r);
    float luminance = voxel_occupied(cell) ? emitter_luminance(held) * grid.unit.x : 0.0;
    return luminance > 0.0 ? luminance : emitter_luminance(radiance);
}

/* Draws a point for a vertex at `place` [voxels] with this normal. False: it does not shine there. */
bool emitter_view_from(vec3 place, vec3 normal, vec2 u, out emitter_view e)
{
    lsf_emitter_point_data point = emitter_draw(u);
    e.position = voxel_from_position(point.position.xyz);
    e.normal = point.normal.xyz;
    vec3 to = e.position - place;
    float distance2 = dot(to, to);
    e.direction = to * inversesqrt(max(distance2, 1.0 / VOXEL_FAR));
    float cosine = -dot(e.normal, e.direction);
    if (point.radiance.w > 1.0 && cosine < 0.0) { /* the other side shines as well */
        e.normal = -e.normal;
        cosine = -cosine;
    }
    if (cosine <= 0.0 || dot(normal, e.direction) <= 0.0)
        return false;
    float by_area = emitter_point_luminance(e.position, point.radiance.rgb) * emitters.x;
    e.density = emitter_density(by_area * point.radiance.w, distance2, cosine);
    e.radiance = point.radiance.rgb * (by_area / point.normal.w);
    return e.density > 0.0;
}

/* Of what a ray from `place` meets in a voxel with the point q and the unit normal n: density with which
 * its direction would have been drawn. `bits`: the voxel's in voxelize.point. */
float emitter_density_met(vec3 place, vec3 direction, vec3 q, vec3 n, uint bits, vec3 emission)
{
    if (voxel_unlit(bits))
        return 0.0; /* these are not drawn */

    float cosine = -dot(n, direction);
    float along = -dot(n, q - place) / cosine; /* to the voxel's plane */
    if (!(cosine > 0.0 && along > 0.0))
        return 0.0;
    float by_area = emitter_luminance(emission) * emitters.x;
    return emitter_density(voxel_emits_both(bits) ? 2.0 * by_area : by_area, along * along, cosine);
}

#endif
