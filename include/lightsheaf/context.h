/* GL contexts: OpenGL 4.5 core, offscreen through EGL or OSMesa, in a window through GLFW, or
 * an application's own. */
#ifndef LIGHTSHEAF_CONTEXT_H
#define LIGHTSHEAF_CONTEXT_H

#include <stdbool.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef struct lsf_context lsf_context;

typedef enum lsf_backend {
    LSF_BACKEND_AUTO,   /* EGL on a GPU, else EGL in software, else OSMesa */
    LSF_BACKEND_EGL,    /* a GPU when there is one, else Mesa in software */
    LSF_BACKEND_OSMESA, /* Mesa in software, needs neither display nor device nodes */
    LSF_BACKEND_GLFW,   /* a window on a display */
} lsf_backend;

typedef struct lsf_context_params {
    lsf_backend backend;
    bool debug;            /* ask for a debug context: KHR_debug messages are synchronous */
    bool fail_on_gl_error; /* a GL error or high-severity message makes the next
                            * lsf_context_check fail; for tests */
    uint32_t window_width, window_height; /* pixels, GLFW only */
    const char *window_title;             /* GLFW only */
    /* Folder to read glsl/ from instead of the embedded copy; NULL: embedded. */
    const char *shader_dir;
} lsf_context_params;

#define LSF_CONTEXT_PARAMS_DEFAULTS                                                                \
    .backend = LSF_BACKEND_AUTO, .debug = false, .fail_on_gl_error = false, .window_width = 1280,  \
    .window_height = 720, .window_title = "Lightsheaf", .shader_dir = NULL

/* Makes a context and makes it current on the calling thread. `params` NULL means the defaults.
 * LSF_ERROR_NO_GL names what was tried and which package to install.
 *
 * Several contexts may live at once, on one thread or on several that render at the same time;
 * those in software take turns, an iteration each. A context, and what was made with it, is used by
 * one thread at a time: the one that made it, until lsf_context_release_current lets another take
 * it. Every function that needs a context makes it current and leaves it so: a program with a GL
 * context of its own on the same thread makes that current again. A thread that was given an OSMesa
 * context by the program itself has to release it before it uses an EGL one of the library: the two
 * do not know of each other. GLFW wants its windows made and destroyed on the main thread.
 *
 * The environment can decide what no option did: LIGHTSHEAF_BACKEND=egl|osmesa|glfw replaces
 * LSF_BACKEND_AUTO, and LIGHTSHEAF_EGL_LIBRARY, LIGHTSHEAF_OSMESA_LIBRARY and
 * LIGHTSHEAF_GLFW_LIBRARY name a library file to load in place of the system's, such as a Mesa of
 * one's own. */
lsf_context *lsf_context_create(const lsf_context_params *params, lsf_error *error);
void lsf_context_destroy(lsf_context *context); /* NULL allowed */

/* --- an application's own context --- */

typedef struct lsf_context_wrap_params {
    void (*(*get_proc_address)(void *user, const char *name))(void); /* of OpenGL's functions */
    bool (*make_current)(void *user); /* called at the start of each call; NULL: the application
                                       * keeps its context current */
    void *user;
    const char *shader_dir; /* as in lsf_context_params */
} lsf_context_wrap_params;

#define LSF_CONTEXT_WRAP_PARAMS_DEFAULTS                                                           \
    .get_proc_address = NULL, .make_current = NULL, .user = NULL, .shader_dir = NULL

/* Renders in a context that the application made: OpenGL 4.5 or later, core profile. The library's
 * objects live beside the application's until lsf_context_destroy, which leaves the context itself
 * to the application and comes before its end. What follows is agreed.
 *
 * On entry to a call, nothing of the context's state matters but this: conditional rendering is not
 * begun, transform feedback is not active unless paused (else LSF_ERROR_USAGE). Queries that are
 * begun count what the library draws. Errors that glGetError holds are lost.
 *
 * On return from a call that reaches GL, this state is as in a new context, whatever it was before:
 *   - switches (glEnable): all of OpenGL 4.5 but GL_DEBUG_OUTPUT and GL_DEBUG_OUTPUT_SYNCHRONOUS;
 *   - clip control, depth range, front face, cull face, polygon mode and offset, patch vertices,
 *     primitive restart index, provoking vertex, the hint on derivatives;
 *   - blending, color mask, depth function and mask, logic operation, stencil;
 *   - pixel storage (glPixelStore) but for blocks of compressed formats;
 *   - bindings: nothing is bound as a buffer (numbered bindings as well; those of transform
 *     feedback stay), texture, sampler, image, framebuffer, renderbuffer, vertex array, program or
 *     program pipeline, and texture unit 0 is active.
 * Viewport and scissor box are left undefined: set them. All other state of the context stays as it
 * was, and so does every object of the application that no call was told to change. Debug groups
 * are pushed and popped.
 *
 * Functions that the library calls back (lsf_progress, log handlers) make no GL calls. */
lsf_context *lsf_context_wrap(const lsf_context_wrap_params *params, lsf_error *error);

/* --- which context is current --- */

bool lsf_context_make_current(lsf_context *context, lsf_error *error);
/* Releases the context, so that another thread may use it; an application's own context has to
 * be released from this thread by the application. LSF_ERROR_USAGE where this thread was not the
 * last to use it. */
bool lsf_context_release_current(lsf_context *context, lsf_error *error);

/* Fails with LSF_ERROR_RENDER when the context was lost, or, with fail_on_gl_error, when any GL
 * error or high-severity message was seen since the last call. */
bool lsf_context_check(lsf_context *context, lsf_error *error);

typedef struct lsf_context_info {
    const char *backend;                     /* "egl", "osmesa", "glfw", "application" */
    const char *vendor, *renderer, *version; /* GL strings */
    bool software;                           /* llvmpipe or softpipe */
    bool robust;                             /* reset notification is available */
    uint64_t gl_bytes; /* bytes of live textures, renderbuffers and buffers asked for */
    uint64_t gl_bytes_peak;
} lsf_context_info;

/* The strings live as long as the context. */
lsf_context_info lsf_context_get_info(const lsf_context *context);
/* Restarts gl_bytes_peak: it is the maximum since this call. */
void lsf_context_restart_peak(lsf_context *context);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
