#include "render_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "reference/module.h"

lsf_image *render_scene(const lsf_scene *scene, const lsf_render_params *params, uint32_t half,
                        uint32_t threads)
{
    static const char *const names[] = {
        "R",        "G",       "B",    "albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y",
        "normal.Z", "depth.Z", "e.R",  "e.G",      "e.B",      "d.R",      "d.G",      "d.B",
        "id.R",     "id.G",    "id.B", "is.R",     "is.G",     "is.B",     "A"};
    lsf_error error;
    lsf_state state = {0};
    lsf_view_params view = {
        .time = params->time,
        .camera = params->camera,
        .position = params->camera_position,
        .target = params->camera_target,
        .fov_y = params->fov_y,
        .aspect = (float)params->width / (float)params->height,
    };
    lsf_reference_job job = {
        .scene = scene,
        .state = &state,
        .params = params,
        .background = lsf_background_resolve(scene, params),
        .half = half,
        .threads = threads,
        .image = lsf_image_create(params->width, params->height, LSF_COUNT(names), names, &error),
        .channels = {0, 3, 6, 9, 10, 13, 16, 19, 22},
    };
    assert_non_null(job.image);
    if (!lsf_state_update(&state, scene, &view, &error) ||
        !lsf_reference_module_render(&job, &error))
        fail_msg("%s", error.message);
    lsf_state_finish(&state);
    return job.image;
}

void image_mean(const lsf_image *image, int first, double mean[3])
{
    uint64_t pixels = (uint64_t)image->width * image->height;
    memset(mean, 0, 3 * sizeof *mean);
    for (uint64_t i = 0; i < pixels; i++)
        for (int c = 0; c < 3; c++)
            mean[c] +=
                image->pixels[i * image->channel_count + (unsigned)(first + c)] / (double)pixels;
}

void render_point(const lsf_scene *scene, lsf_float3 eye, lsf_float3 target, uint32_t samples,
                  uint32_t bounces, float rgb[3])
{
    const float position[3] = {eye.x, eye.y, eye.z}, at[3] = {target.x, target.y, target.z};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.width = params.height = 1;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = position;
    params.camera_target = at;
    params.fov_y = 1e-3f;
    lsf_image *image = render_scene(scene, &params, 0, 0);
    memcpy(rgb, image->pixels, 3 * sizeof *rgb);
    lsf_image_destroy(image);
}
