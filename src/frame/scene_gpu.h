/* The scene's GL resources: vertex streams, instances, materials, textures, environment. Only
 * those exist that the scene requires; what neither moves nor is edited is uploaded once. */
#ifndef LSF_FRAME_SCENE_GPU_H
#define LSF_FRAME_SCENE_GPU_H

#include "frame/clusters.h"
#include "frame/resources.h"
#include "scene/state.h"
#include "shared/scene_data.h"

/* Classes of triangles by length, two for each power of two of a squared length. */
#define LSF_SCENE_GPU_LENGTHS 512

typedef struct lsf_scene_gpu {
    lsf_context *context;
    const lsf_scene *scene;
    bool transmission, straight; /* as in the plan */
    GLuint positions, normals, tangents, uv0, uv1, colors, indices;
    GLuint instances, previous_transforms, previous_positions, materials, environment;
    GLuint triangles;        /* for lib/scene_triangles.glsl; 0 when the plan does not list it */
    uint32_t triangle_count; /* triangles in it: those of opaque materials, without those that
                              * let light straight through; from the longest class to the
                              * shortest */
    uint32_t triangles_to[LSF_SCENE_GPU_LENGTHS]; /* where each class ends */
    GLuint lobes, lobe_table; /* struct lsf_lobe_data of each material, and the texture that shaders
                               * read it by; 0: no material needs it */
    GLuint *textures;         /* one for each image and colour space in use */
    uint32_t gl_texture_count;
    uint32_t *texture_of;  /* index into `textures` for each texture of the scene */
    GLuint samplers[45];   /* wrap s, wrap t, filter: 3 x 3 x 5; 0: not needed */
    GLuint shading_array;  /* vertex array with every stream */
    GLuint position_array; /* positions (and UVs where masks need them) */
    lsf_clusters clusters;
    uint32_t *draw_order; /* instances, grouped by material */
    uint32_t draw_count;
    /* The values of each instance that were uploaded, to tell what has changed. */
    struct lsf_instance_data *placed;
    float (*placed_before)[12];   /* NULL without motion */
    float *posed, *posed_before;  /* values of the pose; NULL: nothing deforms */
    float (*corners)[9];          /* of `triangles`, while something moves; else NULL */
    const lsf_material *surfaces; /* the materials of the state that was uploaded last */
    uint64_t material_edits;      /* the scene's count of edits when materials were uploaded */
    uint64_t radiance_edits;      /* the same when its environment was uploaded */
    double *material_values;      /* animated values at that time */
    bool *drawn;                  /* the instances that were drawn at that time */
    bool anew;                    /* nothing was uploaded yet */
} lsf_scene_gpu;

/* Lists what lsf_scene_gpu_create will create. */
void lsf_scene_gpu_plan(lsf_plan *plan, const lsf_scene *scene);

/* Adds the switches of lib/material.glsl to the current pass; specular parameters and emission are
 * evaluated only where asked for. */
void lsf_scene_gpu_material_switches(lsf_plan *plan, bool specular_params, bool emission);

/* Adds switches to a pass that evaluates materials without the lobes that only the G-buffer
 * keeps apart: they are folded into those that every surface has, with about the same albedo. */
void lsf_scene_gpu_fold_lobes(lsf_plan *plan);

/* Adds switches to a pass that reads the G-buffer's specular parameters, which tell the lobes that
 * they hold. */
void lsf_scene_gpu_lobe_switches(lsf_plan *plan, bool specular_params);
/* Adds the switch of media that light goes straight through, where there are such. */
void lsf_scene_gpu_media_switch(lsf_plan *plan);
/* Adds the switch of surfaces that the camera sees through, where there are such. */
void lsf_scene_gpu_seen_through_switch(lsf_plan *plan);
/* Adds the switch of rough thin walls, where the camera sees some that scatter light. */
void lsf_scene_gpu_scatter_switch(lsf_plan *plan);
/* The same with the switches that it needs, for a pass that handles no other transmission. */
void lsf_scene_gpu_scatter_switches(lsf_plan *plan);

/* The word of a texel of the G-buffer's specular parameters that holds the clear coat, 1 to 3; 0
 * where nothing is coated, or where anisotropy, transmission and tints leave no word: coats are
 * folded then. */
