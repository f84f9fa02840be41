/* Counts the VPLs that emit light, and bounds their positions. Minima, maxima and sums of integers do not depend
 * on the order. */
#include "passes/light_tree_codes.glsl"

layout(local_size_x = LSF_LIGHT_TREE_GROUP) in;

shared uint group_live;
shared uint group_low[3], group_high[3];

/* Integers in the order of the floats. */
uvec3 ordered(vec3 v)
{
    uvec3 bits = floatBitsToUint(v);
    return bits ^ mix(uvec3(0x80000000u), uvec3(0xffffffffu), greaterThanEqual(bits, uvec3(0x80000000u)));
}

void main()
{
    uint lane = gl_LocalInvocationID.x;
    if (lane < 3u) {
        group_low[lane] = 0xffffffffu;
        group_high[lane] = 0u;
    }
    if (lane == 0u)
        group_live = 0u;
    barrier();
    uint live = 0u;
    uvec3 low = uvec3(0xffffffffu), high = uvec3(0u);
    for (uint row = 0u; row < LSF_LIGHT_TREE_ROWS; row++) {
        uint i = gl_WorkGroupID.x * LSF_LIGHT_TREE_TILE + row * LSF_LIGHT_TREE_GROUP + lane;
        if (i >= record_count || light_is_dead(cloud[i]))
            continue;
        uvec3 position = ordered(cloud[i].position);
        low = min(low, position);
        high = max(high, position);
        live++;
    }
    if (live > 0u) {
        atomicAdd(group_live, live);
        for (int axis = 0; axis < 3; axis++) {
            atomicMin(group_low[axis], low[axis]);
            atomicMax(group_high[axis], high[axis]);
        }
    }
    barrier();
    if (lane > 0u || group_live == 0u)
        return;
    atomicAdd(tree.live, group_live);
    atomicMin(tree.low_x, group_low[0]);
    atomicMin(tree.low_y, group_low[1]);
    atomicMin(tree.low_z, group_low[2]);
    atomicMax(tree.high_x, group_high[0]);
    atomicMax(tree.high_y, group_high[1]);
    atomicMax(tree.high_z, group_high[2]);
}
