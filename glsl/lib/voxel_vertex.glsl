/* Vertices of paths through voxels: the rays that leave them, the surfaces that these meet, and what media absorb on
 * the way. Switches LSF_TRANSMISSION, LSF_ABSORPTION (there are media) and those of lib/voxel_surface.glsl. */
#ifndef LSF_LIB_VOXEL_VERTEX
#define LSF_LIB_VOXEL_VERTEX

#include "lib/view.glsl"
#include "lib/voxel_surface.glsl"
#if LSF_ABSORPTION
#include "lib/scene.glsl"
#endif

struct path_vertex {
    vec3 position, view; /* [voxels]; unit, towards the previous vertex */
    surface s;
};

/* Begins a ray from v. `inside`: it runs through the medium whose surface v is on. False: it leaves the grid at
 * once. */
bool path_ray_begin(path_vertex v, vec3 direction, out voxel_ray ray, out bool inside)
{
    inside = false;
#if LSF_TRANSMISSION
    /* A ray through the surface starts where it leaves the voxels of the plane. */
    vec3 n = v.s.geometric_normal;
    bool sinks = dot(n, direction) < 0.0;
    inside = v.s.volume && v.s.front == sinks;
    vec3 start = inside  ? v.position
                 : sinks ? voxel_start_along(v.position, -n, direction)
                         : voxel_start(v.position, n, direction);
#else
    vec3 start = voxel_start(v.position, v.s.geometric_normal, direction);
#endif
    return voxel_ray_begin(start, direction, ray);
}

/* The voxel that the ray meets. */
bool path_ray_meet(inout voxel_ray ray, bool inside, out ivec3 cell)
{
    bool left = inside ? voxel_leave_inside(ray) : voxel_leave_start(ray);
    return left && voxel_ray_meet(ray, VOXEL_FAR, true, cell);
}

#if LSF_ABSORPTION
/* Reach of the neighbours that a normal is interpolated between [voxels], and the least cosine between their normals,
 * beyond which an edge is between them. */
#define SMOOTH_REACH 1.6
#define SMOOTH_LEAST 0.9

/* The shading normal at a point of a voxel's surface, between those of its neighbours: constant normals would split
 * what is seen through a medium into facets. */
vec3 interpolated_normal(vec3 normal, ivec3 cell, vec3 at, int side)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 27; i++) {
        ivec3 there = cell + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
        if (!voxel_inside(there) || !voxel_occupied(there))
            continue;
        vec3 away = vec3(there) + voxel_point_unpack(texelFetch(voxel_point, there, 0).r) - at;
        vec3 n = voxel_normal_unpack(voxel_shading_bits(there, texelFetch(voxel_normal, there, 0).r));
        n = side == 0 ? n : -n;
        float near = max(1.0 - dot(away, away) / (SMOOTH_REACH * SMOOTH_REACH), 0.0);
        sum += dot(n, normal) > SMOOTH_LEAST ? near * near * n : vec3(0.0);
    }
    return sum == vec3(0.0) ? normal : normalize(sum);
}
#endif

/* The surface of a voxel, seen from `origin` along `direction`; `side`: 0 from the side of its normal, else 1. */
path_vertex vertex_at(ivec3 cell, vec3 origin, vec3 direction, out int side)
{
    path_vertex v;
    v.s = voxel_surface_at(cell, direction, side);
    v.position = vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
    v.view = -direction;
#if LSF_TRANSMISSION
    /* The path continues from its hit with the plane, not from the voxel's stored point. */
    float meets = dot(v.s.geometric_normal, direction);
    if (v.s.transmission > 0.0 && meets != 0.0) {
        vec3 there = origin + direction * (dot(v.s.geometric_normal, v.position - origin) / meets);
        v.position = clamp(there, vec3(cell), vec3(cell + 1));
#if LSF_ABSORPTION
        if (v.s.volume)
            v.s.normal = interpolated_normal(v.s.normal, cell, v.position, side);
#endif
    }
#endif
    return v;
}

/* The body whose surface is visible in a pixel: its thickness across that surface [voxels], and what its far side has
 * there: base colour, and transmission in alpha. */
struct seen_body {
    float thickness;
    vec4 far_color;
};

seen_body seen_body_none()
{
    return seen_body(VOXEL_FAR, vec4(0.0));
}

#if LSF_ABSORPTION
/* Reach within which the neighbours of a voxel may store the far side of a medium [voxels]. */
#define THIN_REACH 1.8

/* The nearest back of a medium behind each pixel's surface: a depth like that of the G-buffer; base colour, and
 * transmission in alpha. */
layout(binding = LSF_UNIT_FAR_SIDE) uniform sampler2D far_side_texture;
layout(binding = LSF_UNIT_FAR_COLOR) uniform sampler2D far_color_texture;

