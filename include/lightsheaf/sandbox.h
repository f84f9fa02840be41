/* A shader of one's own, run against the engine: it names what it wants to see of a scene, and
 * that alone is computed for it. docs/sandbox.md has the names. */
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
    const char *path; /* of the shader: .comp is a compute shader, all else a fragment shader. Its
                       * buffers, what is common to them, and files that it names lie beside it */
    const char *text; /* the shader itself, which messages call `path`; NULL: it is read */
    const char *const *channels; /* "[BUFFER:]N=SOURCE" as @channel has it, in place of what the
                                  * shader says; BUFFER is a, b, c or d */
    uint32_t channel_count;
    const char *const *uniforms; /* "name=value", or values separated by commas */
    uint32_t uniform_count;
    lsf_render_params render; /* size, camera, seed and options; technique and bounces of
                               * lsf_picture. The rest has no meaning here */
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
    /* For a channel "keyboard", by JavaScript's key codes: 1 while the key is down; 1 in the frame
     * in which it goes down; 1 every other time. NULL: no key is. */
    const uint8_t (*keys)[LSF_SANDBOX_KEYS];
    const lsf_view *view; /* NULL: the camera of lsf_render_params */
} lsf_sandbox_frame;

#define LSF_SANDBOX_FRAME_DEFAULTS                                                                 \
    .number = 0, .time = 0.0, .time_delta = 1.0 / 60.0, .mouse = {0}, .date = {0}, .keys = NULL,   \
    .view = NULL

/* Reads and compiles the shader, and makes what it names. `scene` NULL: there is none, and a shader
 * that names something of one is refused. Scene and context are borrowed and must outlive it.
 * LSF_ERROR_RENDER names the shader's file and line. */
lsf_sandbox *lsf_sandbox_create(lsf_context *context, const lsf_scene *scene,
                                const lsf_sandbox_params *params, lsf_error *error);
void lsf_sandbox_destroy(lsf_sandbox *sandbox); /* NULL allowed */

/* Whether a file that the shader was read from has changed, or is gone, since it was read. */
bool lsf_sandbox_changed(const lsf_sandbox *sandbox);
/* Reads the shader again. Buffers keep what is in them, uniforms their values. On failure the one
 * before goes on. */
bool lsf_sandbox_reload(lsf_sandbox *sandbox, lsf_error *error);
/* Makes pictures of another size. Buffers begin anew. */
bool lsf_sandbox_resize(lsf_sandbox *sandbox, uint32_t width, uint32_t height, lsf_error *error);
/* Buffers and previous frames become black. */
void lsf_sandbox_restart(lsf_sandbox *sandbox);

/* Runs one frame. */
bool lsf_sandbox_run(lsf_sandbox *sandbox, const lsf_sandbox_frame *frame, lsf_error *error);

/* A frame depends on those before it: it cannot be made without them. */
bool lsf_sandbox_feeds_back(const lsf_sandbox *sandbox);
/* The shader writes radiance, for tone mapping; otherwise what a display shows. */
bool lsf_sandbox_writes_radiance(const lsf_sandbox *sandbox);

/* The last frame: R, G and B as the shader wrote them. The caller destroys it. */
lsf_image *lsf_sandbox_read(lsf_sandbox *sandbox, lsf_error *error);
/* What a display shows of it: width * height * 3 bytes, rows from the top. Exposure (EV) and curve
 * count where the shader writes radiance. */
bool lsf_sandbox_read_rgb8(lsf_sandbox *sandbox, float exposure, lsf_tone_curve curve, uint8_t *rgb,
                           lsf_error *error);
/* The last frame's texture: RGBA32F, row 0 at the bottom; valid until the next frame. */
uint32_t lsf_sandbox_texture(const lsf_sandbox *sandbox);
/* Draws it into a framebuffer, scaled to `viewport`, as lsf_renderer_present does. */
bool lsf_sandbox_present(lsf_sandbox *sandbox, uint32_t framebuffer, const int32_t viewport[4],
                         float exposure, lsf_tone_curve curve, lsf_error *error);

/* A uniform that the shader declares itself. */
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

/* What is computed for the shader, and why. It lives until the next reload or size. */
const lsf_plan *lsf_sandbox_get_plan(const lsf_sandbox *sandbox);
/* The same without GL, and without compiling the shader; the caller destroys it. */
lsf_plan *lsf_sandbox_plan(const lsf_scene *scene, const lsf_sandbox_params *params,
                           lsf_error *error);

/* A name, or an annotation, that the sandbox gives a meaning to. */
typedef struct lsf_sandbox_name {
    const char *group; /* "uniform", "engine", "older", "annotation", "source" */
    const char *name;
    const char *use; /* as it is written */
    const char *help;
} lsf_sandbox_name;

/* All of them; false past the end. */
bool lsf_sandbox_list(uint32_t index, lsf_sandbox_name *name);

/* Pass times, as lsf_renderer_poll_times: of the shader's own passes. */
uint32_t lsf_sandbox_poll_times(lsf_sandbox *sandbox, const lsf_pass_time **times);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
