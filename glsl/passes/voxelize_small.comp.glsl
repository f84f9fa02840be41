/* One triangle per invocation: small ones are voxelized here, large ones are listed as tiles for work groups to
 * share. */
#include "passes/voxelize_mark.glsl"

layout(local_size_x = LSF_VOXELIZE_GROUP) in;

layout(std430, binding = LSF_BINDING_TILES) coherent buffer lsf_tile_block
{
    uint tiles[]; /* header as in the list of bricks; then pairs of triangle and tile */
};

/* False when the tiles do not all fit in the list: the invocation then voxelizes the triangle itself, and the
 * slots that were free are marked as empty. */
bool list_tiles(uint triangle, ivec2 columns)
{
    ivec2 count = (columns + LSF_VOXELIZE_TILE - 1) / LSF_VOXELIZE_TILE;
    uint needed = uint(count.x * count.y);
    uint first = atomicAdd(tiles[3], needed);
    bool fits = first + needed <= LSF_VOXELIZE_TILES;
    uint end = min(first + needed, LSF_VOXELIZE_TILES);
    for (uint i = first; i < end; i++) {
        tiles[LSF_VOXEL_LIST_HEADER + 2u * i] = fits ? triangle : LSF_NO_NODE;
        tiles[LSF_VOXEL_LIST_HEADER + 2u * i + 1u] = i - first;
    }
    if (first < end)
        atomicMax(tiles[1], (end - 1u) / LSF_VOXEL_LIST_ROW + 1u);
    return fits;
}

void main()
{
    uint triangle = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * LSF_VOXELIZE_ROW;
    voxel_triangle t;
    if (triangle >= range.y || !triangle_load(triangle, -1, t))
        return;
    int columns = t.columns.x * t.columns.y;
    if (columns > LSF_VOXELIZE_SMALL && list_tiles(triangle, t.columns))
        return;
    visit_all(t);
}
