/* The nodes of a ray-bundle, for readers of lib/ray_bundle.glsl. */
#ifndef LSF_FRAME_BUNDLE_NODES_H
#define LSF_FRAME_BUNDLE_NODES_H

#include "gl/gl.h"

/* Arrays of nodes, bound from LSF_BINDING_BUNDLE_NODES on; lib/ray_bundle.glsl says what they
 * hold. */
enum {
    LSF_RAY_BUNDLE_HEADS,
    LSF_RAY_BUNDLE_KEYS,
    LSF_RAY_BUNDLE_SURFACES,
    LSF_RAY_BUNDLE_SPECULAR_PARAMS,
    LSF_RAY_BUNDLE_EMISSION,
    LSF_RAY_BUNDLE_CHAIN,
    LSF_RAY_BUNDLE_ARRAYS,
};

/* Borrowed. */
typedef struct lsf_bundle_nodes {
    GLuint projections; /* buffer with a struct lsf_bundle_data at `offset` */
    GLintptr offset;
    const GLuint *arrays; /* LSF_RAY_BUNDLE_ARRAYS buffers */
} lsf_bundle_nodes;

void lsf_bundle_nodes_bind(const lsf_bundle_nodes *nodes);

#endif
