/* Clouds of VPLs made by hand, and the tree over them read back. */
#ifndef LSF_TESTS_PASSES_LIGHT_TREE_RIG_H
#define LSF_TESTS_PASSES_LIGHT_TREE_RIG_H

#include "passes/light_tree.h"
#include "render_gl.h"

typedef enum cloud_kind {
    CLOUD_ROOM,    /* on the six sides of a box, which face inwards, and on a ball in it */
    CLOUD_POINT,   /* all at one place, normals all ways */
    CLOUD_PLANE,   /* normals all the same, on a tilted plane */
    CLOUD_SAME,    /* the same VPL again and again */
    CLOUD_BRIGHT,  /* CLOUD_ROOM, one of them 10^6 times as bright as the rest */
    CLOUD_DEAD,    /* none shines */
    CLOUD_DAMAGED, /* CLOUD_ROOM, of which some are dead or hold what is no number */
} cloud_kind;

/* `count` records, of which the caller frees the array. */
struct lsf_vpl_record *cloud_make(cloud_kind kind, uint32_t count, uint32_t seed);
bool cloud_shines(const struct lsf_vpl_record *record);
float cloud_luminance(lsf_vec3 intensity);

typedef struct read_tree {
    struct lsf_light_tree_data data;
    struct lsf_light_tree_node *nodes; /* `capacity` of them */
    float *areas;                      /* by record */
    uint32_t capacity;
} read_tree;

read_tree read_tree_of(const lsf_light_tree *tree);
void read_tree_free(read_tree *read);

#endif
