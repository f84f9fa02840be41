/* The grid of voxels about the scene: how large a voxel is and where the first one lies. */
#ifndef LSF_FRAME_VOXEL_GRID_H
#define LSF_FRAME_VOXEL_GRID_H

#include "frame/iteration.h"
#include "plan/option.h"
#include "shared/voxel_data.h"

typedef struct lsf_voxel_grid_params {
    int32_t resolution; /* voxels along the scene's longest side; 0: as the plan says */
    float memory;       /* MiB that the grid's textures may take; a coarser grid is taken instead */
    bool jitter;        /* the grid is shifted at random within a voxel each iteration */
} lsf_voxel_grid_params;

#define LSF_VOXEL_GRID_PARAMS_DEFAULTS .memory = 2048.0f, .jitter = true

#define LSF_VOXEL_GRID_OPTION_COUNT 3
extern const lsf_option_row lsf_voxel_grid_options[LSF_VOXEL_GRID_OPTION_COUNT];

/* Voxels are cubes. `size` is that of textures: whole blocks of occupancy. */
typedef struct lsf_voxel_grid {
    uint32_t wanted, resolution; /* asked for, and taken */
    uint32_t size[3];            /* voxels along x, y, z, multiples of 16 */
    float side;                  /* of a voxel [normalised units] */
    float origin[3];             /* least corner without jitter */
    float unit; /* scale of stored radiance, a power of two: usual values are near 1 */
    bool jitter;
} lsf_voxel_grid;

/* Voxels along the scene's longest side where nothing says otherwise. */
#define LSF_VOXEL_RESOLUTION 128

/* What a grid is for: the memory of textures over it. */
typedef struct lsf_voxel_grid_use {
    uint32_t voxels; /* along the scene's longest side, where voxel.resolution is 0 */
    uint32_t bytes;  /* bytes of a voxel in all of them */
    uint32_t sides;  /* slices along z, the most of any texture */
} lsf_voxel_grid_use;

/* The finest grid, up to the resolution asked for, whose textures fit the memory and any device,
 * for a scene that is not empty. Its unit is not set. */
lsf_voxel_grid lsf_voxel_grid_fit(const lsf_voxel_grid_params *params, const lsf_state *state,
                                  const lsf_voxel_grid_use *use);
/* Notes in the plan how large a voxel is, and why there are few. */
void lsf_voxel_grid_remark(lsf_plan *plan, const lsf_voxel_grid_params *params,
                           const lsf_voxel_grid *grid);
void lsf_voxel_grid_set_unit(lsf_voxel_grid *grid, const lsf_scene *scene, const lsf_state *state);

/* The grid in the form that shaders read, shifted for this iteration. At least half a voxel
 * stays free on each side of the scene. */
struct lsf_voxel_grid_data lsf_voxel_grid_data(const lsf_voxel_grid *grid,
                                               const lsf_iteration *iteration);

/* A scene as voxels: 3D textures of the grid's size, read with texelFetch; lib/voxel.glsl says
 * what they hold. Attributes are defined in occupied voxels only. */
typedef struct lsf_voxels {
    GLuint grid_buffer;                           /* struct lsf_voxel_grid_data */
    GLuint occupancy[LSF_VOXEL_OCCUPANCY_LEVELS]; /* R32UI */
    GLuint albedo, point;                         /* R32UI */
    GLuint normal;                                /* R32UI, of planes */
    GLuint shading;                               /* R32UI; 0 where normals are those of the
                                                   * planes */
    GLuint emission;                              /* R32UI; 0 without emitting materials */
    GLuint shining;                               /* R32UI, bricks that emit; 0 without emitting
                                                   * materials */
    GLuint specular_params;                       /* R32UI; 0 unless some material is glossy */
    GLuint transmission;                          /* R32UI; 0 unless some material transmits
                                                   * light */
    GLuint bricks;                                /* occupied bricks; voxel_data.h has the layout */
    GLuint previous_bricks; /* those of the run before: what readers wrote there is out of date */
    bool changed;           /* whether they have changed since the run before */
} lsf_voxels;

/* Binds the grid's buffer, for lib/voxel.glsl. */
void lsf_voxels_bind_grid(const lsf_voxels *voxels);
/* Binds it and all textures, to the units in voxel_data.h. */
void lsf_voxels_bind(const lsf_voxels *voxels);

/* Plans a texture over the grid, `sides` slices along z. */
void lsf_voxel_texture_plan(lsf_plan *plan, const lsf_voxel_grid *grid, const char *name,
                            GLenum internal_format, uint32_t sides, uint32_t levels,
                            const char *why);

/* Whether voxels keep shading normals and tangents beside the normals of their planes; adds the
 * switch to the current pass, which reads them. */
bool lsf_voxel_bends(const lsf_plan *plan);
void lsf_voxel_bend_switch(lsf_plan *plan);
/* The same for roughness, metallic and f0. */
bool lsf_voxel_has_specular_params(const lsf_plan *plan);
void lsf_voxel_specular_params_switch(lsf_plan *plan);
/* Whether rays that show detail go on from smooth metals by their lobe, which mirrors the
 * environment and other voxels. */
bool lsf_voxel_mirrors(const lsf_plan *plan, const lsf_state *state);
/* Whether smooth metals mirror lamps, of which each side of a voxel keeps one: punctual lights and
 * directions of the environment; adds the switch to the current pass. */
bool lsf_voxel_lamps(const lsf_plan *plan, const lsf_state *state);
void lsf_voxel_lamps_switch(lsf_plan *plan, bool lamps);
/* Binds the lamps that voxels keep, and sets the uniform of lib/voxel_surface.glsl. `lit`: the
 * light of voxels that is read contains that of lamps. */
void lsf_voxel_lamps_bind(const lsf_iteration *iteration, const lsf_voxel_grid *grid, GLuint lamps,
                          bool lit);
/* Solid angle of a voxel seen over half the scene's extent [sr]. */
float lsf_voxel_solid_angle(const lsf_voxel_grid *grid);
/* Adds the switch of surfaces that transmit and are there by chance, where cones march. */
void lsf_voxel_chance_switch(lsf_plan *plan);
/* Whether rays go on through voxels of materials that transmit. */
bool lsf_voxel_passage(const lsf_plan *plan);
/* Adds the switches of lib/voxel_passage.glsl where they do, but for those of materials: specular
 * parameters, shading normals, and that light is transmitted. */
void lsf_voxel_passage_switches(lsf_plan *plan);
/* The same with these, for passes that need them for nothing else; where rays end, the switches of
 * rough walls that are seen. */
void lsf_voxel_passage_all_switches(lsf_plan *plan);
/* The media's absorption, for such passes. */
void lsf_voxel_passage_bind(const lsf_iteration *iteration);

#endif
