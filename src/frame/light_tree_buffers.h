/* The tree over a cloud of VPLs, from the pass that builds it to the passes that sample it. */
#ifndef LSF_FRAME_LIGHT_TREE_BUFFERS_H
#define LSF_FRAME_LIGHT_TREE_BUFFERS_H

#include "gl/gl.h"
#include "shared/light_tree_data.h"
#include "shared/vpl_record.h"

/* Names are borrowed. */
typedef struct lsf_light_tree_buffers {
    GLuint cloud; /* one struct lsf_vpl_record for each VPL */
    GLuint tree;  /* struct lsf_light_tree_data */
    GLuint nodes; /* one struct lsf_light_tree_node for each node */
    GLuint areas; /* float each: squared radius of the disc of the area that a VPL stands for; of
                   * those in the tree */
} lsf_light_tree_buffers;

/* Binds them for lib/light_tree.glsl. */
void lsf_light_tree_bind(const lsf_light_tree_buffers *buffers);

/* Buffer textures of the cloud, the nodes and the areas. */
typedef struct lsf_light_tree_fetch {
    GLuint textures[3];
} lsf_light_tree_fetch;

bool lsf_light_tree_fetch_create(lsf_light_tree_fetch *fetch, lsf_context *context,
                                 lsf_error *error);
/* Binds a finished tree for LIGHT_TREE_FETCH of lib/light_tree.glsl. */
void lsf_light_tree_fetch_bind(const lsf_light_tree_fetch *fetch,
                               const lsf_light_tree_buffers *buffers);
void lsf_light_tree_fetch_destroy(lsf_light_tree_fetch *fetch);

#endif
