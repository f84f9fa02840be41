/* Positions of pixels in split order; see src/passes/sparse.md. Switch LSF_INTERLEAVE, the size of the pattern.
 * Along an axis of `length` pixels, tile t holds the pixels t + i size: one more in the first length % size tiles
 * than in the others. */
#ifndef LSF_LIB_INTERLEAVE
#define LSF_LIB_INTERLEAVE

ivec2 interleave_corner(ivec2 tile, ivec2 length)
{
    return tile * (length / LSF_INTERLEAVE) + min(tile, length % LSF_INTERLEAVE);
}

/* The position of a pixel in split order. */
ivec2 interleave_position(ivec2 pixel, ivec2 length)
{
    return interleave_corner(pixel % LSF_INTERLEAVE, length) + pixel / LSF_INTERLEAVE;
}

/* The pixel at a position in split order. */
ivec2 interleave_pixel(ivec2 position, ivec2 length)
{
    ivec2 shorter = length / LSF_INTERLEAVE, longer_tiles = length % LSF_INTERLEAVE;
    ivec2 in_longer = position / (shorter + 1);
    ivec2 in_shorter =
        longer_tiles + (position - longer_tiles * (shorter + 1)) / max(shorter, ivec2(1));
    ivec2 tile = ivec2(in_longer.x < longer_tiles.x ? in_longer.x : in_shorter.x,
                       in_longer.y < longer_tiles.y ? in_longer.y : in_shorter.y);
    return (position - interleave_corner(tile, length)) * LSF_INTERLEAVE + tile;
}

#endif
