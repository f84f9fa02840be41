/* Sides of voxels drawn by their radiance. */
#ifndef LSF_SHARED_VOXEL_DRAW_DATA_H
#define LSF_SHARED_VOXEL_DRAW_DATA_H

#include "shared/shared.h"

#define LSF_VOXEL_DRAWS 4096 /* in a list */

/* Storage buffers: the list, and for each brick, in Morton order, the sum of what those before it
 * shine. The switch LSF_VOXEL_DRAW_BITS says how many bits of a brick's position there are along
 * each axis. */
#define LSF_BINDING_VOXEL_DRAWS 3
#define LSF_BINDING_VOXEL_DRAW_BRICKS 4

/* The list: the sum over all sides of voxels of the luminance of their radiance, in the grid's
 * unit; then the drawn sides, each with a probability proportional to its luminance. */
#define LSF_VOXEL_DRAWS_HEADER 4 /* words; all but the first are unused */

/* A drawn side has two words: the voxel as packed by voxel_brick_pack with the side's slice, and a
 * float from 0 to 1, where in the side's share of the sum the draw lies. */
#define LSF_VOXEL_DRAW_SLICE_SHIFT 30

#include "shared/shared_end.h"
#endif
