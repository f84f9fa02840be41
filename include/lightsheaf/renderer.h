/* Rendering: a technique on a scene, from a frame plan, by iterations that converge. */
#ifndef LIGHTSHEAF_RENDERER_H
#define LIGHTSHEAF_RENDERER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/context.h>
#include <lightsheaf/error.h>
#include <lightsheaf/image.h>
#include <lightsheaf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

/* Arbitrary output variables: layers beside the picture's R, G, B. */
typedef enum lsf_aov {
    LSF_AOV_ALBEDO = 1 << 0,   /* albedo.R .G .B: base colour, 0..1 */
    LSF_AOV_NORMAL = 1 << 1,   /* normal.X .Y .Z: shading normal, scene space, towards the viewer */
    LSF_AOV_DEPTH = 1 << 2,    /* depth.Z: distance along the view axis, scene units, first
                                * iteration; infinity where there is no surface */
    LSF_AOV_EMISSION = 1 << 3, /* emission.R .G .B: emitted radiance of visible surfaces */
    LSF_AOV_DIRECT = 1 << 4,   /* direct.R .G .B: reflected direct light */
    LSF_AOV_INDIRECT_DIFFUSE = 1 << 5,  /* indirect_diffuse.R .G .B */
    LSF_AOV_INDIRECT_SPECULAR = 1 << 6, /* indirect_specular.R .G .B */
    LSF_AOV_MOTION = 1 << 7,            /* motion.X .Y: pixels from the previous frame's position */
    /* The voxels of a voxel technique; black with others. */
    LSF_AOV_VOXEL_ALBEDO = 1 << 8,   /* voxel_albedo.R .G .B */
    LSF_AOV_VOXEL_NORMAL = 1 << 9,   /* voxel_normal.X .Y .Z: scene space, towards the viewer */
    LSF_AOV_VOXEL_RADIANCE = 1 << 10 /* voxel_radiance.R .G .B: of the visible side */
} lsf_aov;
#define LSF_AOV_COUNT 11
#define LSF_AOV_ALL (LSF_AOV_VOXEL_ALBEDO - 1) /* all except those of voxels */

/* "albedo", "normal", ... ; 0 when unknown. */
uint32_t lsf_aov_from_name(const char *name);
/* The name of the AOV that is the lowest set bit of `aovs`. */
const char *lsf_aov_name(uint32_t aovs);

/* The background behind all surfaces; the scene is lit by the environment in any case. */
typedef enum lsf_background {
    LSF_BACKGROUND_AUTO, /* the environment, or middle grey in front of the default sky */
    LSF_BACKGROUND_ENVIRONMENT,
    LSF_BACKGROUND_UNIFORM,     /* lsf_render_params.background_radiance */
    LSF_BACKGROUND_TRANSPARENT, /* none: R, G and B are those of surfaces alone, premultiplied by
                                 * the share of the pixel that they cover, which is channel A */
} lsf_background;

/* A camera placed by the program. */
typedef struct lsf_view {
    double position[3]; /* scene units */
    float forward[3];   /* viewing direction; any length */
    float up[3];        /* upwards in the picture, not along `forward`; any length */
    float fov_y;        /* degrees, of a perspective camera */
    float height;       /* of the visible region, scene units: makes it orthographic; else 0 */
    float near_plane;   /* scene units; 0: a thousandth of the scene's half extent */
} lsf_view;

/* Called between iterations, and within long ones about ten times a second: `done` of `total`
 * iterations. Return false to stop early: an iteration in progress is dropped, so that there may
 * be no picture yet. It must make no GL calls. */
typedef bool (*lsf_progress)(uint32_t done, uint32_t total, void *user);

/* The number of bounces that the scene needs: lsf_requirements.bounces. */
#define LSF_BOUNCES_AUTO UINT32_MAX
#define LSF_BOUNCES_MAX 1000u

