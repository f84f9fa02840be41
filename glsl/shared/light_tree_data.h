/* The tree over a cloud of VPLs, and the buffers that it is built in; see src/passes/light_tree.md.
 * Normalised space. */
#ifndef LSF_SHARED_LIGHT_TREE_DATA_H
#define LSF_SHARED_LIGHT_TREE_DATA_H

#include "shared/shared.h"

/* A link leads to an inner node by its number, or with LSF_LIGHT_TREE_LEAF to a record of the
 * cloud. LSF_LIGHT_TREE_NONE: there is no VPL at all. */
#define LSF_LIGHT_TREE_LEAF 0x80000000u
#define LSF_LIGHT_TREE_NONE 0xffffffffu

/* Bits of a record's number, the lowest ones of its code. */
#define LSF_LIGHT_TREE_ID_BITS 24

struct lsf_light_tree_data {
    uint live;                                        /* VPLs in the tree */
    uint root;                                        /* link */
    uint low_x, low_y, low_z, high_x, high_y, high_z; /* bounds of their positions, each a float
                                                       * encoded so that its order as a uint is
                                                       * that of floats */
};

/* An inner node. `variance` is along the axes of light_tree_frame, or with the switch
 * LSF_LIGHT_TREE_COVARIANCE along those of normalised space, with xy, xz and yz in `covariance`. */
struct lsf_light_tree_node {
    vec3 position;    /* mean of the positions below it, by luminance */
    float similarity; /* of the normals below it, 0..1; of lobes the mean cosine to their axis */
    vec3 intensity;   /* the sum [W/sr] */
    uint normal;      /* mean normal, of lobes mean axis, packed as in lib/octahedral.glsl */
    vec3 low;         /* box that encloses the positions */
    uint left;        /* link */
    vec3 high;
    uint right;
    vec3 variance; /* of the positions */
    uint count;    /* VPLs below it */
    vec3 covariance;
    uint usable; /* LSF_LIGHT_TREE_USABLE, LSF_LIGHT_TREE_LOBES or 0 */
};

/* Nodes that may stand for all VPLs below them, and nodes below which all VPLs have lobes. */
#define LSF_LIGHT_TREE_USABLE 1u
#define LSF_LIGHT_TREE_LOBES 2u

/* Keys that a work group sorts, one for each of its invocations in each row. */
#define LSF_LIGHT_TREE_GROUP 256
#define LSF_LIGHT_TREE_ROWS 8
#define LSF_LIGHT_TREE_TILE (LSF_LIGHT_TREE_GROUP * LSF_LIGHT_TREE_ROWS)

/* Bits of the digit that a pass of the sort uses. */
#define LSF_LIGHT_TREE_DIGIT_BITS 8
#define LSF_LIGHT_TREE_DIGITS (1 << LSF_LIGHT_TREE_DIGIT_BITS)

/* Counters of samples: all, those that end in a dead branch, and nodes that were rejected during
 * the descent. */
#define LSF_LIGHT_TREE_SAMPLE_ALL 0
#define LSF_LIGHT_TREE_SAMPLE_DEAD 1
#define LSF_LIGHT_TREE_SAMPLE_STEPS 2
#define LSF_LIGHT_TREE_SAMPLE_COUNTS 3

/* Location of the number of records in the cloud, in all shaders that build the tree. */
#define LSF_LOCATION_LIGHT_TREE_RECORDS 1

/* Number of dispatches that merge nodes, from the leaves up: at least the depth of the tree,
 * which is at most the bits of a code. */
#define LSF_LIGHT_TREE_DISPATCHES 64

/* Texture units of what samples the tree: buffer textures. */
#define LSF_UNIT_LIGHT_TREE_CLOUD 45 /* RGBA32UI */
#define LSF_UNIT_LIGHT_TREE_NODES 46 /* RGBA32UI */
#define LSF_UNIT_LIGHT_TREE_AREAS 47 /* R32F */

/* Storage buffers. */
#define LSF_BINDING_CLOUD 1
#define LSF_BINDING_LIGHT_TREE 2
#define LSF_BINDING_LIGHT_TREE_NODES 3
#define LSF_BINDING_LIGHT_TREE_AREAS 4
#define LSF_BINDING_LIGHT_TREE_CODES 5 /* and, in the sort, the next binding: their target */
#define LSF_BINDING_LIGHT_TREE_COUNTS 7
#define LSF_BINDING_LIGHT_TREE_PARENTS 6
#define LSF_BINDING_LIGHT_TREE_DISPATCHES 7
#define LSF_BINDING_LIGHT_TREE_TRIANGLES 5 /* of the scene, in what samples the tree */

#include "shared/shared_end.h"
#endif
