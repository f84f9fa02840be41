/* The voxels that a triangle touches, exactly: all except those that the axes of the box, of the triangle's plane,
 * or of their nine edge pairs separate from it (Akenine-Moeller 2001; as edge functions in the three projections:
 * Schwarz and Seidel 2010, section 4). The triangle bids for each of them. */
#include "passes/voxelize.glsl"

layout(binding = 0, r32ui) coherent uniform uimage3D key_image;
layout(binding = 1, r32ui) coherent uniform uimage3D occupancy_image[LSF_VOXEL_OCCUPANCY_LEVELS];
layout(std430, binding = LSF_BINDING_BRICKS) coherent buffer lsf_brick_block
{
    uint brick_groups_x, brick_groups_y, brick_groups_z, brick_count;
    lsf_voxel_brick_data bricks[];
};

/* Whether the unit square at `low` reaches the inner side of the edge from p along e; `left`: 1 where the triangle
 * is counter-clockwise, -1 where it is clockwise. */
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

/* The bid: the triangle nearer to the voxel's centre wins, then the one with the lower number. The distance is
 * that of the triangle, not of its plane: of two triangles in one plane, each gets the voxels whose centres lie
 * over it. */
void bid(voxel_triangle t, ivec3 cell, vec3 low)
{
    vec3 weights = closest_weights(t, low + 0.5);
#if LSF_MASK || LSF_VOXEL_CHANCE
    surface s;
    vec3 emission;
    if (!surface_in(t, cell, weights, s, emission))
        return;
#endif
    vec3 nearest_point = t.a * weights.x + t.b * weights.y + t.c * weights.z;
    float distance = length(nearest_point - (low + 0.5));
    uint nearest = 0xffffffffu >> grid.id_bits, id_mask = (1u << grid.id_bits) - 1u;
    /* A triangle that touches a voxel is at most half the voxel's diagonal away, sqrt(3) / 2. */
    uint near = uint((1.0 - min(distance / 0.8661, 1.0)) * float(nearest));
    uint key = (near << grid.id_bits) | (id_mask - t.id);
    /* Keys only grow: a bid that is beaten now stays beaten and needs no atomic operation. */
    if (imageLoad(key_image, cell).r >= key || imageAtomicMax(key_image, cell, key) != 0u)
        return;
    imageAtomicOr(occupancy_image[0], occupancy_texel(cell), occupancy_bit(cell));
    ivec3 brick = cell >> 2;
    uint bit = occupancy_bit(brick);
    if ((imageAtomicOr(occupancy_image[1], occupancy_texel(brick), bit) & bit) != 0u)
        return;
    uint at = atomicAdd(brick_count, 1u);
    bricks[at].cell = voxel_brick_pack(brick);
    bricks[at].sides = 0u;
    atomicMax(brick_groups_y, at / LSF_VOXEL_LIST_ROW + 1u);
}

/* A walk over the voxels that a triangle touches, column by column. */
struct voxel_walk {
    int column, z, last;
    vec2 low; /* of the column */
};

voxel_walk walk_begin()
{
    voxel_walk w;
    w.column = -1;
    w.z = 0;
    w.last = -1;
    w.low = vec2(0.0);
    return w;
}

/* The voxels along z that the plane passes through over the column's square; none where the triangle does not
 * reach the column. */
void walk_column(voxel_triangle t, vec2 low, inout voxel_walk w)
{
    float middle = t.a.z + dot(t.plane_slope, low + 0.5 - t.a.xy);
    float half_range = 0.5 * (abs(t.plane_slope.x) + abs(t.plane_slope.y)) + slack;
    bool reached = edges_reach_xy(t, low);
    w.low = low;
    w.z = max(int(floor(middle - half_range)), t.depth.x);
    w.last = reached ? min(int(floor(middle + half_range)), t.depth.y) : w.z - 1;
}

bool touches(voxel_triangle t, vec3 low)
{
    return edges_reach_yz(t, low.yz) && edges_reach_zx(t, low.zx);
}

void bid_inside(voxel_triangle t, vec3 low)
{
    ivec3 cell = turned_back(ivec3(low), t.axis);
    if (voxel_inside(cell))
        bid(t, cell, low);
}

void visit_column(voxel_triangle t, ivec2 column)
{
    voxel_walk w;
    walk_column(t, vec2(column), w);
    for (int z = w.z; z <= w.last; z++)
        if (touches(t, vec3(w.low, float(z))))
            bid_inside(t, vec3(w.low, float(z)));
}

/* Visits all columns. The expensive part runs in lanes that have each found a voxel in their own column. */
void visit_all(voxel_triangle t)
{
    int columns = t.columns.x * t.columns.y;
    int steps = columns * (t.depth.y - t.depth.x + 2);
    voxel_walk w = walk_begin();
    for (int visited = 0; visited < steps; visited++) {
        bool found = false;
        vec3 low = vec3(0.0);
        for (int i = 0; i < steps && !found; i++) {
            if (w.z > w.last) {
                w.column++;
                if (w.column >= columns)
                    break;
                walk_column(t, vec2(t.low + ivec2(w.column % t.columns.x, w.column / t.columns.x)),
                            w);
            } else {
                low = vec3(w.low, float(w.z));
                found = touches(t, low);
                w.z++;
            }
        }
        if (!found)
            break;
        bid_inside(t, low);
    }
}
