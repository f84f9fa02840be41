#include "passes/specular_path.h"

#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "shared/scene_data.h"

/* Uniforms of passes/specular_path.frag.glsl. */
#define LOCATION_LENGTHS 0
#define LOCATION_ITERATION 1

const lsf_option_row lsf_specular_path_options[LSF_SPECULAR_PATH_OPTION_COUNT] = {
    {"specular_path.samples", LSF_OPTION_INT, offsetof(lsf_specular_path_params, samples), 0, 16,
     NULL, "paths",
     "most paths of a pixel that shows a medium or a narrow lobe, four times as many with cone; 0: "
     "light goes straight through media, and other samples gather all lobes"},
};

static const char emitter_name[] = "specular_path.emitters";

bool lsf_specular_path_media(const lsf_plan *plan, const lsf_specular_path_params *params)
{
    return plan->straight && plan->requirements.refractive && plan->bounces > 0 &&
           params->samples > 0;
}

bool lsf_specular_path_lobes(const lsf_plan *plan, const lsf_specular_path_params *params)
{
    return lsf_specular_path_media(plan, params) ||
           (plan->requirements.smooth_metal && plan->bounces > 0 && params->samples > 0);
}

void lsf_specular_path_plan(lsf_plan *plan, const lsf_specular_path_params *params,
                            const lsf_specular_path_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    uint32_t samples = (uint32_t)params->samples * use->factor;
    lsf_plan_pass_add(plan, "specular_path",
                      "up to %u path%s of each visible point of a medium or a narrow lobe", samples,
                      lsf_plural(samples));
    lsf_plan_reads(plan, "view points|gbuffer voxelize");
    lsf_plan_reads(plan, use->reads);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_interleave_switch(plan, use->interleave);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", true, "always");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", true, "always");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", plan->refracted, "there are media");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PATHS", use->lobes, "paths gather narrow lobes");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_voxel_specular_params_switch(plan);
    lsf_voxel_bend_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", r->anisotropic, "some material is anisotropic");
    lsf_scene_gpu_lobe_switches(plan, true);
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    bool emitters = use->bounces && r->emissive;
    lsf_plan_switch_add(plan, "LSF_EMITTERS", emitters, "some material emits, and paths bounce");
    if (emitters)
        lsf_emitter_points_plan(plan, emitter_name);
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", use->split_direct,
                        "direct light is asked for apart");
    lsf_scene_gpu_environment_switches(plan, "paths may leave the scene");
    lsf_plan_switch_add(plan, "LSF_VOXEL_MIRRORS", use->mirrors,
                        "smooth metals mirror what is around them");
    lsf_voxel_lamps_switch(plan, use->lamps);
    lsf_plan_switch_add(plan, "LSF_PATHS_BOUNCE", use->bounces,
                        "voxels are lit directly, and paths go on from all");
}

bool lsf_specular_path_create(lsf_specular_path *pass, lsf_context *context, const lsf_plan *plan,
                              const lsf_specular_path_params *params, uint32_t factor,
                              const lsf_specular_path_targets *targets, const lsf_scene *scene,
                              const lsf_state *state, lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/specular_path.frag.glsl"};
    *pass = (lsf_specular_path){
        .context = context,
        .samples = (uint32_t)params->samples * factor,
        .lobes = lsf_plan_switch_value(plan, "specular_path", "LSF_SPECULAR_PATHS"),
        .targets = targets->direct ? 2 : 1};
    if (lsf_plan_find(plan, emitter_name) &&
        !lsf_emitter_points_create(&pass->emitters, context, plan, emitter_name, scene, state,
                                   error))
        return false;
    lsf_framebuffer_desc desc = {.label = "specular_path",
                                 .color_count = pass->targets,
                                 .colors = {targets->specular, targets->direct},
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "specular_path", files, error);
    pass->timer = lsf_timer_create(context, "specular_path", error);
    return pass->framebuffer && pass->program && pass->timer;
}

bool lsf_specular_path_follow(lsf_specular_path *pass, bool materials_edited)
{
    return !pass->emitters.upload.buffer ||
           lsf_emitter_points_follow(&pass->emitters, materials_edited);
}

void lsf_specular_path_run(lsf_specular_path *pass, const lsf_iteration *iteration,
                           const lsf_path_inputs *inputs)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, grid->width, grid->layers * grid->height,
                         pass->program);
    lsf_blend_add(pass->targets);
    lsf_path_inputs_bind(inputs, iteration);
    /* Each crossing is a segment; as many as paths of light have that bounce as often. */
    glUniform2i(LOCATION_LENGTHS, (GLint)pass->samples, (GLint)iteration->plan->bounces + 1);
    if (pass->lobes)
        glUniform1f(LSF_LOCATION_SPECULAR_SHARE, pass->lobe_kernel);
    glUniform2ui(LOCATION_ITERATION, iteration->index,
                 lsf_iteration_seed(iteration, LSF_PURPOSE_SPECULAR_PATH));
    if (pass->emitters.upload.buffer) {
        lsf_emitter_points_draw(&pass->emitters, iteration, LSF_PURPOSE_SPECULAR_PATH_EMITTER);
        lsf_emitter_points_bind(&pass->emitters, 1);
    }
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_specular_path_destroy(lsf_specular_path *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_emitter_points_destroy(&pass->emitters, pass->context);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
