/* Cone tracing through voxels. Switches LSF_SEALED: a cone is replaced by the ray along its axis, which ends at
 * the surface that it hits; else it marches through the pyramid of radiance; LSF_VOXEL_SIDES, as in voxel_mip, or
 * when sealed LSF_VOXEL_SIDES_SURFACE; LSF_VOXEL_PASSAGE: sealed rays continue through transmitting surfaces,
 * tinted; LSF_VOXEL_DRAW: sealed cones share light with draws of voxels; LSF_EMITTERS: and emission with points drawn
 * on emitters; LSF_VOXEL_LAMPS: smooth metals mirror lamps to sealed cones. */
#ifndef LSF_LIB_VOXEL_CONE
#define LSF_LIB_VOXEL_CONE

#include "lib/voxel_emission.glsl"
#include "shared/cone.h"
#if LSF_SEALED
#include "lib/voxel_passage.glsl"
#endif
#if LSF_EMITTERS
#include "lib/voxel_emitter.glsl"
#endif
#if LSF_VOXEL_DRAW
#include "lib/voxel_draw.glsl"

/* Number of sides of voxels that are drawn by their radiance for each point. */
layout(location = LSF_LOCATION_VOXEL_DRAW) uniform int cone_draws;
#endif
#if LSF_VOXEL_LAMPS || LSF_VOXEL_MIRRORS
#include "lib/voxel_surface.glsl"
#endif

layout(binding = LSF_UNIT_VOXEL_RADIANCE) uniform sampler3D radiance_texture;

/* step: length of a step, in texels; offset: of the start from the surface, in voxels; reach: longest distance
 * [voxels]; opacity: factor on the opacity of texels. */
layout(location = LSF_LOCATION_CONE) uniform vec4 cone_march;
layout(location = LSF_LOCATION_CONE_STEPS) uniform int cone_steps; /* at most */

/* Directions about the normal (z) at the centre of their rings, and the cones' diameter per unit length. */
layout(location = LSF_LOCATION_CONE_SET) uniform vec4 cone_set[LSF_CONE_MAX];
/* Rotation of the whole set; whether points differ (0 or 1); number of cones; their position in their rings, from
 * 0 to 1. */
layout(location = LSF_LOCATION_CONE_ROTATION) uniform vec4 cone_gather;

/* Transmittance below which a cone ends: half a step of an 8-bit picture. */
#define CONE_OPAQUE 0.002

/* Transmittance of an opaque texel, above 0 so that its logarithm is finite. */
#define CONE_CLEAR_MIN 1e-7

/* The i-th direction about z. `shift`: offset of the point's rotation and ring position from those of other
 * points. */
vec3 cone_direction(int i, vec2 shift)
{
    shift = cone_gather.xw + cone_gather.y * shift;
    float radius2 = lsf_cone_radius2(float(i), fract(shift.y), cone_gather.z);
    float angle = 2.0 * LSF_PI * shift.x;
    vec2 circle = sqrt(radius2) * normalize(cone_set[i].xy);
    return vec3(mat2(cos(angle), sin(angle), -sin(angle), cos(angle)) * circle, sqrt(1.0 - radius2));
}

struct cone_light {
    vec3 radiance;      /* in the grid's unit */
    vec3 transmittance; /* share of the environment that is visible */
};

#if LSF_SEALED
/* The slice of a voxel's side that is seen along `direction`. */
int cone_slice(ivec3 cell, vec3 direction)
{
#if LSF_VOXEL_SIDES == LSF_VOXEL_SIDES_SURFACE
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    return dot(n, direction) <= 0.0 ? 0 : 1;
#else
    return 0;
#endif
}

/* Radiance of a voxel, seen along `direction`. */
vec3 cone_meet(ivec3 cell, vec3 direction)
{
    int slice = cone_slice(cell, direction);
    return texelFetch(radiance_texture, cell + ivec3(0, 0, slice * int(grid.size.z)), 0).rgb;
}

/* Light of the voxel's side in which a ray ends, in the grid's unit: what points on emitters find as well, weighted
 * against them, and the rest. */
struct cone_end {
    vec3 emission, rest;
};

/* `density`: of one ray that finds this direction from the point by chance [1/sr]. However many cones there are, one
 * is weighted against the points: to cones an emitter looks up to a voxel larger. */