int lsf_scene_gpu_coat_word(const lsf_plan *plan);
/* The same for the sheen, in the words that the coat leaves. */
int lsf_scene_gpu_sheen_word(const lsf_plan *plan);

/* Adds the switches of lib/mask.glsl. */
void lsf_scene_gpu_mask_switches(lsf_plan *plan);

/* Adds LSF_ENVIRONMENT, with the reason `why`, and the switch of lib/environment.glsl. */
void lsf_scene_gpu_environment_switches(lsf_plan *plan, const char *why);

/* Lists a table of the scene's triangles for shaders that fetch them themselves, unless the scene
 * is larger than such shaders can read on any device. */
void lsf_scene_gpu_plan_triangles(lsf_plan *plan);

/* How many triangles, from the table's first on, include all whose longest edge is at least this
 * long, in normalised space. */
uint32_t lsf_scene_gpu_triangles_from(const lsf_scene_gpu *gpu, float length);

/* `previous` is the state that motion is measured from, NULL without motion. */
bool lsf_scene_gpu_create(lsf_scene_gpu *gpu, lsf_context *context, const lsf_plan *plan,
                          const lsf_scene *scene, const lsf_state *state, const lsf_state *previous,
                          lsf_error *error);
/* Updates what depends on the state: instances that moved, vertices that were deformed, their
 * triangles, and materials that were edited. Allocates nothing. `state` has to fit the plan. */
void lsf_scene_gpu_update(lsf_scene_gpu *gpu, const lsf_state *state, const lsf_state *previous);
/* Goes over from the plan `old` to another one of the same scene; streams and textures that both
 * list stay in place. On failure it can only be destroyed. */
bool lsf_scene_gpu_replan(lsf_scene_gpu *gpu, const lsf_plan *old, const lsf_plan *plan,
                          const lsf_state *state, const lsf_state *previous, lsf_error *error);
void lsf_scene_gpu_destroy(lsf_scene_gpu *gpu);

typedef enum lsf_draw_mode {
    LSF_DRAW_SHADING,      /* all streams; material textures are bound for each draw */
    LSF_DRAW_SEEN,         /* the same for what the camera sees: hidden back faces are culled */
    LSF_DRAW_POINTWISE,    /* the same, but textures give the nearest texel of the nearest level,
                            * for passes whose samples are spread at random */
    LSF_DRAW_TRANSMISSIVE, /* as for shading, only materials that transmit */
    LSF_DRAW_WALLS,        /* the same, only thin walls */
    LSF_DRAW_POSITIONS,    /* positions, and base colour textures where it is not opaque */
    LSF_DRAW_BUT_WALLS,    /* positions without thin walls that transmit */
    LSF_DRAW_OPAQUE,       /* positions without materials that let light straight through */
    LSF_DRAW_MASKED,       /* of the last, only materials that are not opaque */
} lsf_draw_mode;

/* Counts of what a pass has drawn since it was made. */
enum { LSF_DRAW_INSTANCES, LSF_DRAW_CULLED, LSF_DRAW_TRIANGLES, LSF_DRAW_COUNTS };
extern const char *const lsf_draw_count_names[LSF_DRAW_COUNTS];

/* Draws the part of every instance that may be inside `region` (NULL: all) with the bound
 * program and framebuffer, and adds to `counts` (LSF_DRAW_COUNTS of them). */
void lsf_scene_gpu_draw(const lsf_scene_gpu *gpu, const lsf_state *state, lsf_draw_mode mode,
                        const lsf_draw_region *region, uint64_t *counts);

/* Sets the uniforms of lib/environment.glsl in the program in use. */
void lsf_scene_gpu_bind_environment(const lsf_scene_gpu *gpu);

/* For passes that rasterise by themselves: a material in the form that shaders read; its
 * textures, bound as `mode` says; and draws of triangles that such a pass lists in `buffer`: a
 * DrawElementsIndirectCommand for each instance, and indices anywhere. */
struct lsf_material_data lsf_scene_gpu_material(const lsf_scene *scene, const lsf_material *m,
                                                uint32_t material);
void lsf_scene_gpu_bind_material(const lsf_scene_gpu *gpu, uint32_t material, lsf_draw_mode mode);
void lsf_scene_gpu_draw_listed(const lsf_scene_gpu *gpu, const lsf_state *state, GLuint buffer);

#endif
