/* What paths through the voxels read; lib/voxel_vertex.glsl is the shader's side. */
#ifndef LSF_FRAME_PATH_INPUTS_H
#define LSF_FRAME_PATH_INPUTS_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "frame/voxel_grid.h"

typedef struct lsf_path_inputs {
    const lsf_surface_maps *seen; /* by points */
    GLuint far_side, far_color;   /* as in lsf_gbuffer_maps, by pixels */
    const lsf_voxels *voxels;
    const lsf_voxel_grid *grid; /* of the voxels */
    GLuint radiance;            /* of voxels, two sides */
    GLuint lamps;               /* that smooth metals mirror; 0: none */
} lsf_path_inputs;

/* Binds them, the materials and the environment for the program in use. */
void lsf_path_inputs_bind(const lsf_path_inputs *inputs, const lsf_iteration *iteration);

#endif
