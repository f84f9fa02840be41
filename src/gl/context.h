/* What the files of the GL layer share; passes include gl.h only. */
#ifndef LSF_GL_CONTEXT_H
#define LSF_GL_CONTEXT_H

#include "gl/gl.h"

/* One backend: how to make, bind and destroy a context, and where its functions are. */
typedef struct lsf_backend_ops {
    const char *name;
    void *(*create)(const lsf_context_params *params, lsf_error *error);
    void (*destroy)(void *platform);
    bool (*make_current)(void *platform, lsf_error *error);
    GLADapiproc (*get_proc_address)(void *platform, const char *name);
} lsf_backend_ops;

extern const lsf_backend_ops lsf_backend_egl, lsf_backend_osmesa, lsf_backend_glfw;

#endif
