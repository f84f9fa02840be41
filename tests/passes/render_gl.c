#include "render_gl.h"

#include <math.h>

lsf_image *render_gl(lsf_backend backend, const lsf_scene *scene, const lsf_render_params *params)
{
    lsf_error error = {0};
    lsf_context *context = gl_test_context(backend, NULL);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    /* Rendering asked GL for what the plan lists, byte for byte. */
    assert_int_equal(lsf_context_get_info(context).gl_bytes,
                     lsf_plan_bytes(lsf_renderer_plan(renderer)));
    lsf_image *image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    lsf_renderer_destroy(renderer);
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    gl_test_check(context);
    lsf_context_destroy(context);
    return image;
}

void render_gl_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                     float rgb[3])
{
    const float position[3] = {eye.x, eye.y, eye.z}, at[3] = {target.x, target.y, target.z};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = "direct";
    params.width = params.height = 1;
    params.samples = samples;
    params.camera_position = position;
    params.camera_target = at;
    params.fov_y = 1e-3f;
    lsf_image *image = render_gl(LSF_BACKEND_OSMESA, scene, &params);
    memcpy(rgb, image->pixels, 3 * sizeof *rgb);
    lsf_image_destroy(image);
}

void finish_gl_scene(lsf_scene *scene)
{
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
}