cone_end cone_end_at(vec3 point, vec3 direction, ivec3 cell, float density)
{
    cone_end end = cone_end(vec3(0.0), cone_meet(cell, direction));
#if LSF_EMITTERS
    vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, cell, 0).r);
    end.emission = voxel_emission_drawn(cell, cone_slice(cell, direction));
    end.rest = max(end.rest - end.emission, 0.0);
    if (end.emission != vec3(0.0)) {
        vec3 q = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
        float drawn = emitter_density_met(point, direction, cell, q, faceforward(n, direction, n),
                                          grid.unit.x * end.emission);
        end.emission *= emitter_share(density, emitters.y * drawn);
    }
#endif
    return end;
}

/* A ray's way: the light of surfaces that it passes, the share of light from behind them, and the voxel in which it
 * ends, if any. */
struct cone_way {
    vec3 radiance, left;
    bool met;
    ivec3 cell;
};

/* Follows a ray from a point of a surface with the unit `normal` [voxels]. */
cone_way cone_follow(vec3 point, vec3 normal, vec3 direction)
{
    cone_way way = cone_way(vec3(0.0), vec3(1.0), false, ivec3(0));
    voxel_ray ray;
    if (!voxel_ray_begin(voxel_start(point, normal, direction), direction, ray) || !voxel_leave_start(ray))
        return way;
#if LSF_VOXEL_PASSAGE
    voxel_passage passage = voxel_passage_begin();
    for (int i = 0; i < VOXEL_PASSAGE_MOST; i++) {
        way.met = voxel_ray_meet(ray, cone_march.z, true, way.cell);
        way.left = voxel_passed(passage);
        bool sheet;
        if (!way.met || !voxel_pass(passage, ray, way.cell, sheet))
            return way;
        if (!sheet)
            way.radiance += way.left * cone_meet(way.cell, direction);
    }
    return cone_way(way.radiance, vec3(0.0), false, way.cell);
#else
    way.met = voxel_ray_meet(ray, cone_march.z, true, way.cell);
    return way;
#endif
}

/* What the side of a voxel in which a ray ends reflects of lamps and of other light, where it is `spread` if all of it
 * is reflected as by a diffuse surface. `density`: of all rays that find this direction from the point [1/sr]. */
vec3 cone_reflected(vec3 spread, vec3 point, vec3 direction, ivec3 cell, float density)
{
#if LSF_VOXEL_LAMPS
    if (voxel_is_smooth_metal(texelFetch(voxel_specular_params, cell, 0).r)) {
        int side;
        surface s = voxel_surface_at(cell, direction, side);
        return voxel_reflects(spread, s, cell, side, point, direction, density);
    }
#endif
    return spread;
}

/* Traces a ray. The rays of a set that gathers a hemisphere are cosine-distributed over all rotations and
 * elevations, so that the mean is right; voxels beside a ray are hit by other rays and must not count twice. `chance`:
 * density of the set's directions there [1/sr]; light of voxels is weighted by it against draws (balance heuristic,
 * Veach and Guibas 1995) and points on emitters. `spread` is used by marching cones. */
cone_light cone_trace(vec3 point, vec3 normal, vec3 direction, float chance, float spread)
{
    cone_way way = cone_follow(point, normal, direction);
    if (!way.met)
        return cone_light(way.radiance, way.left);
    cone_end end = cone_end_at(point, direction, way.cell, chance / cone_gather.z);
    float density = chance;
#if LSF_VOXEL_DRAW
    density += float(cone_draws) *
               voxel_draw_density(point, direction, way.cell, voxel_draw_plane(way.cell), end.rest);
#endif
    end.rest = cone_reflected(end.rest, point, direction, way.cell, density) * (chance / max(density, 1e-20));
    return cone_light(way.radiance + way.left * (end.emission + end.rest), vec3(0.0));
}

#if LSF_VOXEL_DRAW
/* Light of a drawn side of a voxel over the density of its direction by draws and cones, in the grid's unit; 0 where
 * the ray meets something else. `cones`: number of cosine-distributed cones, `cosine`: to the shading normal. */
vec3 cone_draw(voxel_drawn drawn, vec3 point, vec3 normal, float cosine, float cones)
{
    cone_way way = cone_follow(point, normal, drawn.direction);
    if (!way.met || way.cell != drawn.cell || cone_slice(way.cell, drawn.direction) != drawn.slice)
        return vec3(0.0);
    float chance = cones * cosine / LSF_PI;
    vec3 rest = cone_end_at(point, drawn.direction, way.cell, cosine / LSF_PI).rest;
    float density = chance + float(cone_draws) * voxel_draw_density(point, drawn.direction, way.cell,
                                                                    voxel_draw_plane(way.cell), rest);
    return way.left * cone_reflected(rest, point, drawn.direction, way.cell, density) / density;
}
#endif

