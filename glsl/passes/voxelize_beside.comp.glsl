/* Precomputed bits that save rays work: those of each voxel about its neighbours, VOXEL_BESIDE and VOXEL_EDGE in
 * lib/voxel.glsl, those of bricks that hold emitting voxels, and VOXEL_EMISSION_BORDER. Switch LSF_EMISSION. */
#include "lib/voxel_brick.glsl"
#include "lib/voxel_trace.glsl"

layout(binding = 0, r32ui) uniform uimage3D normal_image;
layout(binding = LSF_UNIT_VOXEL_POINT) uniform usampler3D voxel_point;
#if LSF_EMISSION
layout(binding = 1, r32ui) uniform uimage3D shining_image;
layout(binding = 2, r32ui) uniform uimage3D emission_image;
#endif

/* Voxels of one plane have equal normals, and points rounded to 2^-11 along each axis. */
#define SAME_PLANE (1.0 / 512.0)

vec3 point_in(ivec3 cell)
{
    return vec3(cell) + voxel_point_unpack(texelFetch(voxel_point, cell, 0).r);
}

/* VOXEL_EDGE_.. of the surface at the point q: `edges`, neighbours that form an edge with it, `same`, those that
 * continue its plane. */
uint edge_of(ivec3 cell, vec3 q, uint edges, uint same)
{
    uint edge = VOXEL_EDGE_NONE;
    for (; edges != 0u; edges &= edges - 1u) {
        ivec3 beside = voxel_beside(cell, findLSB(edges));
        vec3 beside_n = voxel_normal_unpack(imageLoad(normal_image, beside).r), beside_q = point_in(beside);
        float low = dot(beside_n, q - beside_q), high = low;
        for (uint left = same; left != 0u; left &= left - 1u) {
            float there = dot(beside_n, point_in(voxel_beside(cell, findLSB(left))) - beside_q);
            low = min(low, there);
            high = max(high, there);
        }
        bool front = high > 2.0 * VOXEL_PLANE, back = low < -2.0 * VOXEL_PLANE;
        uint lies = front == back ? VOXEL_EDGE_BOTH : front ? VOXEL_EDGE_FRONT : VOXEL_EDGE_BACK;
        edge = edge == VOXEL_EDGE_NONE || edge == lies ? lies : VOXEL_EDGE_BOTH;
    }
    return edge;
}

/* The bits above the normal. */
uint look_beside(ivec3 cell, uint normal)
{
    vec3 n = voxel_normal_unpack(normal), q = point_in(cell);
    uint seen = 0u, same = 0u, edges = 0u;
    for (int side = 0; side < 6; side++) {
        ivec3 beside = voxel_beside(cell, side);
        if (!voxel_inside(beside) || !voxel_occupied(beside))
            continue;
        uint other = imageLoad(normal_image, beside).r;
        vec3 beside_n = voxel_normal_unpack(other), beside_q = point_in(beside);
        if (((normal ^ other) & VOXEL_NORMAL_BITS) == 0u && abs(dot(n, beside_q - q)) < SAME_PLANE) {
            same |= 1u << side;
            continue;
        }
        /* Whether the neighbour's plane passes through the cell, so that a ray may cross it there. */
        float reach = 0.5 * (abs(beside_n.x) + abs(beside_n.y) + abs(beside_n.z)) + 2.0 * VOXEL_PLANE;
        if (abs(dot(beside_n, vec3(cell) + 0.5 - beside_q)) >= reach)
            continue;
        seen |= 1u << side;
        if (abs(dot(n, beside_n)) < VOXEL_EDGE)
            edges |= 1u << side;
    }
    return seen << VOXEL_BESIDE_SHIFT | edge_of(cell, q, edges, same) << VOXEL_EDGE_SHIFT;
}

#if LSF_EMISSION
/* Emitting voxels among the 27 around one within an emitting surface, at least: a plane along two axes has nine, and six
 * at a straight border. */
#define EMITTING_WITHIN 8

bool emits(ivec3 cell)
{
    return voxel_emission_unpack(imageLoad(emission_image, cell).r) != vec3(0.0);
}

/* Sets the bit of an emitting voxel. Other invocations read the word meanwhile, but only the bits of the emission. */
void mark_border(ivec3 cell)
{
    int count = 0;
    for (int i = 0; i < 27; i++) {
        ivec3 there = cell + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
        count += voxel_inside(there) && voxel_occupied(there) && emits(there) ? 1 : 0;
    }
    uint bits = imageLoad(emission_image, cell).r & ~VOXEL_EMISSION_BORDER;
    imageStore(emission_image, cell, uvec4(count < EMITTING_WITHIN ? bits | VOXEL_EMISSION_BORDER : bits));
}
#endif

void main()
{
    uint at;
    if (!voxel_brick_listed(at))
        return;
    lsf_voxel_brick_data brick = bricks[at];
    int voxels = voxel_brick_voxels(brick);
    bool shines = false;
    for (int n = voxel_brick_lane(); n < voxels; n += VOXEL_BRICK_LANES) {
        ivec3 cell = voxel_brick_cell(brick, n);
        /* Other invocations may read the word meanwhile, but only the bits of the normal, which do not change. */
        uint normal = imageLoad(normal_image, cell).r & VOXEL_NORMAL_BITS;
        imageStore(normal_image, cell, uvec4(normal | look_beside(cell, normal)));
#if LSF_EMISSION
        if (emits(cell)) {
            shines = true;
            mark_border(cell);
        }
#endif
    }
#if LSF_EMISSION
    ivec3 position = voxel_brick_unpack(brick.cell);
    if (shines)
        imageAtomicOr(shining_image, occupancy_texel(position), occupancy_bit(position));
#endif
}
