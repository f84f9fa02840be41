/* Voxels of a scene and their light, outside of any technique. */
#ifndef LSF_TESTS_PASSES_VOXEL_RIG_H
#define LSF_TESTS_PASSES_VOXEL_RIG_H

#include "passes/shadow_map.h"
#include "passes/sky_map.h"
#include "passes/voxel_light.h"
#include "passes/voxelize.h"
#include "render_gl.h"
#include "techniques/setup.h"

typedef struct voxel_rig {
    lsf_context *context;
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    lsf_voxel_grid grid;
    lsf_voxelize *pass;
    const lsf_voxels *outputs;
    lsf_shadow_map shadow_map;
    lsf_sky_map sky_map; /* where there is an environment: with maps of what the camera sees */
    lsf_voxel_light light;
    uint32_t sides; /* 0: voxels are not lit */
} voxel_rig;

void voxel_rig_init(voxel_rig *rig, const lsf_scene *scene, int32_t resolution,
                    lsf_voxelize_method method, bool jitter, uint32_t sides);
/* Makes its context current: rigs may stand beside each other. Running and finishing do so
 * themselves. */
void voxel_rig_bind(const voxel_rig *rig);

/* Voxelises, and lights voxels where they are to be lit. */
void voxel_rig_run(voxel_rig *rig, uint32_t iteration);
void voxel_rig_finish(voxel_rig *rig);

size_t voxel_rig_voxel_count(const voxel_rig *rig);
/* Words of a texture; free them. */
uint32_t *voxel_rig_read_texture(GLuint texture, size_t texels);
/* 1 for each occupied voxel, from the bits of the finest level; free it. */
uint8_t *voxel_rig_read_occupancy(const voxel_rig *rig);
/* Radiance in scene units and alpha of all sides, four floats each; free it. */
float *voxel_rig_read_radiance(const voxel_rig *rig);
/* The voxel that holds a point in scene space. */
size_t voxel_rig_voxel_at(const voxel_rig *rig, lsf_float3 point);

#endif
