/* The voxel grid, uniform buffer LSF_BINDING_VOXEL, and the layout of its textures; functions on
 * them are in lib/voxel.glsl. */
#ifndef LSF_SHARED_VOXEL_DATA_H
#define LSF_SHARED_VOXEL_DATA_H

#include "shared/shared.h"

struct lsf_voxel_grid_data {
    vec4 origin; /* xyz: lower corner [normalised space]; w: side of a voxel */
    vec4 size;   /* xyz: voxels along each axis, multiples of 16; w: 1 / side of a voxel */
    vec2 unit;   /* x: factor on stored radiance, a power of two; y: 1 / x */
    /* Bits that tell a triangle among all, and one value more: a bid is never 0. As a switch they
     * would make each scene compile its own shaders. */
    uint id_bits, unused;
};

/* Occupancy has two levels with a bit for each cell: a voxel, or a brick of 4^3 voxels. A texel
 * holds 4 x 4 x 2 bits, so that two texels that are adjacent in x are a cell of the next level. */
#define LSF_VOXEL_OCCUPANCY_LEVELS 2
#define LSF_VOXEL_BRICK 4

/* The sides for which radiance is stored, slices of the grid stacked along z: either the two
 * sides of a surface (its normal's, and the other), or lobes of six normals, premultiplied by
 * the share of a surface that faces along each: a side with normal n adds n_a^2 (radiance, 1)
 * for each axis a, to slice 2 a where n_a < 0, which a view along +a sees, and to slice 2 a + 1
 * where n_a > 0. Either way a lit wall seen from behind shows its other side. */
#define LSF_VOXEL_SIDES_SURFACE 2
#define LSF_VOXEL_SIDES_AXES 6

/* Levels of the pyramid of radiance; slices of grids made of whole blocks halve exactly that
 * often. */
#define LSF_VOXEL_LEVELS 5

/* Texture units. */
#define LSF_UNIT_VOXEL_EMISSION 4
#define LSF_UNIT_VOXEL_POINT 6
#define LSF_UNIT_VOXEL_TRANSMISSION 8
#define LSF_UNIT_VOXEL_RADIANCE 9
#define LSF_UNIT_VOXEL_OCCUPANCY 10 /* and the next */
#define LSF_UNIT_VOXEL_ALBEDO 13
#define LSF_UNIT_VOXEL_NORMAL 14
#define LSF_UNIT_VOXEL_SPECULAR_PARAMS 15
#define LSF_UNIT_VOXEL_SHINING 12
#define LSF_UNIT_VOXEL_SHADING 16
#define LSF_UNIT_VOXEL_LAMP 18
#define LSF_UNIT_PATH_RANDOM 7
#define LSF_UNIT_FAR_SIDE 19 /* of media behind the visible surface */
#define LSF_UNIT_FAR_COLOR 21

/* Lists, storage buffers: the work groups of a dispatch, as rows of LSF_VOXEL_LIST_ROW entries
 * each, and the number of entries; then the entries. */
#define LSF_VOXEL_LIST_ROW 256
#define LSF_VOXEL_LIST_HEADER 4 /* words: groups in x, y and z, entries */

/* List of occupied bricks. Each work group takes several, with as many invocations for each as
 * software GL has lanes. */
#define LSF_VOXEL_GROUP_BRICKS 8
#define LSF_VOXEL_BRICK_LANES 8
struct lsf_voxel_brick_data {
    uint cell;      /* packed as by voxel_brick_pack */
    uint low, high; /* the voxels' bits, half a brick each, laid out as in occupancy */
    uint sides;     /* of the sides that radiance is kept for, those that some voxel has */
};

#include "shared/shared_end.h"
#endif