typedef struct lsf_render_params {
    const char *technique;  /* see lsf_technique_name */
    uint32_t width, height; /* pixels */
    uint32_t samples;       /* iterations; UINT32_MAX: as many as the time limit allows */
    double time_limit;      /* seconds of rendering, without those in which software OpenGL
                             * compiles shaders; iterations that exceed it are dropped, or not
                             * begun if they would, except the first; infinity: none */
    uint32_t bounces;       /* indirect bounces; 0: direct light only; at most LSF_BOUNCES_MAX,
                             * or LSF_BOUNCES_AUTO */
    uint64_t seed;
    const char *camera;           /* name or index; NULL: the first */
    const float *camera_position; /* three floats in scene units; NULL: that of the camera */
    const float *camera_target;   /* three floats in scene units; NULL: that of the camera */
    float fov_y;                  /* degrees, replaces the camera's; NAN: that of the camera */
    lsf_background background;
    float background_radiance[3];
    double time;   /* seconds, at which animations are sampled */
    uint32_t aovs; /* lsf_aov bits */
    bool raw;      /* the plain mean of iterations: not filtered, and neighbouring pixels use the
                    * same samples unless options say otherwise */
    bool temporal; /* reuse light of earlier frames: each frame then depends on them, and one in
                    * which nothing has changed continues the mean of the one before. Not with
                    * `raw` */
    bool rgb8;     /* lsf_renderer_read_rgb8 will be called */
    bool present;  /* lsf_renderer_present will be called */
    const char *const *options; /* "pass.key=value", see lsf_option_list */
    uint32_t option_count;
    lsf_progress progress; /* NULL: none */
    void *progress_user;
} lsf_render_params;

#define LSF_RENDER_PARAMS_DEFAULTS                                                                 \
    .technique = "bidirectional", .width = 1024, .height = 768, .samples = 64,                     \
    .time_limit = 1.0 / 0.0, .bounces = LSF_BOUNCES_AUTO, .seed = 0, .camera = NULL,               \
    .camera_position = NULL, .camera_target = NULL, .fov_y = 0.0f / 0.0f,                          \
    .background = LSF_BACKGROUND_AUTO, .background_radiance = {0}, .time = 0.0, .aovs = 0,         \
    .raw = false, .temporal = false, .rgb8 = false, .present = false, .options = NULL,             \
    .option_count = 0, .progress = NULL, .progress_user = NULL

/* The view of the camera that these parameters select, at their time; a starting point for a
 * program's own camera. LSF_ERROR_USAGE where there is no such camera. */
bool lsf_render_params_view(const lsf_scene *scene, const lsf_render_params *params, lsf_view *view,
                            lsf_error *error);

/* Registered techniques; NULL past the end. */
const char *lsf_technique_name(uint32_t index);
const char *lsf_technique_help(uint32_t index);

/* One option of a pass, as "-D pass.key=value" takes it. */
typedef struct lsf_option {
    const char *key;   /* "shadow.filter" */
    const char *type;  /* "int", "float", "bool", "enum" */
    const char *range; /* "1..16384", "none|pcf" */
    const char *value; /* default */
    const char *unit;  /* "texels", "" */
    const char *help;
} lsf_option;

/* All options of all passes; false past the end. */
bool lsf_option_list(uint32_t index, lsf_option *option);
/* The replacement of an option of earlier versions; NULL: there was none with that key. */
const char *lsf_option_replaced(const char *key);
/* Whether an option with that key can affect the technique. */
bool lsf_technique_takes(const char *technique, const char *key);

/* The frame plan: the passes in order, each resource with its bytes, each shader's switches, and
 * why each is there or was left out. Needs no GL, and takes OpenGL to be software: where a time
 * limit is short, a renderer on a GPU samples more points and voxels. */
typedef struct lsf_plan lsf_plan;

lsf_plan *lsf_plan_create(const lsf_scene *scene, const lsf_render_params *params,
                          lsf_error *error);
