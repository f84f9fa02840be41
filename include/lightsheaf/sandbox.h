/* User shaders that run inside the engine: a shader names the data of a scene that it uses, and
 * only that is computed for it. docs/sandbox.md has the names. */
#ifndef LIGHTSHEAF_SANDBOX_H
#define LIGHTSHEAF_SANDBOX_H

#include <lightsheaf/renderer.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef struct lsf_sandbox lsf_sandbox;

typedef struct lsf_sandbox_params {
    const char *path; /* of the shader: .comp is a compute shader, everything else a fragment
                       * shader. Its buffers, the common file and included files lie beside it */
    const char *text; /* source of the shader, which messages call `path`; NULL: it is read from
                       * the file */
    const char *const *channels; /* "[BUFFER:]N=SOURCE" as in @channel, replacing the shader's
                                  * own; BUFFER is a, b, c or d */
    uint32_t channel_count;
    const char *const *uniforms; /* "name=value", or values separated by commas */
    uint32_t uniform_count;
    lsf_render_params render; /* size, camera, seed and options; technique and bounces of
                               * lsf_picture. The rest is ignored */
} lsf_sandbox_params;

#define LSF_SANDBOX_PARAMS_DEFAULTS                                                                \
    .path = NULL, .text = NULL, .channels = NULL, .channel_count = 0, .uniforms = NULL,            \
    .uniform_count = 0, .render = {LSF_RENDER_PARAMS_DEFAULTS}

#define LSF_SANDBOX_KEYS 256

typedef struct lsf_sandbox_frame {
    uint32_t number;   /* iFrame */
    double time;       /* iTime, and the time at which animations are sampled [s] */
    double time_delta; /* iTimeDelta [s] */
    float mouse[4];    /* iMouse [pixels from the lower left corner] */
    float date[4];     /* iDate */
    /* For a channel "keyboard", by JavaScript's key codes: 1 while the key is down; 1 in the
     * frame in which it goes down; toggles with each press. NULL: no keys. */
    const uint8_t (*keys)[LSF_SANDBOX_KEYS];
    const lsf_view *view; /* NULL: the camera of lsf_render_params */
} lsf_sandbox_frame;

#define LSF_SANDBOX_FRAME_DEFAULTS                                                                 \
    .number = 0, .time = 0.0, .time_delta = 1.0 / 60.0, .mouse = {0}, .date = {0}, .keys = NULL,   \
    .view = NULL

/* Reads and compiles the shader, and creates the data that it names. `scene` NULL: there is
 * none, and a shader that names data of one is refused. Scene and context are borrowed and must
 * outlive it. LSF_ERROR_RENDER names the shader's file and line. */
lsf_sandbox *lsf_sandbox_create(lsf_context *context, const lsf_scene *scene,
                                const lsf_sandbox_params *params, lsf_error *error);
void lsf_sandbox_destroy(lsf_sandbox *sandbox); /* NULL allowed */

/* Whether a file of the shader has changed, or was removed, since it was read. */
bool lsf_sandbox_changed(const lsf_sandbox *sandbox);
/* Reads the shader again. Buffers keep their content, uniforms their values. On failure the
 * previous shader stays in use. */
bool lsf_sandbox_reload(lsf_sandbox *sandbox, lsf_error *error);
/* Changes the size of pictures. Buffers are cleared. */
bool lsf_sandbox_resize(lsf_sandbox *sandbox, uint32_t width, uint32_t height, lsf_error *error);
/* Clears buffers and previous frames to black. */
void lsf_sandbox_restart(lsf_sandbox *sandbox);

/* Runs one frame. */
bool lsf_sandbox_run(lsf_sandbox *sandbox, const lsf_sandbox_frame *frame, lsf_error *error);

/* Whether a frame depends on earlier ones and cannot be rendered without them. */
bool lsf_sandbox_feeds_back(const lsf_sandbox *sandbox);
/* Whether the shader writes radiance, for tone mapping; otherwise it writes display values. */
bool lsf_sandbox_writes_radiance(const lsf_sandbox *sandbox);

/* The last frame: R, G and B as the shader wrote them. The caller destroys it. */
lsf_image *lsf_sandbox_read(lsf_sandbox *sandbox, lsf_error *error);
/* The last frame as display values: width * height * 3 bytes, rows from the top. Exposure (EV)
 * and curve are used where the shader writes radiance. */
bool lsf_sandbox_read_rgb8(lsf_sandbox *sandbox, float exposure, lsf_tone_curve curve, uint8_t *rgb,
                           lsf_error *error);
/* The last frame's texture: RGBA32F, row 0 at the bottom; valid until the next frame. */
uint32_t lsf_sandbox_texture(const lsf_sandbox *sandbox);
/* Draws the last frame into a framebuffer, scaled to `viewport`, as lsf_renderer_present does. */
bool lsf_sandbox_present(lsf_sandbox *sandbox, uint32_t framebuffer, const int32_t viewport[4],
                         float exposure, lsf_tone_curve curve, lsf_error *error);

/* A uniform that the shader itself declares. */
typedef struct lsf_sandbox_uniform {
    const char *name;
    uint32_t components;    /* 1 to 4 */
    bool integer;           /* int, uint or bool */
    bool slider;            /* it has a range: @slider */
    float minimum, maximum; /* of that */
    float value[4];
} lsf_sandbox_uniform;

/* The `index`-th; false past the end. The name is valid until the next reload. */
bool lsf_sandbox_get_uniform(const lsf_sandbox *sandbox, uint32_t index,
                             lsf_sandbox_uniform *uniform);
bool lsf_sandbox_set_uniform(lsf_sandbox *sandbox, const char *name, const float value[4],
                             lsf_error *error);

/* The plan of the data computed for the shader, with reasons. Valid until the next reload or
 * change of size. */
const lsf_plan *lsf_sandbox_get_plan(const lsf_sandbox *sandbox);
/* The same without GL, and without compiling the shader; the caller destroys it. */
lsf_plan *lsf_sandbox_plan(const lsf_scene *scene, const lsf_sandbox_params *params,
                           lsf_error *error);

/* A name, or an annotation, that the sandbox defines. */
typedef struct lsf_sandbox_name {
    const char *group; /* "uniform", "engine", "older", "annotation", "source" */
    const char *name;
    const char *use; /* as it is written */
    const char *help;
} lsf_sandbox_name;

/* All of them; false past the end. */
bool lsf_sandbox_list(uint32_t index, lsf_sandbox_name *name);

/* Times of the shader's own passes, as lsf_renderer_poll_times. */
uint32_t lsf_sandbox_poll_times(lsf_sandbox *sandbox, const lsf_pass_time **times);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
