/* Triangle against voxels, exactly: they touch unless one of the axes of the box, of the triangle's
 * plane, or of their nine edge pairs separates them (Akenine-Moeller 2001; as edge functions in the
 * three projections: Schwarz and Seidel 2010, section 4). With LSF_VOXELIZE_FILL the winner of each
 * voxel writes its surface there, else each triangle bids for the voxels that it touches. */
#include "lib/triangle_fetch.glsl"
#include "lib/voxel.glsl"

layout(location = 0) uniform uint first_triangle; /* of the instance among all */

layout(binding = 0, r32ui) uniform uimage3D key_image;
#if LSF_VOXELIZE_FILL
layout(binding = 1, r32ui) writeonly uniform uimage3D albedo_image;
layout(binding = 2, r32ui) writeonly uniform uimage3D normal_image;
layout(binding = 3, r32ui) writeonly uniform uimage3D point_image;
#if LSF_EMISSION
layout(binding = 4, r32ui) writeonly uniform uimage3D emission_image;
#endif
#if LSF_GLOSS
layout(binding = 5, r32ui) writeonly uniform uimage3D gloss_image;
#endif
#else
layout(binding = 1, r32ui) uniform uimage3D occupancy_image[LSF_VOXEL_OCCUPANCY_LEVELS];
layout(std430, binding = LSF_BINDING_BRICKS) coherent buffer lsf_brick_block
{
    uint bricks[];
};
#endif

/* Rounding of positions in a grid of 512 voxels is 2^-15 of a voxel, that of distances to edges a few
 * times as much; what comes closer than this counts as touching. [voxels] */
const float slack = 1.0 / 4096.0;

const uint id_mask = (1u << LSF_VOXELIZE_ID_BITS) - 1u;

