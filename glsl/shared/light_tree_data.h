/* The tree over a cloud of VPLs, and the buffers that it is built in; see src/passes/light_tree.md.
 * Normalised space. */
#ifndef LSF_SHARED_LIGHT_TREE_DATA_H
#define LSF_SHARED_LIGHT_TREE_DATA_H

#include "shared/shared.h"

/* What a link leads to: an inner node by its number, or with LSF_LIGHT_TREE_LEAF a record of the
 * cloud. LSF_LIGHT_TREE_NONE: there is no VPL at all. */
#define LSF_LIGHT_TREE_LEAF 0x80000000u
#define LSF_LIGHT_TREE_NONE 0xffffffffu

/* Of a record's number in its code, whose last bits it is. */
#define LSF_LIGHT_TREE_ID_BITS 24

struct lsf_light_tree_data {
    uint live;                                        /* VPLs in the tree */
    uint root;                                        /* link */
    uint low_x, low_y, low_z, high_x, high_y, high_z; /* bounds of their positions, each a float
                                                       * whose order as a uint is that of floats */
};

/* An inner node. `variance` is along the axes of light_tree_frame, or with the switch
 * LSF_LIGHT_TREE_COVARIANCE along those of the space, and `covariance` its xy, xz and yz. */
struct lsf_light_tree_node {
    vec3 position;    /* mean of the positions below it, by luminance */
    float similarity; /* of the normals below it, 0..1 */
    vec3 intensity;   /* the sum [W/sr] */
    uint normal;      /* mean, as lib/octahedral.glsl packs it */
    vec3 low;         /* box that encloses the positions */
    uint left;        /* link */
    vec3 high;
    uint right;
    vec3 variance; /* of the positions */
    uint count;    /* VPLs below it */
    vec3 covariance;
    uint usable; /* 1 where it may stand for all that is below it, else 0 */
};

/* Keys that a work group sorts: rows, one key for each of its invocations. */
#define LSF_LIGHT_TREE_GROUP 256
#define LSF_LIGHT_TREE_ROWS 8
#define LSF_LIGHT_TREE_TILE (LSF_LIGHT_TREE_GROUP * LSF_LIGHT_TREE_ROWS)

/* A pass of the sort looks at so many bits. */
#define LSF_LIGHT_TREE_DIGIT_BITS 8
#define LSF_LIGHT_TREE_DIGITS (1 << LSF_LIGHT_TREE_DIGIT_BITS)

/* What is counted of samples: all, those in branches that hold nothing for their point, and nodes
 * that were left on the way down. */
#define LSF_LIGHT_TREE_SAMPLE_ALL 0
#define LSF_LIGHT_TREE_SAMPLE_DEAD 1
#define LSF_LIGHT_TREE_SAMPLE_STEPS 2
#define LSF_LIGHT_TREE_SAMPLE_COUNTS 3

/* Location of the number of records in the cloud, in all that builds the tree. */
#define LSF_LOCATION_LIGHT_TREE_RECORDS 1

/* Nodes above a leaf are fewer than the bits of a code. They are merged in so many dispatches, from
 * the leaves up. */
#define LSF_LIGHT_TREE_TURNS 64

/* Storage buffers. */
#define LSF_BINDING_CLOUD 1
#define LSF_BINDING_LIGHT_TREE 2
#define LSF_BINDING_LIGHT_TREE_NODES 3
#define LSF_BINDING_LIGHT_TREE_AREAS 4
#define LSF_BINDING_LIGHT_TREE_CODES 5 /* and, in the sort, the next: where they go */
#define LSF_BINDING_LIGHT_TREE_COUNTS 7
#define LSF_BINDING_LIGHT_TREE_PARENTS 6
#define LSF_BINDING_LIGHT_TREE_TURNS 7
#define LSF_BINDING_LIGHT_TREE_TRIANGLES 5 /* of the scene, in what samples the tree */

#include "shared/shared_end.h"
#endif
