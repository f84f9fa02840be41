/* Positions of points in the textures in which light is gathered: those of a tile of the interleaving pattern are
 * adjacent, with the second layer of the same tile above them. Switches LSF_SPARSE, LSF_INTERLEAVE. */
#ifndef LSF_PASSES_SPARSE_ORDER
#define LSF_PASSES_SPARSE_ORDER

#include "lib/interleave.glsl"
#include "lib/sparse_grid.glsl"

#if LSF_SPARSE
/* Number of rows of a tile's points, and the row at which the tile would begin with one layer. */
int tile_rows(int tile)
{
    return sparse_grid.y / INTERLEAVE_SIZE + int(tile < sparse_grid.y % INTERLEAVE_SIZE);
}

int tile_corner(int tile)
{
    return interleave_corner(ivec2(0, tile), sparse_grid.xy).y;
}

ivec2 sparse_position(ivec2 point, int layer)
{
    ivec2 position = interleave_position(point, sparse_grid.xy);
    int tile = point.y % INTERLEAVE_SIZE;
    position.y += (sparse_shape.y - 1) * tile_corner(tile) + layer * tile_rows(tile);
    return position;
}

/* The inverse. */
ivec2 sparse_point(ivec2 position, out int layer)
{
    int rows = sparse_grid.y / INTERLEAVE_SIZE, higher = sparse_grid.y % INTERLEAVE_SIZE;
    int high = sparse_shape.y * (rows + 1), low = max(sparse_shape.y * rows, 1);
    int tile = position.y / high;
    if (tile >= higher)
        tile = higher + (position.y - higher * high) / low;
    int row = position.y - sparse_shape.y * tile_corner(tile);
    layer = row / max(tile_rows(tile), 1);
    row += tile_corner(tile) - layer * tile_rows(tile);
    return interleave_pixel(ivec2(position.x, row), sparse_grid.xy);
}
#endif

#endif