struct voxel_triangle {
    uint id;
    uvec3 corners;
    int axis;           /* that columns run along */
    vec3 a, b, c;       /* [voxels], turned so that this axis is z */
    vec3 ab, bc, ca;    /* b - a and so on, without the rounding of a and b */
    vec3 normal;        /* turned; its length is twice the area */
    vec2 plane_slope;   /* of z over x and y */
    ivec2 low, columns; /* that its bounds cover */
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

/* In double precision up to normal and edges: rounding would turn those of a sliver the more, the narrower
 * it is. `axis`: that columns run along, -1 for the normal's longest. False when it has no area. */
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

/* Whether the unit square at `low` reaches the inner side of the edge from p along e, where the
 * triangle turns to the left (1) or to the right (-1). */
bool edge_reaches(vec2 p, vec2 e, float left, vec2 low)
{
    vec2 inward = left * vec2(-e.y, e.x);
    vec2 nearest = low + vec2(greaterThan(inward, vec2(0.0)));
    return dot(inward, nearest - p) >= -slack * (abs(e.x) + abs(e.y));
}

bool edges_reach_xy(voxel_triangle t, vec2 low)
{
    float left = t.normal.z >= 0.0 ? 1.0 : -1.0;
    return edge_reaches(t.a.xy, t.ab.xy, left, low) && edge_reaches(t.b.xy, t.bc.xy, left, low) &&
           edge_reaches(t.c.xy, t.ca.xy, left, low);
}

bool edges_reach_yz(voxel_triangle t, vec2 low)
{
    float left = t.normal.x >= 0.0 ? 1.0 : -1.0;
    return edge_reaches(t.a.yz, t.ab.yz, left, low) && edge_reaches(t.b.yz, t.bc.yz, left, low) &&
           edge_reaches(t.c.yz, t.ca.yz, left, low);
}

bool edges_reach_zx(voxel_triangle t, vec2 low)
{
    float left = t.normal.y >= 0.0 ? 1.0 : -1.0;
    return edge_reaches(t.a.zx, t.ab.zx, left, low) && edge_reaches(t.b.zx, t.bc.zx, left, low) &&
           edge_reaches(t.c.zx, t.ca.zx, left, low);
}

/* Barycentric coordinates of the triangle's point that is closest to p's projection on it. */
vec3 closest_weights(voxel_triangle t, vec3 p)
{
    vec3 ac = -t.ca, ap = p - t.a;
    float scale = 1.0 / dot(t.normal, t.normal);
    float b = dot(cross(ap, ac), t.normal) * scale, c = dot(cross(t.ab, ap), t.normal) * scale;
    vec3 weights = max(vec3(1.0 - b - c, b, c), 0.0);
    return weights / (weights.x + weights.y + weights.z);
}

/* The surface about the voxel's centre; false where an alpha mask cuts it out. */
bool surface_in(voxel_triangle t, vec3 weights, out surface s, out vec3 emission)
{
    /* A voxel's face has the area 1, the triangle half of its normal's length. */
    material_point point = triangle_point(t.corners, weights, 2.0 / length(t.normal));
    return material_surface(triangle_material(), point, s, emission);
}

#if LSF_VOXELIZE_FILL
void write_surface(voxel_triangle t, ivec3 cell, vec3 low)
{
    vec3 weights = closest_weights(t, low + 0.5);
    surface s;
    vec3 emission;
    if (!surface_in(t, weights, s, emission))
        return;
    lsf_material_data material = triangle_material();
    vec3 face = t.axis == 0 ? t.normal.zxy : t.axis == 1 ? t.normal.yzx : t.normal;
    if (range.w != 0u)
        face = -face;
    vec3 n = dot(s.geometric_normal, face) > 0.0 ? s.geometric_normal : normalize(face);
    vec3 inside = t.a * weights.x + t.b * weights.y + t.c * weights.z - low;
    inside = t.axis == 0 ? inside.zxy : t.axis == 1 ? inside.yzx : inside;
    imageStore(albedo_image, cell,
               uvec4(voxel_albedo_pack(s.unlit ? vec3(0.0) : s.base_color)));
    float turn = 0.0;
#if LSF_ANISOTROPY
    vec3 basis_t, basis_b, along_t, along_b;
    orthonormal_basis(s.normal, basis_t, basis_b);
    float angle = 2.0 * LSF_PI * s.anisotropy_turn;
    vec3 along = cos(angle) * basis_t + sin(angle) * basis_b;
    orthonormal_basis(n, along_t, along_b);
    turn = fract(atan(dot(along, along_b), dot(along, along_t)) / (2.0 * LSF_PI));
#endif
    imageStore(normal_image, cell, uvec4(voxel_normal_pack(n, turn)));
    imageStore(point_image, cell,
               uvec4(voxel_point_pack(inside, material_emits(material, false))));
#if LSF_EMISSION
    imageStore(emission_image, cell, uvec4(voxel_emission_pack(emission * grid.unit.y)));
#endif
#if LSF_GLOSS
    float alpha = lsf_alpha_from_roughness(s.roughness);
    float root = sqrt(s.f0); /* f0 = ((n - 1) / (n + 1))^2 */
    imageStore(gloss_image, cell,
               uvec4(packUnorm4x8(vec4(sqrt(lsf_alpha_along_tangent(alpha, s.anisotropy)),
                                       s.roughness, root, s.metallic))));
#endif
}
#else
/* The bid: nearer to the voxel's centre wins, then the first triangle. The distance is that of the triangle,
 * not of its plane: of two in one plane each gets the voxels whose centres lie over it. */
void bid(voxel_triangle t, ivec3 cell, vec3 low)
{
#if LSF_MASK
    surface s;
    vec3 emission;
    if (!surface_in(t, closest_weights(t, low + 0.5), s, emission))
        return;
#endif
    vec3 weights = closest_weights(t, low + 0.5);
    vec3 nearest_point = t.a * weights.x + t.b * weights.y + t.c * weights.z;
    float distance = length(nearest_point - (low + 0.5));
    const uint nearest = 0xffffffffu >> LSF_VOXELIZE_ID_BITS;
    /* What meets a voxel is at most half its diagonal away, sqrt(3) / 2. */
    uint near = uint((1.0 - min(distance / 0.8661, 1.0)) * float(nearest));
    uint key = (near << LSF_VOXELIZE_ID_BITS) | (id_mask - t.id);
    if (imageAtomicMax(key_image, cell, key) != 0u)
        return;
    imageAtomicOr(occupancy_image[0], occupancy_texel(cell), occupancy_bit(cell));
    ivec3 brick = cell >> 2;
    uint bit = occupancy_bit(brick);
    if ((imageAtomicOr(occupancy_image[1], occupancy_texel(brick), bit) & bit) != 0u)
        return;
    imageAtomicOr(occupancy_image[2], occupancy_texel(brick >> 2), occupancy_bit(brick >> 2));
    uint at = atomicAdd(bricks[3], 1u);
    bricks[LSF_VOXEL_LIST_HEADER + at] = voxel_brick_pack(brick);
    atomicMax(bricks[1], at / LSF_VOXEL_LIST_ROW + 1u);
}
#endif

void visit(voxel_triangle t, vec3 low)
{
    ivec3 cell = turned_back(ivec3(low), t.axis);
    if (!voxel_inside(cell))
        return;
#if LSF_VOXELIZE_FILL
    if ((imageLoad(key_image, cell).r & id_mask) == id_mask - t.id)
        write_surface(t, cell, low);
#else
    if (edges_reach_yz(t, low.yz) && edges_reach_zx(t, low.zx))
        bid(t, cell, low);
#endif
}

/* The voxels along z that the plane passes through over a unit square. */
void visit_column(voxel_triangle t, ivec2 column)
{
    vec2 low = vec2(column);
    if (!edges_reach_xy(t, low))
        return;
    float middle = t.a.z + dot(t.plane_slope, low + 0.5 - t.a.xy);
    float half_range = 0.5 * (abs(t.plane_slope.x) + abs(t.plane_slope.y)) + slack;
    int first = max(int(floor(middle - half_range)), t.depth.x);
    int last = min(int(floor(middle + half_range)), t.depth.y);
    for (int z = first; z <= last; z++)
        visit(t, vec3(low, float(z)));
}
