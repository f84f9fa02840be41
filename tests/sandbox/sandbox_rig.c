#include "sandbox_rig.h"

#include <math.h>

lsf_context *sandbox_context;

int sandbox_setup(void **state)
{
    (void)state;
    sandbox_context = gl_test_open(gl_test_backend(), NULL);
    return 0;
}

int sandbox_teardown(void **state)
{
    (void)state;
    lsf_context_destroy(sandbox_context);
    return 0;
}

lsf_sandbox_params sandbox_params(const char *text)
{
    lsf_sandbox_params params = {LSF_SANDBOX_PARAMS_DEFAULTS};
    params.path = "test.frag";
    params.text = text;
    params.render.width = params.render.height = 64;
    params.render.samples = 1;
    return params;
}

lsf_sandbox *sandbox_make(const lsf_scene *scene, const lsf_sandbox_params *params)
{
    lsf_error error = {0};
    if (!sandbox_context)
        skip();
    lsf_sandbox *sandbox = lsf_sandbox_create(sandbox_context, scene, params, &error);
    if (!sandbox)
        fail_msg("%s", error.message);
    return sandbox;
}

lsf_image *sandbox_picture(const lsf_scene *scene, const lsf_sandbox_params *params, uint32_t count)
{
    lsf_error error = {0};
    lsf_sandbox *sandbox = sandbox_make(scene, params);
    if (params->channel_count == 0 && !strstr(params->text, "noise"))
        assert_true(lsf_context_get_info(sandbox_context).gl_bytes >=
                    lsf_plan_bytes(lsf_sandbox_get_plan(sandbox)));
    for (uint32_t i = 0; i < count; i++) {
        lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
        frame.number = i;
        frame.time = i / 60.0;
        if (!lsf_sandbox_run(sandbox, &frame, &error))
            fail_msg("%s", error.message);
    }
    lsf_image *image = lsf_sandbox_read(sandbox, &error);
    if (!image)
        fail_msg("%s", error.message);
    lsf_sandbox_destroy(sandbox);
    assert_int_equal(lsf_context_get_info(sandbox_context).gl_bytes, 0);
    gl_test_check(sandbox_context);
    return image;
}

void sandbox_pixel(const lsf_scene *scene, const char *text, uint32_t count, uint32_t x, uint32_t y,
                   float rgb[3])
{
    const lsf_sandbox_params params = sandbox_params(text);
    lsf_image *image = sandbox_picture(scene, &params, count);
    memcpy(rgb, image->pixels + 3 * ((size_t)(image->height - 1 - y) * image->width + x),
           3 * sizeof *rgb);
    lsf_image_destroy(image);
}

void sandbox_assert_pixel(const lsf_scene *scene, const char *text, uint32_t count, uint32_t x,
                          uint32_t y, float r, float g, float b, float tolerance)
{
    const float expected[3] = {r, g, b};
    float rgb[3];
    sandbox_pixel(scene, text, count, x, y, rgb);
    for (int c = 0; c < 3; c++)
        if (!(fabsf(rgb[c] - expected[c]) <= tolerance))
            fail_msg("%s\n%g %g %g is not %g %g %g", text, (double)rgb[0], (double)rgb[1],
                     (double)rgb[2], (double)r, (double)g, (double)b);
}

void sandbox_refuse(const lsf_scene *scene, const lsf_sandbox_params *params, const char *says)
{
    lsf_error error = {0};
    if (!sandbox_context)
        skip();
    assert_null(lsf_sandbox_create(sandbox_context, scene, params, &error));
    if (strncmp(error.message, says, strlen(says)) != 0)
        fail_msg("'%s' does not begin with '%s'", error.message, says);
    assert_int_equal(lsf_context_get_info(sandbox_context).gl_bytes, 0);
}
