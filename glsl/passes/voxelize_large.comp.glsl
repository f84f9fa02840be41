/* Tiles of large triangles. Each invocation takes a row of a tile's columns, so that the cost of loading the
 * triangle is shared. */
#include "passes/voxelize_mark.glsl"

layout(local_size_x = LSF_VOXELIZE_TILE * LSF_VOXELIZE_GROUP_TILES) in;

layout(std430, binding = LSF_BINDING_TILES) readonly buffer lsf_tile_block
{
    uint tiles[];
};

void main()
{
    uint group = gl_WorkGroupID.x +
                 gl_WorkGroupID.y * uint(LSF_VOXEL_LIST_ROW / LSF_VOXELIZE_GROUP_TILES);
    uint at = group * LSF_VOXELIZE_GROUP_TILES + gl_LocalInvocationID.x / LSF_VOXELIZE_TILE;
    if (at >= min(tiles[3], LSF_VOXELIZE_TILES))
        return;
    uint triangle = tiles[LSF_VOXEL_LIST_HEADER + 2u * at];
    int tile = int(tiles[LSF_VOXEL_LIST_HEADER + 2u * at + 1u]);
    voxel_triangle t;
    if (triangle == LSF_NO_NODE || !triangle_load(triangle, -1, t))
        return;
    int across = (t.columns.x + LSF_VOXELIZE_TILE - 1) / LSF_VOXELIZE_TILE;
    ivec2 first = ivec2(tile % across, tile / across) * LSF_VOXELIZE_TILE;
    first.y += int(gl_LocalInvocationID.x % uint(LSF_VOXELIZE_TILE));
    int end = first.y < t.columns.y ? min(first.x + LSF_VOXELIZE_TILE, t.columns.x) : first.x;
    for (int x = first.x; x < end; x++)
        visit_column(t, t.low + ivec2(x, first.y));
}