#if LSF_EMITTERS
/* Draws a point on an emitter for a point of a surface with these unit normals [voxels]. False: no light comes from
 * there. */
bool cone_emitter(vec2 number, vec3 point, vec3 normal, vec3 shading_normal, out emitter_view e)
{
    if (!emitter_view_from(point, normal, number, e) || dot(shading_normal, e.direction) <= 0.0)
        return false;
#if LSF_VOXEL_PASSAGE
    e.radiance *= voxel_seen(point, normal, e.position, e.normal);
    return e.radiance != vec3(0.0);
#else
    return voxel_sees(point, normal, e.position, e.normal);
#endif
}
#endif
#else
#if LSF_VOXEL_SIDES > 1
vec4 cone_texel(vec2 coordinates, float z, float slice, float level)
{
    return textureLod(radiance_texture, vec3(coordinates, (z + slice) * (1.0 / float(LSF_VOXEL_SIDES))), level);
}
#endif

/* Marches from a point of a surface with the unit `normal` [voxels]. `spread`: diameter per unit length; `chance` is
 * used by sealed cones. */
cone_light cone_trace(vec3 point, vec3 normal, vec3 direction, float chance, float spread)
{
    float offset = cone_march.y;
    vec3 start = point + offset * normal;
    vec3 size = grid.size.xyz;
    vec3 rate = abs(direction);
    /* Distance at which the cone leaves the grid. */
    vec3 wall = mix(vec3(0.0), size, greaterThan(direction, vec3(0.0)));
    vec3 leave = (wall - start) / mix(direction, vec3(1e-20), equal(direction, vec3(0.0)));
    float end = min(min(leave.x, min(leave.y, leave.z)), cone_march.z);
    /* The texels of a plane reach 1/2 |n|_1 above it, and interpolation 1 |n|_1 more. */
    vec3 tilt = abs(normal);
    float flatness = 1.0 / (1.5 * (tilt.x + tilt.y + tilt.z));
    float rise = dot(normal, direction);
#if LSF_VOXEL_SIDES > 1
    vec3 slice = vec3(0.0, 2.0, 4.0) + mix(vec3(0.0), vec3(1.0), lessThan(direction, vec3(0.0)));
#endif
    vec3 radiance = vec3(0.0);
    float transmittance = 1.0, t = 0.0;
    for (int i = 0; i < cone_steps; i++) {
        if (t >= end || transmittance < CONE_OPAQUE)
            break;
        float width = spread * (offset + t);
        float texel = max(min(width, (offset + rise * t) * flatness), 0.125 * width);
        float level = floor(log2(clamp(texel, 1.0, float(1 << (LSF_VOXEL_LEVELS - 1)))));
        texel = exp2(level);
        float dt = cone_march.x * texel;
        vec3 p = start + (t + 0.5 * dt) * direction;
#if LSF_VOXEL_SIDES == 1
        vec4 seen = textureLod(radiance_texture, p / size, level);
        float clear =
            exp2(cone_march.x * log2(max(1.0 - cone_march.w * seen.a, CONE_CLEAR_MIN)));
        vec3 color = seen.rgb / max(seen.a, 1e-6);
#else
        float z = clamp(p.z, 0.5 * texel, size.z - 0.5 * texel) / size.z;
        vec2 coordinates = p.xy / size.xy;
        vec4 x = cone_texel(coordinates, z, slice.x, level);
        vec4 y = cone_texel(coordinates, z, slice.y, level);
        vec4 w = cone_texel(coordinates, z, slice.z, level);
        vec3 opacity = vec3(x.a, y.a, w.a);
        vec3 clearness = max(1.0 - cone_march.w * opacity, vec3(CONE_CLEAR_MIN));
        float clear = exp2(cone_march.x * dot(rate, log2(clearness)));
        vec3 color = (rate.x * x.rgb + rate.y * y.rgb + rate.z * w.rgb) /
                     max(dot(rate, opacity), 1e-6);
#endif
        radiance += transmittance * (1.0 - clear) * color;
        transmittance *= clear;
        t += dt;
    }
    return cone_light(radiance, vec3(transmittance < CONE_OPAQUE ? 0.0 : transmittance));
}
#endif

#endif
