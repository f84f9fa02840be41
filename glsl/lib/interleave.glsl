/* Positions of pixels in split order; see src/passes/sparse.md. Switch LSF_INTERLEAVE: there is a pattern.
 * Along an axis of `length` pixels, tile t holds the pixels t + i size: one more in the first length % size tiles
 * than in the others. */
#ifndef LSF_LIB_INTERLEAVE
#define LSF_LIB_INTERLEAVE

#include "lib/view.glsl"

/* Tiles along a side of the pattern. */
#if LSF_INTERLEAVE
#define INTERLEAVE_SIZE int(view.jitter.w)
#else
#define INTERLEAVE_SIZE 1
#endif

ivec2 interleave_corner(ivec2 tile, ivec2 length)
{
    return tile * (length / INTERLEAVE_SIZE) + min(tile, length % INTERLEAVE_SIZE);
}

/* The position of a pixel in split order. */
ivec2 interleave_position(ivec2 pixel, ivec2 length)
{
    return interleave_corner(pixel % INTERLEAVE_SIZE, length) + pixel / INTERLEAVE_SIZE;
}

/* The pixel at a position in split order. */
ivec2 interleave_pixel(ivec2 position, ivec2 length)
{
    ivec2 shorter = length / INTERLEAVE_SIZE, longer_tiles = length % INTERLEAVE_SIZE;
    ivec2 in_longer = position / (shorter + 1);
    ivec2 in_shorter =
        longer_tiles + (position - longer_tiles * (shorter + 1)) / max(shorter, ivec2(1));
    ivec2 tile = ivec2(in_longer.x < longer_tiles.x ? in_longer.x : in_shorter.x,
                       in_longer.y < longer_tiles.y ? in_longer.y : in_shorter.y);
    return (position - interleave_corner(tile, length)) * INTERLEAVE_SIZE + tile;
}

#endif
