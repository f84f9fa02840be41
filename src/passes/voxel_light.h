/* Light that voxels send out: direct light of punctual lights, emission, and further bounces. See
 * voxel_light.md. */
#ifndef LSF_PASSES_VOXEL_LIGHT_H
#define LSF_PASSES_VOXEL_LIGHT_H

#include "plan/voxel_grid.h"

/* The voxels to light: what voxelize hands out. */
typedef struct lsf_voxel_light_inputs {
    GLuint occupancy[LSF_VOXEL_OCCUPANCY_LEVELS];
    GLuint albedo, normal, point, emission, gloss;
    GLuint bricks, previous_bricks;
    bool changed;
} lsf_voxel_light_inputs;

/* A light's map: depth and gradient as of shadow_map, with the light at LSF_BINDING_LIGHT. */
typedef struct lsf_voxel_light_map {
    GLuint depth, gradient;
} lsf_voxel_light_map;

typedef struct lsf_voxel_light_use {
    uint32_t sides;  /* 1, LSF_VOXEL_SIDES_SURFACE or LSF_VOXEL_SIDES_AXES */
    uint32_t levels; /* of the texture */
} lsf_voxel_light_use;

typedef struct lsf_voxel_light {
    lsf_context *context;
    /* RGBA16F in the grid's unit; its slices along z are the sides; alpha 1 where occupied. */
    GLuint radiance;
    lsf_voxel_light_use use;
    lsf_voxel_grid grid;
    GLuint begin_program, add_program, clear_program;
    lsf_timer *timer;
} lsf_voxel_light;

void lsf_voxel_light_plan(lsf_plan *plan, const lsf_voxel_grid *grid,
                          const lsf_voxel_light_use *use);
bool lsf_voxel_light_create(lsf_voxel_light *pass, lsf_context *context, const lsf_plan *plan,
                            const lsf_voxel_grid *grid, const lsf_voxel_light_use *use,
                            lsf_error *error);
/* Emission only; radiance elsewhere becomes 0. */
void lsf_voxel_light_begin(lsf_voxel_light *pass, const lsf_voxel_light_inputs *inputs);
/* Adds the light in turn. */
void lsf_voxel_light_add(lsf_voxel_light *pass, const lsf_voxel_light_inputs *inputs,
                         const lsf_voxel_light_map *map);
void lsf_voxel_light_destroy(lsf_voxel_light *pass);

#endif
