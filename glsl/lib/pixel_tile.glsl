/* Tiles of 4 x 4 pixels, which share out samples among them. */
#ifndef LSF_LIB_PIXEL_TILE
#define LSF_LIB_PIXEL_TILE

#include "lib/hash.glsl"

/* The pixel's number among those of its tile, in an order in which neighbours are far from each other. */
float tile_order()
{
    uvec2 p = uvec2(gl_FragCoord.xy) & 3u;
    uint x = p.x ^ p.y;
    return float(((x & 1u) << 3) | ((p.y & 1u) << 2) | (x & 2u) | (p.y >> 1));
}

/* Random numbers of the tile, 0 to 1. */
vec3 tile_number(uint purpose)
{
    return hash_unit(hash(uvec3(uvec2(gl_FragCoord.xy) >> 2, purpose)));
}

#endif