seen_body seen_body_of(path_vertex v, ivec2 pixel, vec2 ndc)
{
    float depth = texelFetch(far_side_texture, pixel, 0).r;
    if (depth == 0.0)
        return seen_body_none();
    vec3 across = voxel_from_position(position_from_depth(ndc, depth)) - v.position;
    return seen_body(abs(dot(v.s.geometric_normal, across)), texelFetch(far_color_texture, pixel, 0));
}

/* Takes a ray from a visible point into a body through it, if that is thinner than a voxel, whose sides are parallel
 * then. False: it is thicker, or the ray does not enter it. */
bool path_through_wall(path_vertex v, vec3 direction, seen_body body, out path_vertex far_side)
{
    float sinks = -dot(v.s.geometric_normal, direction);
    far_side = v;
    if (!v.s.volume || !v.s.front || sinks <= 0.0 || body.thickness >= 1.0)
        return false;
    far_side.position += body.thickness / max(sinks, LSF_COSINE_MIN) * direction;
    far_side.view = -direction;
    far_side.s.base_color = body.far_color.rgb;
    far_side.s.transmission = body.far_color.a;
    transmission_set_side(far_side.s, false);
    return true;
}

/* Whether a surface belongs to the medium whose surface v is on, and is seen from its front or from its back. */
bool is_side_of(path_vertex v, surface s, bool front)
{
    return s.volume && s.material == v.s.material && s.front == front;
}

/* Where a body is thinner than a voxel, the voxel in which a ray leaves it may store its near side alone. If a ray from v
 * into a body has not met the far side nearby, this replaces what it has met, if anything (`meets`), by the nearest far
 * side in the voxels beside v. Where the ray has met another far side, this must be parallel to v's side, as that of a
 * hollow body's wall. Failing that, where the ray has left a closed body or met its front, the body is a slab without
 * thickness; other surfaces lie within the medium. */
void path_find_exit(path_vertex v, vec3 direction, inout bool meets, inout ivec3 cell, inout int side, inout path_vertex met)
{
    bool enters = v.s.volume && v.s.front && dot(v.s.geometric_normal, direction) < 0.0;
    bool leaves = meets && is_side_of(v, met.s, false);
    if (!enters || (leaves && distance(met.position, v.position) < THIN_REACH))
        return;
    ivec3 own = ivec3(floor(v.position));
    float nearest = THIN_REACH, least = leaves ? SMOOTH_LEAST : 0.0; /* least: cosine between both sides */
    for (int i = 0; i < 27; i++) {
        ivec3 at = own + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
        if (!voxel_inside(at) || !voxel_occupied(at))
            continue;
        surface s = v.s;
        transmission_unpack(texelFetch(voxel_transmission_bits, at, 0).r, s);
        vec3 n = voxel_normal_unpack(texelFetch(voxel_normal, at, 0).r);
        float along = dot(n, direction);
        if (!s.volume || s.material != v.s.material || along <= 0.0 || dot(n, -v.s.geometric_normal) < least)
            continue;
        vec3 point = vec3(at) + voxel_point_unpack(texelFetch(voxel_point, at, 0).r);
        float way = max(dot(n, point - v.position) / along, 0.0);
        if (way < nearest) {
            nearest = way;
            cell = at;
        }
    }
    if (nearest < THIN_REACH) {
        met.s = voxel_surface_at(cell, direction, side);
        /* The wall turns from voxel to voxel, not between its sides. */
        if (dot(met.s.geometric_normal, v.s.geometric_normal) > SMOOTH_LEAST) {
            met.s.geometric_normal = v.s.geometric_normal;
            met.s.normal = v.s.normal;
        }
        met.position = v.position + nearest * direction;
        met.view = -direction;
        meets = true;
        return;
    }
    bool slab = meets ? is_side_of(v, met.s, true) : materials[v.s.material].absorption.w == 0.0;
    if (!slab || !voxel_inside(own) || !voxel_occupied(own))
        return;
    cell = own;
    voxel_surface_at(cell, direction, side);
    met = v;
    transmission_set_side(met.s, false);
    met.view = -direction;
    meets = true;
}
#endif

/* Absorption of the medium around a ray that leaves v; `before`: that around the previous segment; 0: air. Media
 * do not nest. */
vec3 absorption_along(path_vertex v, vec3 direction, vec3 before)
{
#if LSF_ABSORPTION
    if (v.s.volume) {
        bool outwards = (dot(v.s.geometric_normal, direction) > 0.0) == v.s.front;
        return outwards ? vec3(0.0) : materials[v.s.material].absorption.rgb;
    }
#endif
    return before;
}

/* Beer-Lambert law: transmittance over a vector in the grid. */
vec3 left_after(vec3 absorption, vec3 span)
{
    return exp(-absorption * (length(span) * grid.origin.w));
}

#endif