void lsf_plan_destroy(lsf_plan *plan);           /* NULL allowed */
uint64_t lsf_plan_bytes(const lsf_plan *plan);   /* GL bytes of all resources */
uint32_t lsf_plan_bounces(const lsf_plan *plan); /* indirect ones; 0: the technique has none */
/* The file of the denoiser's weights; NULL: there is no denoiser, or it has the library's own. */
const char *lsf_plan_weights(const lsf_plan *plan);
char *lsf_plan_describe(const lsf_plan *plan, bool json); /* malloc'ed; NULL without memory */
/* Passes in order, the resources that they fill and read, bytes and switches that are on, as a
 * graph for Graphviz. malloc'ed; NULL without memory. */
char *lsf_plan_dot(const lsf_plan *plan);

typedef struct lsf_price_list {
    char **names;
    uint32_t count;
    uint64_t capacity;
} lsf_price_list;

/* The difference of two plans, such as the plan of the scene and that of lsf_scene_without. */
typedef struct lsf_price {
    int64_t bytes;                              /* additional bytes of OpenGL memory */
    lsf_price_list passes, switches, resources; /* a switch is written as its pass, a blank and
                                                 * its name */
} lsf_price;

/* `price` needs no initialisation; call lsf_price_finish after success. */
bool lsf_plan_price(const lsf_plan *with, const lsf_plan *without, lsf_price *price,
                    lsf_error *error);
void lsf_price_finish(lsf_price *price);

/* A renderer owns all GL objects in the plan and no others. The scene and the context are
 * borrowed and must outlive it. */
typedef struct lsf_renderer lsf_renderer;

lsf_renderer *lsf_renderer_create(lsf_context *context, const lsf_scene *scene,
                                  const lsf_render_params *params, lsf_error *error);
void lsf_renderer_destroy(lsf_renderer *renderer); /* NULL allowed */
const lsf_plan *lsf_renderer_plan(const lsf_renderer *renderer);

/* Parameters that may differ from frame to frame. Edits of the scene (edit.h) since the previous
 * frame take effect as well. */
typedef struct lsf_frame {
    double time;           /* seconds, where animations are sampled */
    const lsf_view *view;  /* NULL: the camera of lsf_render_params */
    uint32_t first_sample; /* its iterations use the random numbers of this sample and the
                            * following ones. A frame depends on no other property of earlier
                            * frames: it has the same bits as in a new renderer. With
                            * lsf_render_params.temporal this is used for the first frame and
                            * after a cut alone: the others continue with the numbers that follow */
    bool cut; /* motion is measured as in a new renderer, not from the previous frame, and no
               * light is reused */
} lsf_frame;

#define LSF_FRAME_DEFAULTS .time = 0.0, .view = NULL, .first_sample = 0, .cut = false

/* Begins a frame: the mean starts anew, and lsf_renderer_iterate or lsf_renderer_run follow.
 * Where the scene's requirements are unchanged, nothing of GL is allocated, compiled or waited
 * for; otherwise there is a new plan (lsf_renderer_plan), and resources that fit it are kept.
 * After LSF_ERROR_USAGE (an invalid view or time) the previous frame is still the one in
 * progress; after LSF_ERROR_RENDER there is none. A new renderer is in the frame of its
 * lsf_render_params, at first_sample 0. */
bool lsf_renderer_begin_frame(lsf_renderer *renderer, const lsf_frame *frame, lsf_error *error);
/* Changes the size of pictures, from a new frame on. */
bool lsf_renderer_resize(lsf_renderer *renderer, uint32_t width, uint32_t height,
                         const lsf_frame *frame, lsf_error *error);

/* Changes the parameters: another technique, options, layers, size or camera, whose pictures
 * have the same bits as those of a new renderer; it is in their frame, at first_sample 0.
 * Vertices and textures stay on the GPU, unless tessellation.factor changes; where only camera,
 * time, limit and progress change, everything does. After LSF_ERROR_USAGE the previous
 * parameters are still in use; after LSF_ERROR_RENDER there is no frame. */
