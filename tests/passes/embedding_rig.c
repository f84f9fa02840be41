/* Scenes, pictures and contexts for the tests of embedding. */
#include "embedding_rig.h"

enum { SIZE = 24 };

lsf_scene *rig_scene(float intensity)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), intensity);
    finish_gl_scene(scene);
    return scene;
}

lsf_render_params rig_params(const char *technique)
{
    static const char *const options[] = {"voxel.resolution=32", "rsm.resolution=32",
                                          "cloud.count=8192", "vpl.shadow_resolution=32",
                                          "bundle.resolution=32"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
    params.technique = technique;
    params.samples = 2;
    params.options = options;
    params.option_count = 5;
    return corner_params(params, SIZE);
}

lsf_renderer *rig_renderer(lsf_context *context, const lsf_scene *scene, const char *technique)
{
    lsf_error error = {0};
    const lsf_render_params params = rig_params(technique);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

void rig_run(lsf_renderer *renderer)
{
    lsf_error error = {0};
    if (!lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
}

void rig_check_picture(lsf_renderer *renderer, const lsf_image *expected)
{
    lsf_error error = {0};
    lsf_image *image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    assert_same_pixels(image, expected);
    lsf_image_destroy(image);
}

lsf_image *rig_alone(lsf_backend backend, const lsf_scene *scene, const char *technique)
{
    const lsf_render_params params = rig_params(technique);
    return render_gl(backend, scene, &params);
}

GLADapiproc rig_foreign_function(void *user, const char *name)
{
    const rig_foreign *f = user;
    return f->ops->get_proc_address(f->platform, name);
}

rig_foreign rig_open_foreign(const lsf_backend_ops *ops)
{
    lsf_error error = {0};
    const lsf_context_params params = {LSF_CONTEXT_PARAMS_DEFAULTS};
    rig_foreign f = {.ops = ops, .platform = ops->create(&params, &error)};
    if (!f.platform)
        fail_msg("%s", error.message);
    assert_int_not_equal(gladLoadGLContextUserPtr(&f.functions, rig_foreign_function, &f), 0);
    return f;
}

void rig_close_foreign(rig_foreign *f)
{
    if (f->ops->is_current(f->platform))
        f->ops->release(f->platform);
    f->ops->destroy(f->platform);
}
