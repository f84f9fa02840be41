/* GL contexts: OpenGL 4.5 core, offscreen through EGL or OSMesa, or in a window through GLFW. */
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
    bool debug;             /* ask for a debug context: KHR_debug messages are synchronous */
    bool fail_on_gl_error;  /* a GL error or high-severity message makes the next
                             * lsf_context_check fail; for tests */
    uint32_t window_width, window_height; /* pixels, GLFW only */
    const char *window_title;             /* GLFW only */
    const char *shader_dir; /* read glsl/ from this folder instead of the embedded copy; NULL: embedded */
} lsf_context_params;

#define LSF_CONTEXT_PARAMS_DEFAULTS                                                       \
    .backend = LSF_BACKEND_AUTO, .debug = false, .fail_on_gl_error = false,               \
    .window_width = 1280, .window_height = 720, .window_title = "Lightsheaf", .shader_dir = NULL

/* Makes a context and makes it current on the calling thread. `params` NULL means the defaults.
 * LSF_ERROR_NO_GL names what was tried and which package to install.
 *
 * Several contexts may live at once, on one thread or on several that render at the same time. A
 * context, and what was made with it, is used by one thread at a time: the one that made it, until
 * lsf_context_release_current lets another take it. Every function that needs a context makes it
 * current and leaves it so: a program with a GL context of its own on the same thread makes that
 * current again. A thread that was given an OSMesa context by the program itself has to release it
 * before it uses an EGL one of the library: the two do not know of each other. GLFW wants its
 * windows made and destroyed on the main thread.
 *
 * The environment can decide what no option did: LIGHTSHEAF_BACKEND=egl|osmesa|glfw replaces
 * LSF_BACKEND_AUTO, and LIGHTSHEAF_EGL_LIBRARY, LIGHTSHEAF_OSMESA_LIBRARY and
 * LIGHTSHEAF_GLFW_LIBRARY name a library file to load in place of the system's, such as a Mesa of
 * one's own. */
lsf_context *lsf_context_create(const lsf_context_params *params, lsf_error *error);
void lsf_context_destroy(lsf_context *context); /* NULL allowed */

bool lsf_context_make_current(lsf_context *context, lsf_error *error);
/* Then another thread may use it. LSF_ERROR_USAGE where this thread did not use it last. */
bool lsf_context_release_current(lsf_context *context, lsf_error *error);

/* Fails with LSF_ERROR_RENDER when the context was lost, or, with fail_on_gl_error, when any GL
 * error or high-severity message was seen since the last call. */
bool lsf_context_check(lsf_context *context, lsf_error *error);

typedef struct lsf_context_info {
    const char *backend;  /* "egl", "osmesa", "glfw" */
    const char *vendor, *renderer, *version; /* GL strings */
    bool software;        /* llvmpipe or softpipe */
    bool robust;          /* reset notification is available */
    uint64_t gl_bytes;      /* bytes of live textures, renderbuffers and buffers asked for */
    uint64_t gl_bytes_peak;
} lsf_context_info;

/* The strings live as long as the context. */
lsf_context_info lsf_context_get_info(const lsf_context *context);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
