#include "spied_pictures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/base.h"
#include "net_rig.h"

enum { SIZE = 16 };

static lsf_scene *rich_scene(void)
{
    lsf_scene *scene = build_scene();
    build_lit_corner(scene);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    return scene;
}

static const struct spied_picture {
    const char *technique;
    bool raw, temporal;
    uint32_t aovs;
    const char *options[3];
} cases[] = {
    {"direct", .aovs = LSF_AOV_NORMAL | LSF_AOV_MOTION},
    {"bidirectional", .aovs = LSF_AOV_DIRECT},
    {"bidirectional", .temporal = true},
    {"bidirectional", .options = {"bundle.window=visible"}},
    {"bidirectional", .raw = true, .options = {"interleave.size=2", "sparse.blur=1"}},
    {"bidirectional", .options = {"sparse.grid=4", "interleave.size=2"}},
    {"bidirectional", .raw = true, .options = {"rsm.pdf=adaptive", "bidirectional.strategy=vpl"}},
    {"voxel_path", .aovs = LSF_AOV_VOXEL_ALBEDO, .options = {"sparse.grid=2"}},
    {"voxel_path", .raw = true, .options = {"voxel.method=raster", "environment.directions=0"}},
    {"cone", .options = {"sparse.grid=2", "sparse.blur=1"}},
    {"cone", .raw = true, .options = {"cone.sealed=off", "sparse.outliers=on"}},
    {"cone", .temporal = true,
     .options = {"light_filter.kind=network", "denoise.processor=gl",
                 "temporal.denoised_frames=4"}},
    {"substitute_tree", .options = {"sparse.grid=2", "cloud.count=8192"}},
    {"substitute_tree", .raw = true, .options = {"rsm.pdf=adaptive", "cloud.count=8192"}},
};

static void render(const struct spied_picture *c, void (*start)(void),
                   void (*end)(const lsf_renderer *renderer))
{
    const char *options[] = {
        "voxel.resolution=32",  "rsm.resolution=32", "vpl.shadow_resolution=32",
        "bundle.resolution=32", c->options[0],       c->options[1],
        c->options[2]};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = c->technique;
    params.samples = 2;
    params.raw = c->raw;
    params.temporal = c->temporal;
    params.aovs = c->aovs;
    params.options = options;
    params.option_count =
        4u + (c->options[0] != NULL) + (c->options[1] != NULL) + (c->options[2] != NULL);
    params = corner_params(params, SIZE);
    lsf_scene *scene = rich_scene();
    lsf_error error = {0};
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    start();
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    end(renderer);
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

void spy_on_pictures(void (*start)(void), void (*end)(const lsf_renderer *renderer))
{
    char path[64];
    snprintf(path, sizeof path, "/tmp/lightsheaf-spied-%d.lsfd", (int)getpid());
    net_rig_write(path, 2, 0.0f, 1.0f, 1.0f, 1);
    setenv("LIGHTSHEAF_DENOISER_WEIGHTS", path, 1);
    for (size_t i = 0; i < LSF_COUNT(cases); i++)
        render(&cases[i], start, end);
    unlink(path);
}
