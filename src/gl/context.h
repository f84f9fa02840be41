/* Declarations that the files of the GL layer share; passes include gl.h only. */
#ifndef LSF_GL_CONTEXT_H
#define LSF_GL_CONTEXT_H

#include "base/base.h"
#include "gl/gl.h"
#include "gl/shader_source.h"

/* --- backends --- */

/* One backend: how to make, bind and destroy a context, and where its functions are. Each loads
 * its library with dlopen, so that the program starts without any of them installed. */
typedef struct lsf_backend_ops {
    const char *name;
    /* Makes an OpenGL 4.5 core context and makes it current. On failure `error` says what was
     * tried and why it failed, without advice: the caller adds which packages to install. */
    void *(*create)(const lsf_context_params *params, lsf_error *error);
    void (*destroy)(void *platform); /* the context is not current any more */
    bool (*make_current)(void *platform, lsf_error *error);
    bool (*is_current)(void *platform); /* on this thread, as the platform says */
    void (*release)(void *platform);    /* after this call no context of this backend is current */
    GLADapiproc (*get_proc_address)(void *platform, const char *name);
} lsf_backend_ops;

extern const lsf_backend_ops lsf_backend_egl, lsf_backend_osmesa, lsf_backend_glfw,
    lsf_backend_wrap;

/* Opens the first of `names` (NULL-terminated) that loads, or only the file that the environment
 * variable `variable` names. Never closed again: drivers do not survive being unloaded. */
void *lsf_library_open(const char *variable, const char *const *names, lsf_error *error);

/* --- the context --- */

typedef struct lsf_allocation {
    GLenum kind; /* GL_TEXTURE or GL_BUFFER */
    GLuint name;
    uint64_t bytes;
} lsf_allocation;

typedef struct lsf_cached_program {
    uint64_t key;
    GLuint program;
} lsf_cached_program;

/* Numbers of indexed bindings that the device has. */
typedef struct lsf_binding_counts {
    GLint textures, images, atomic_counter_buffers, shader_storage_buffers, uniform_buffers;
} lsf_binding_counts;

#define LSF_GROUP_DEPTH_MAX 16

/* A thread's turn among those that use software contexts, in the order of their asking. Turns nest.
 */
void lsf_turn_begin(void);
void lsf_turn_end(void);

struct lsf_context {
    const lsf_backend_ops *ops;
    void *platform;
    GladGLContext functions;
    bool wrapped;              /* the application's */
    lsf_binding_counts counts; /* of a wrapped one */
    uint32_t entered;          /* functions in progress: lsf_context_enter */
    char *vendor, *renderer, *version;
    bool software, robust;
    char *shader_dir; /* NULL: the embedded files */

    lsf_error failure; /* lsf_context_fail; code 0: none */
    bool fail_on_gl_error;
    bool error_expected; /* an allocation is being tried: its caller reports the failure */
    bool error_seen;
    char first_error[512];

    const char *groups[LSF_GROUP_DEPTH_MAX]; /* names of the open pass groups, for messages */
    uint32_t group_count;

    uint64_t gl_bytes, gl_bytes_peak;
    lsf_allocation *allocations;
    uint64_t allocation_count, allocation_capacity;
    uint64_t fail_countdown; /* lsf_context_fail_allocation; 0: off */

    lsf_cached_program *programs;
    uint64_t program_count, program_capacity;
    GLuint empty_vertex_array;
    bool slots_settled; /* the state of software GL's sampler slots: buffer_texture.c */
};

/* --- state --- */

/* Sets the state that every pass relies on and none changes. */
void lsf_state_set_conventions(void);
/* Sets all state that passes rely on or change to what GL gives a new context. */
void lsf_state_reset(const lsf_context *context);
void lsf_state_count_bindings(lsf_context *context);

/* --- messages --- */

/* Sends the current context's KHR_debug messages to the log. */
void lsf_debug_install(lsf_context *context, bool debug);
/* Moves the errors that glGetError holds into the context's record; returns the first of them. */
GLenum lsf_debug_take_errors(lsf_context *context);
const char *lsf_gl_error_name(GLenum code);
/* Labels an object for debuggers; cut to what KHR_debug guarantees. */
void lsf_debug_label(GLenum identifier, GLuint name, const char *label);
void lsf_debug_push_group(lsf_context *context, const char *name);
void lsf_debug_pop_group(lsf_context *context);

/* --- memory --- */

/* Brackets the GL calls of one allocation. `begin` fails when a test asked for that; `end` fails
 * when GL reported an error, and else counts the bytes. `what` describes the object in errors. */
bool lsf_memory_begin(lsf_context *context, const char *what, lsf_error *error);
bool lsf_memory_end(lsf_context *context, GLenum kind, GLuint name, uint64_t bytes,
                    const char *what, lsf_error *error);
void lsf_memory_forget(lsf_context *context, GLenum kind, GLuint name);

#endif
