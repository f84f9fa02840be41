/* Scenes, pictures and contexts for the tests of embedding. */
#ifndef LSF_TESTS_EMBEDDING_RIG_H
#define LSF_TESTS_EMBEDDING_RIG_H

#include "gl/context.h"
#include "render_gl.h"

/* --- small pictures of a corner --- */

lsf_scene *rig_scene(float intensity);
lsf_render_params rig_params(const char *technique);
lsf_renderer *rig_renderer(lsf_context *context, const lsf_scene *scene, const char *technique);
void rig_run(lsf_renderer *renderer);
void rig_check_picture(lsf_renderer *renderer, const lsf_image *expected);
/* By a renderer and a context of its own. */
lsf_image *rig_alone(lsf_backend backend, const lsf_scene *scene, const char *technique);

/* --- another context --- */

/* The program's own context, which the library knows nothing of. */
typedef struct rig_foreign {
    const lsf_backend_ops *ops;
    void *platform;
    GladGLContext functions;
} rig_foreign;

/* Makes it current. */
rig_foreign rig_open_foreign(const lsf_backend_ops *ops);
void rig_close_foreign(rig_foreign *f);
/* The get_proc_address of its functions; `user` is the rig_foreign. */
GLADapiproc rig_foreign_function(void *user, const char *name);

#endif
