/* A triangle of the current instance in the grid. The lowest grid.id_bits of a bid are the triangle's number. Switch
 * LSF_VOXEL_CHANCE: transmitting surfaces are present with some probability, because marching cones cannot continue
 * behind them. */
#ifndef LSF_PASSES_VOXELIZE
#define LSF_PASSES_VOXELIZE

#include "lib/triangle_fetch.glsl"
#include "lib/voxel.glsl"

#ifndef LSF_VOXEL_CHANCE
#define LSF_VOXEL_CHANCE 0
#endif

layout(location = 0) uniform uint first_triangle; /* of the instance, in the numbering of all triangles */

/* Positions in a grid of 512 voxels are rounded to 2^-15 of a voxel, and distances to edges to a few times as
 * much; triangles that come closer than this touch. [voxels] */
const float slack = 1.0 / 4096.0;

struct voxel_triangle {
    uint id;
    uvec3 corners;
    int axis;           /* axis of the columns */
    vec3 a, b, c;       /* [voxels], permuted so that this axis is z */
    vec3 ab, bc, ca;    /* b - a and so on, without the rounding of a and b */
    vec3 normal;        /* permuted; its length is twice the area */
    vec2 plane_slope;   /* of z over x and y */
    ivec2 low, columns; /* covered by its bounds */
    ivec2 depth;        /* first and last voxel along z */
};

vec3 turned(vec3 v, int axis)
{
    return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v;
}

ivec3 turned_back(ivec3 v, int axis)
{
    return axis == 0 ? v.zxy : axis == 1 ? v.yzx : v;
}

/* [voxels] */
dvec3 corner_in_grid(uint vertex)
{
    dvec4 p = dvec4(texelFetch(position_fetch, int(vertex)).xyz, 1.0);
    dvec3 position = dvec3(dot(dvec4(transform[0]), p), dot(dvec4(transform[1]), p),
                           dot(dvec4(transform[2]), p));
    return (position - dvec3(grid.origin.xyz)) * double(grid.size.w);
}

int longest_axis(vec3 v)
{
    vec3 m = abs(v);
    return m.x >= m.y && m.x >= m.z ? 0 : m.y >= m.z ? 1 : 2;
}

/* Normal and edges are computed in double precision, because rounding rotates those of a sliver the more, the
 * narrower it is. `axis`: that of the columns, -1 for the normal's longest. False when the triangle has no area. */
bool triangle_load(uint triangle, int axis, out voxel_triangle t)
{
    t.id = first_triangle + triangle;
    t.corners = triangle_corners(triangle);
    dvec3 a = corner_in_grid(t.corners.x), b = corner_in_grid(t.corners.y),
          c = corner_in_grid(t.corners.z);
    vec3 n = vec3(cross(b - a, c - a));
    t.axis = axis >= 0 ? axis : longest_axis(n);
    if (n[t.axis] == 0.0)
        return false;
    t.a = turned(vec3(a), t.axis);
    t.b = turned(vec3(b), t.axis);
    t.c = turned(vec3(c), t.axis);
    t.ab = turned(vec3(b - a), t.axis);
    t.bc = turned(vec3(c - b), t.axis);
    t.ca = turned(vec3(a - c), t.axis);
    t.normal = turned(n, t.axis);
    t.plane_slope = -t.normal.xy / t.normal.z;
    vec3 low = floor(min(t.a, min(t.b, t.c)) - slack);
    vec3 high = floor(max(t.a, max(t.b, t.c)) + slack);
    t.low = ivec2(low.xy);
    t.columns = ivec2(high.xy - low.xy) + 1;
    t.depth = ivec2(low.z, high.z);
    return true;
}

/* The point of an edge, from `corner` along e, that is closest to p: its position along the edge, 0..1, and its
 * squared distance. */
vec2 closest_on_edge(vec3 p, vec3 corner, vec3 e)
{
    vec3 offset = p - corner;
    float at = clamp(dot(offset, e) / max(dot(e, e), 1e-30), 0.0, 1.0);
    offset -= at * e;
    return vec2(at, dot(offset, offset));
}

/* Barycentric coordinates of the point of the triangle that is closest to p: p's projection where that lies
 * inside, else the closest point of the nearest edge. */
vec3 closest_weights(voxel_triangle t, vec3 p)
{
    vec3 ac = -t.ca, ap = p - t.a;
    float scale = 1.0 / dot(t.normal, t.normal);
    float b = dot(cross(ap, ac), t.normal) * scale, c = dot(cross(t.ab, ap), t.normal) * scale;
    vec3 weights = vec3(1.0 - b - c, b, c);
    if (all(greaterThanEqual(weights, vec3(0.0))))
        return weights;
    vec2 on_ab = closest_on_edge(p, t.a, t.ab), on_bc = closest_on_edge(p, t.b, t.bc),
         on_ca = closest_on_edge(p, t.c, t.ca);
    if (on_ab.y <= min(on_bc.y, on_ca.y))
        return vec3(1.0 - on_ab.x, on_ab.x, 0.0);
    return on_bc.y <= on_ca.y ? vec3(0.0, 1.0 - on_bc.x, on_bc.x)
                              : vec3(on_ca.x, 0.0, 1.0 - on_ca.x);
}

/* Side [voxels] of the cubes for each of which a layer draws once whether it is present. Larger cubes make fewer
 * rays meet two of them while they cross one sheet of voxels. */
#define BLEND_CUBE 32u

/* The parts of an instance that face to either side of a plane are two layers, such as its front and its back.
 * Plane and cubes move with each iteration. */
uvec3 voxel_layer_key(voxel_triangle t, ivec3 cell)
{
#if LSF_BLEND || LSF_VOXEL_CHANCE
    uvec3 bits = hash(uvec3(chance, 0u));
    uvec3 cube = (uvec3(cell) + bits % BLEND_CUBE) / BLEND_CUBE;
    vec3 n = t.axis == 0 ? t.normal.zxy : t.axis == 1 ? t.normal.yzx : t.normal;
    bool front = dot(n, hash_unit(bits) - 0.5) > 0.0;
    return uvec3(layer_key(range.z, 0u, front), cube.x | cube.y << 16, cube.z);
#else
    return uvec3(0u);
#endif
}

#if LSF_VOXEL_CHANCE
/* Probability that a transmitting surface is absent: its transmittance for diffuse light without its colour, with
 * the mean of Schlick's term, f0 + (f90 - f0) / 21. */
float voxel_passes(surface s)
{
    float f0 = largest(surface_f0(s));
    float passes = s.unlit ? 0.0 : s.transmission * (1.0 - s.metallic);
    passes *= 1.0 - f0 - (surface_f90(s) - f0) / 21.0;
    return passes * dot(s.base_color, vec3(0.2126, 0.7152, 0.0722));
}
#endif

/* The surface closest to the voxel's centre; false where an alpha mask, or the draw for a blended surface, removes
 * it. */
bool surface_in(voxel_triangle t, ivec3 cell, vec3 weights, out surface s, out vec3 emission)
{
    /* The face of a voxel has the area 1, and the triangle half the length of its normal. */
    material_point point = triangle_point(t.corners, weights, 2.0 / length(t.normal));
    point.key = voxel_layer_key(t, cell);
    if (!material_surface(triangle_material(), point, s, emission))
        return false;
#if LSF_VOXEL_CHANCE && !defined(VOXEL_WON)
    return chance_number(point.key) >= voxel_passes(s);
#else
    return true;
#endif
}

#endif
