/* The start of each instance's voxels in the list. */
#define VOXELIZE_LIST_ACCESS coherent
#include "passes/voxelize_list.glsl"

layout(local_size_x = 1) in;

void main()
{
    uint first = 0u, capacity = list_sizes.y;
    for (uint i = 0u; i < list_sizes.x; i++) {
        uint count = min(draws[i].count, capacity - first);
        uint groups = (count + LSF_VOXELIZE_GROUP - 1u) / LSF_VOXELIZE_GROUP;
        draws[i].groups_x = LSF_VOXEL_LIST_ROW;
        draws[i].groups_y = (groups + LSF_VOXEL_LIST_ROW - 1u) / LSF_VOXEL_LIST_ROW;
        draws[i].groups_z = 1u;
        draws[i].first = first;
        draws[i].count = count;
        first += count;
    }
}
