/* A work group a tile of a large triangle, an invocation a column of voxels. */
#include "passes/voxelize_mark.glsl"

layout(local_size_x = LSF_VOXELIZE_TILE, local_size_y = LSF_VOXELIZE_TILE) in;

layout(std430, binding = LSF_BINDING_TILES) readonly buffer lsf_tile_block
{
    uint tiles[];
};

void main()
{
    uint at = gl_WorkGroupID.x + gl_WorkGroupID.y * LSF_VOXEL_LIST_ROW;
    if (at >= min(tiles[3], LSF_VOXELIZE_TILES))
        return;
    uint triangle = tiles[LSF_VOXEL_LIST_HEADER + 2u * at];
    int tile = int(tiles[LSF_VOXEL_LIST_HEADER + 2u * at + 1u]);
    voxel_triangle t;
    if (triangle == LSF_NO_NODE || !triangle_load(triangle, -1, t))
        return;
    int across = (t.columns.x + LSF_VOXELIZE_TILE - 1) / LSF_VOXELIZE_TILE;
    ivec2 column = ivec2(tile % across, tile / across) * LSF_VOXELIZE_TILE +
                   ivec2(gl_LocalInvocationID.xy);
    if (all(lessThan(column, t.columns)))
        visit_column(t, t.low + column);
}
