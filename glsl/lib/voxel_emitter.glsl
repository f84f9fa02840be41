/* Light of emissive surfaces in voxels, found by points that are drawn on them in proportion to power and by rays
 * that hit them. The two strategies are weighted by the power heuristic with exponent 2 (Veach and Guibas 1995,
 * "Optimally Combining Sampling Techniques for Monte Carlo Rendering", section 4).
 *
 * For the weights, a point's density by area of sides is its luminance times `emitters.x`, which is also known of a
 * voxel's surface; a vertex that sees either side counts both as one. Where a texture varies within a triangle, points
 * are in fact drawn by the triangle's mean. */
#ifndef LSF_LIB_VOXEL_EMITTER
#define LSF_LIB_VOXEL_EMITTER

#include "lib/emitter.glsl"
#include "lib/voxel_emission.glsl"

/* x: density by area of a point of luminance 1; y: number of points drawn for each vertex. */
layout(location = LSF_LOCATION_EMITTERS) uniform vec2 emitters;

/* Weight of a sample with the density `own` under its strategy and `other` under the other one. It is computed
 * from their ratio, whose square may overflow to a weight of 0. */
float emitter_share(float own, float other)
{
    float ratio = other / own;
    return 1.0 / (1.0 + ratio * ratio);
}

/* To rays an emitter is as large as the voxels that it touches: a strip half a voxel wide is three times too bright. Where
 * this matters, at its border, they count for the weights as if they were this much rarer; where points alone are too
 * rare, in mirrors, they still find the light. */
#define EMITTER_BORDER_CHANCE (1.0 / 64.0)

/* Factor on the density of rays that hit a voxel's emission, for weights. */
float emitter_chance(ivec3 cell)
{
    return (texelFetch(voxel_emission, cell, 0).r & VOXEL_EMISSION_BORDER) != 0u ? EMITTER_BORDER_CHANCE : 1.0;
}

/* A point on an emitter, seen from a vertex. */
struct emitter_view {
    vec3 position, normal; /* [voxels]; unit, towards the vertex */
    vec3 direction;        /* unit, to the point */
    vec3 radiance;         /* times `density` over the density with which it was drawn */
    float density;         /* density of this direction, for weights [1/sr] */
    float chance;          /* factor on the density of rays that hit it, for weights */
    float resolved;        /* factor on the radiance where the vertex is a voxel */
};

/* Density by solid angle of a point drawn with `by_area`; the squared distance is in voxels. */
float emitter_density(float by_area, float distance2, float cosine)
{
    return by_area * distance2 * grid.origin.w * grid.origin.w / cosine;
}

/* Luminance that the voxel around the point stores; that of the point itself if another surface owns the voxel or
 * a mask leaves it empty. */
float emitter_point_luminance(vec3 position, vec3 radiance)
{
    ivec3 cell = ivec3(floor(position));
    vec3 held = voxel_emission_unpack(texelFetch(voxel_emission, cell, 0).r);
    float luminance = voxel_occupied(cell) ? emitter_luminance(held) * grid.unit.x : 0.0;
    return luminance > 0.0 ? luminance : emitter_luminance(radiance);
}

/* Draws a point for a vertex at `position` [voxels] with this normal. False: it emits no light towards the vertex. */
bool emitter_view_from(vec3 position, vec3 normal, vec2 u, out emitter_view e)
{
    lsf_emitter_point_data point = emitter_draw(u);
    e.position = voxel_from_position(point.position.xyz);
    e.normal = point.normal.xyz;
    vec3 to = e.position - position;
    float distance2 = dot(to, to);
    e.direction = to * inversesqrt(max(distance2, 1.0 / VOXEL_FAR));
    /* The point of a voxel stands for its whole surface, so that a distance below one voxel is not known. The light is
     * then that from one voxel away: 1 / d^2 would have no bound, because rays do not find such emitters (`chance`). */
    e.resolved = min(distance2, 1.0);
    float cosine = -dot(e.normal, e.direction);
    if (point.radiance.w > 1.0 && cosine < 0.0) { /* the other side emits as well */
        e.normal = -e.normal;
        cosine = -cosine;
    }
    if (cosine <= 0.0 || dot(normal, e.direction) <= 0.0)
        return false;
    float by_area = emitter_point_luminance(e.position, point.radiance.rgb) * emitters.x;
    e.density = emitter_density(by_area * point.radiance.w, distance2, cosine);
    e.radiance = point.radiance.rgb * (by_area / point.normal.w);
    /* Rays start above the voxels of their own surface (voxel_start), and miss what faces it from within them. */
    vec3 start = abs(dot(e.normal, normal)) < VOXEL_EDGE ? position + voxel_lift(normal)
                                                         : voxel_start_along(position, normal, e.direction);
    e.chance = dot(e.normal, start - e.position) <= 0.0 ? 0.0 : emitter_chance(ivec3(floor(e.position)));
    return e.density > 0.0;
}

/* The same for a vertex of these normals, of its plane and for shading; no light either where voxels are between, or from
 * behind. `cosine`: at the vertex. */
bool emitter_seen_from(vec3 position, vec3 geometric_normal, vec3 normal, vec2 u, out emitter_view e, out float cosine)
{
    cosine = 0.0;
    if (!emitter_view_from(position, geometric_normal, u, e))
        return false;
    cosine = dot(normal, e.direction);
    return cosine > 0.0 && voxel_sees(position, geometric_normal, e.position, e.normal);
}

/* For a ray from `position` that hits a voxel with the point q and the unit normal n: density with which the
 * direction would have been drawn by emitter_view_from, over the factor on that of rays. */
float emitter_density_met(vec3 position, vec3 direction, ivec3 cell, vec3 q, vec3 n, vec3 emission)
{
    uint bits = texelFetch(voxel_point, cell, 0).r;
    if (voxel_unlit(bits))
        return 0.0; /* such surfaces are not drawn */

    float cosine = -dot(n, direction);
    float along = -dot(n, q - position) / cosine; /* to the voxel's plane */
    if (!(cosine > 0.0 && along > 0.0))
        return 0.0;
    float by_area = emitter_luminance(emission) * emitters.x / emitter_chance(cell);
    return emitter_density(voxel_emits_both(bits) ? 2.0 * by_area : by_area, along * along, cosine);
}

#endif
