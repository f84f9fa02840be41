/* Light that voxels send out: their emission, and the light of punctual lights and of the
 * environment's directions that they reflect. See voxel_light.md. */
#ifndef LSF_PASSES_VOXEL_LIGHT_H
#define LSF_PASSES_VOXEL_LIGHT_H

#include "frame/light_projection.h"
#include "frame/voxel_grid.h"

/* Texels of a directional light's map along a voxel's side: shadow borders are finer than voxels.
 */
#define LSF_VOXEL_LIGHT_TEXELS 4
/* The same for maps of the environment's directions: with so many, voxels blur the light as much as
 * texels do. */
#define LSF_VOXEL_LIGHT_SKY_TEXELS 1

typedef struct lsf_voxel_light_use {
    uint32_t sides;  /* 1 (the front), LSF_VOXEL_SIDES_SURFACE or LSF_VOXEL_SIDES_AXES */
    uint32_t levels; /* of the texture; the pass writes the finest. With 1 it is not filtered, and
                      * texels of empty voxels mean nothing */
    bool lights;     /* there are punctual lights */
    bool lamps;      /* smooth metals keep one; with LSF_VOXEL_SIDES_SURFACE only */
    bool pcf;        /* maps have no gradients */
    float sky_rays;  /* number of rays that find the environment from a voxel by chance, drawn by
                      * the cosine */
} lsf_voxel_light_use;

typedef struct lsf_voxel_light {
    lsf_context *context;
    GLuint radiance; /* RGBA16F in the grid's unit; slices along z are the sides; alpha: how much of
                      * a surface faces that way */
    GLuint lamps; /* RGBA32UI, slices as of radiance: the light that a side of smooth metal keeps,
                   * as packed by lib/voxel_lamp.glsl; 0 unless `use.lamps` */
    lsf_voxel_light_use use;
    bool written;  /* since it began */
    uint32_t runs; /* that have added lights since */
    GLuint clear_program, emit_program;
    GLuint first_program, add_program; /* 0: there are no punctual lights */
    GLuint sky_program;                /* 0: the environment lights by no directions */
    lsf_timer *timer;
} lsf_voxel_light;

void lsf_voxel_light_plan(lsf_plan *plan, const lsf_voxel_grid *grid,
                          const lsf_voxel_light_use *use);
bool lsf_voxel_light_create(lsf_voxel_light *pass, lsf_context *context, const lsf_plan *plan,
                            const lsf_voxel_light_use *use, lsf_error *error);
/* Clears the output of the run before. */
void lsf_voxel_light_begin(lsf_voxel_light *pass, const lsf_voxels *voxels);
/* Writes the voxels' emission where no light was added; does nothing after lights. */
void lsf_voxel_light_emit(lsf_voxel_light *pass, const lsf_voxels *voxels);
/* Adds the reflected light of a punctual light, by its shadow map, to the voxels' emission. */
void lsf_voxel_light_add(lsf_voxel_light *pass, const lsf_iteration *iteration,
                         const lsf_voxels *voxels, const lsf_shadow *shadow);
/* The same of directions of the environment, by those of `maps` that hold the whole scene. */
void lsf_voxel_light_add_sky(lsf_voxel_light *pass, const lsf_iteration *iteration,
                             const lsf_voxels *voxels, const lsf_shadow *maps, uint32_t count);
void lsf_voxel_light_destroy(lsf_voxel_light *pass);

#endif
