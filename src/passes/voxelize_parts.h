/* Declarations that the files of voxelize share. */
#ifndef LSF_PASSES_VOXELIZE_PARTS_H
#define LSF_PASSES_VOXELIZE_PARTS_H

#include "frame/triangle_fetch.h"
#include "passes/voxelize.h"

#define LSF_VOXELIZE_TEXTURES 11

/* Storage buffers beside LSF_BINDING_MATERIALS. */
#define BINDING_BRICKS 1
#define BINDING_TILES 2
#define BINDING_DRAWS 2
#define BINDING_WON 3

/* Tiles of large triangles that a work group shares. */
#define GROUP_TILES 8

/* Work groups of triangles are laid out in rows: GL promises 65,535 along an axis. */
#define GROUP 64
#define ROW_GROUPS 1024u

/* struct voxelize_draw in voxelize_list.glsl. */
typedef struct voxelize_draw {
    uint32_t groups[3], first, count, listed, first_triangle, triangles;
} voxelize_draw;

/* The grid with the instances that stand still, where others move: each run begins with a copy
 * of it. */
typedef struct lsf_voxelize_still {
    bool *moves;             /* of each instance; NULL: nothing is kept */
    float (*transforms)[12]; /* of each instance, as of the last run */
    bool *drawn;             /* whether it was drawn then */
    uint32_t instance_count;
    const lsf_scene *scene;
    float *values;                          /* of the pose, as of the last run */
    GLuint textures[LSF_VOXELIZE_TEXTURES]; /* as lsf_voxelize_textures lists them */
    GLuint bricks;
} lsf_voxelize_still;

struct lsf_voxelize {
    lsf_context *context;
    lsf_voxel_grid grid;
    lsf_voxels outputs;
    GLuint key;         /* R32UI: the winner's bid; 0: empty */
    GLuint tiles;       /* of large triangles */
    GLuint draws_start; /* instances in the order of draws, with their triangles' numbers */
    GLuint draws, won;  /* the same with the voxels that they have won, and these */
    GLuint bricks[2];   /* lists of this run and of the run before */
    uint32_t runs;
    bool stale; /* instances that stand still have changed since the run before */
    GLuint clear_program, count_program, sum_program, list_program, write_program, beside_program;
    /* Bids: an instance's small triangles, then its large ones; or all on the raster pipeline. */
    GLuint small_program, large_program, raster_program;
    GLuint framebuffer;
    uint32_t side; /* of the framebuffer: the grid's longest */
    lsf_triangle_fetch fetch;
    lsf_voxelize_still still;
    uint64_t counts[LSF_VOXELIZE_COUNTS];
    lsf_timer *timer;
};

/* A texture of the pass, 0 where the plan lists none, and its name in the plan. */
typedef struct lsf_voxelize_texture {
    const char *name;
    GLuint *texture;
} lsf_voxelize_texture;

void lsf_voxelize_textures(lsf_voxelize *pass,
                           lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES]);

/* --- voxelize_plan.c --- */

/* Number of voxels for which there is room in the list of those that instances win. */
uint64_t lsf_voxelize_won_voxels(const lsf_voxel_grid *grid);

/* --- voxelize_still.c --- */

/* Whether no iteration's voxels are those of another: the grid moves, or blended surfaces come and
 * go. */
bool lsf_voxelize_always_anew(const lsf_plan *plan, bool jitter);
/* Whether the grid is copied: something moves in it, and it does not itself. */
bool lsf_voxelize_keeps_still(const lsf_plan *plan, bool jitter);
/* Lists the copies of everything that the pass has planned; nothing where nothing moves or the grid
 * does. */
void lsf_voxelize_still_plan(lsf_plan *plan, const lsf_voxel_grid *grid);
bool lsf_voxelize_still_create(lsf_voxelize *pass, const lsf_plan *plan, const lsf_scene *scene,
                               lsf_error *error);
/* Whether an instance moved since this was asked last. */
bool lsf_voxelize_still_moved(lsf_voxelize *pass, const lsf_state *state);
/* Copies the grid to the kept one; copies the kept one to the grid. */
void lsf_voxelize_still_keep(lsf_voxelize *pass);
void lsf_voxelize_still_restore(lsf_voxelize *pass);
void lsf_voxelize_still_destroy(lsf_voxelize *pass);

#endif