bool lsf_renderer_change(lsf_renderer *renderer, const lsf_render_params *params, lsf_error *error);

/* Runs one iteration and adds it to the running mean. Allocates nothing and does not
 * synchronise. */
bool lsf_renderer_iterate(lsf_renderer *renderer, lsf_error *error);
/* Runs params->samples iterations, within the time limit, calling params->progress. */
bool lsf_renderer_run(lsf_renderer *renderer, lsf_error *error);

/* Reads the mean so far: R, G, B and the layers of params->aovs. The caller destroys it. */
lsf_image *lsf_renderer_read(lsf_renderer *renderer, lsf_error *error);
/* Reads the picture (aov 0) or a layer of params->aovs into the program's memory: as many floats
 * per pixel as lsf_aov names channels, rows from the top, `row_bytes` apart. */
bool lsf_renderer_read_into(lsf_renderer *renderer, uint32_t aov, float *pixels, size_t row_bytes,
                            lsf_error *error);
/* Reads R, G, B tone-mapped on the GPU to 8-bit sRGB: width * height * 3 bytes into `rgb`,
 * rows from the top. `exposure` in EV. LSF_ERROR_USAGE unless params->rgb8 was set. */
bool lsf_renderer_read_rgb8(lsf_renderer *renderer, float exposure, lsf_tone_curve curve,
                            uint8_t *rgb, lsf_error *error);

/* --- pictures that stay on the GPU, for a program that shares the context (lsf_context_wrap) ---
 */

/* The texture of the mean so far, for the picture (aov 0) or a layer of params->aovs: RGBA32F,
 * row 0 at the bottom, the picture linear. 0 where there is none. The renderer owns it: it is
 * valid until the next frame, change of size or destruction, and changed by the next iteration. */
uint32_t lsf_renderer_texture(lsf_renderer *renderer, uint32_t aov, lsf_error *error);
/* Draws the mean so far, tone-mapped to sRGB code values, into a framebuffer (0: the window's),
 * scaled to `viewport`: x, y, width and height in pixels from its lower left corner. `exposure` in
 * EV. LSF_ERROR_USAGE unless params->present was set. */
bool lsf_renderer_present(lsf_renderer *renderer, uint32_t framebuffer, const int32_t viewport[4],
                          float exposure, lsf_tone_curve curve, lsf_error *error);

typedef struct lsf_pass_stats {
    const char *name;
    uint64_t runs;
    double milliseconds;  /* mean per iteration under the plan in use */
    uint32_t count_count; /* counters of the pass, by name */
    const char *const *count_names;
    const uint64_t *counts;
} lsf_pass_stats;

typedef struct lsf_renderer_stats {
    uint32_t samples; /* iterations done in this frame, and with lsf_render_params.temporal in
                       * earlier frames whose mean it continues */
    double compile_seconds, upload_seconds, render_seconds;
    double lost_share;    /* share of the picture's luminance that an option such as
                           * bidirectional.bound removed, 0..1 */
    uint64_t lost_pixels; /* pixels that are not finite */
    uint32_t pass_count;
    const lsf_pass_stats *passes; /* owned by the renderer, valid until the next call */
} lsf_renderer_stats;

/* Statistics over everything rendered under the current plan. Waits for the GPU, and reads the
 * picture. */
lsf_renderer_stats lsf_renderer_get_stats(lsf_renderer *renderer);

/* Runs of a pass that have finished since the last call. */
typedef struct lsf_pass_time {
    const char *name;
    uint64_t runs;
    double milliseconds; /* total of these runs */
} lsf_pass_time;

/* Points `times` to the passes' runs that have finished since the last call, possibly none, and
 * returns the number of passes: for a program that calls it in each frame. It neither waits nor
 * reads pixels. GPUs lag some frames behind; software OpenGL, whose timers block, does not.
 * Valid until the next call; 0 where no frame is in progress. */
uint32_t lsf_renderer_poll_times(lsf_renderer *renderer, const lsf_pass_time **times);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
