#include "techniques/setup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "passes/accumulate.h"
#include "passes/tonemap.h"
#include "scene/tessellate.h"

static const struct {
    uint32_t bit;
    const char *name;
} aov_names[] = {
    {LSF_AOV_ALBEDO, "albedo"},
    {LSF_AOV_NORMAL, "normal"},
    {LSF_AOV_DEPTH, "depth"},
    {LSF_AOV_EMISSION, "emission"},
    {LSF_AOV_DIRECT, "direct"},
    {LSF_AOV_INDIRECT_DIFFUSE, "indirect_diffuse"},
    {LSF_AOV_INDIRECT_SPECULAR, "indirect_specular"},
    {LSF_AOV_MOTION, "motion"},
    {LSF_AOV_VOXEL_ALBEDO, "voxel_albedo"},
    {LSF_AOV_VOXEL_NORMAL, "voxel_normal"},
    {LSF_AOV_VOXEL_RADIANCE, "voxel_radiance"},
};

uint32_t lsf_aov_from_name(const char *name)
{
    for (size_t i = 0; i < LSF_COUNT(aov_names); i++)
        if (strcmp(aov_names[i].name, name) == 0)
            return aov_names[i].bit;
    return 0;
}

const char *lsf_aov_name(uint32_t aovs)
{
    for (size_t i = 0; i < LSF_COUNT(aov_names); i++)
        if (aovs & aov_names[i].bit)
            return aov_names[i].name;
    return NULL;
}

static bool check_params(const lsf_render_params *params, lsf_error *error)
{
    if (params->width == 0 || params->height == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "resolution %u,%u: both must be at least 1",
                             params->width, params->height);
    if (params->samples == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "samples 0: at least 1 iteration is needed");
    if (!(params->time_limit > 0.0))
        return lsf_error_set(error, LSF_ERROR_USAGE, "time limit %g s: must be above 0",
                             params->time_limit);
    if (params->bounces > LSF_BOUNCES_MAX && params->bounces != LSF_BOUNCES_AUTO)
        return lsf_error_set(error, LSF_ERROR_USAGE, "bounces %u: at most %u", params->bounces,
                             LSF_BOUNCES_MAX);
    if (params->camera_position && params->camera_target &&
        memcmp(params->camera_position, params->camera_target, 3 * sizeof(float)) == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the camera's position and target are the same point");
    return true;
}

static void set_layers(lsf_setup *setup, uint32_t aovs)
{
    setup->layer_names[setup->layer_count++] = "picture";
    if (setup->plan->background.coverage) {
        setup->layer_aovs[setup->layer_count] = LSF_LAYER_COVERAGE;
        setup->layer_names[setup->layer_count++] = "coverage";
    }
    for (size_t i = 0; i < LSF_COUNT(aov_names); i++) {
        if (!(aovs & aov_names[i].bit))
            continue;
        setup->layer_aovs[setup->layer_count] = aov_names[i].bit;
        setup->layer_names[setup->layer_count++] = aov_names[i].name;
    }
}

static bool tessellate(lsf_setup *setup, const lsf_scene *scene, lsf_error *error)
{
    const lsf_tessellation_params *params = &setup->pass_params.tessellation;
    setup->scene = scene;
    if (params->factor == 1)
        return true;
    setup->tessellated =
        lsf_scene_tessellate(scene, (uint32_t)params->factor, params->shape, error);
    setup->scene = setup->tessellated;
    return setup->tessellated != NULL;
}

static void begin_plan(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params)
{
    const lsf_technique *technique = lsf_technique_find(params->technique);
    lsf_plan *plan = setup->plan;
    plan->requirements = setup->scene->requirements;
    plan->transmission = plan->requirements.transmissive;
    plan->straight = plan->transmission && technique && !technique->refracts;
    plan->width = params->width;
    plan->height = params->height;
    plan->samples = params->samples;
    bool by_scene = params->bounces == LSF_BOUNCES_AUTO;
    if (technique && technique->bounces)
        plan->bounces = by_scene ? plan->requirements.bounces : params->bounces;
    plan->aovs = params->aovs;
    if (plan->requirements.environment_map || !technique || !technique->draws_lobes)
        plan->sky_lights = lsf_sky_light_count(&plan->requirements, &setup->pass_params.sky_light);
    if (!technique || technique->maps_scene)
        lsf_islands_find(&plan->islands, setup->scene, &setup->state);
    plan->orthographic = setup->state.camera.orthographic;
    plan->background = lsf_background_resolve(scene, params);
    lsf_scene_gpu_plan(plan, setup->scene);
    lsf_iteration_plan(plan);
    if (by_scene && plan->bounces > 0 && plan->requirements.transmissive)
        lsf_plan_remark(plan, "%u bounces, for light takes one to cross each side of a wall of glass",
                        plan->bounces);
    if (!by_scene && params->bounces > plan->bounces)
        lsf_plan_remark(plan, "the %s technique has no bounces; %u asked for", params->technique,
                        params->bounces);
    if (setup->tessellated)
        lsf_plan_remark(plan, "tessellation.factor=%d: %llu triangles became %llu",
                        setup->pass_params.tessellation.factor,
                        (unsigned long long)scene->requirements.triangles,
                        (unsigned long long)setup->tessellated->requirements.triangles);
}

bool lsf_setup_begin(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                     lsf_error *error)
{
    *setup = (lsf_setup){.pass_params = {LSF_PASS_PARAMS_DEFAULTS}};
    if (!check_params(params, error))
        return false;
    for (uint32_t i = 0; i < params->option_count; i++)
        if (!lsf_option_set(lsf_pass_option_tables, lsf_pass_option_table_count,
                            &setup->pass_params, params->options[i], error))
            return false;
    if (!tessellate(setup, scene, error))
        return false;
    lsf_view_params view = {.time = params->time,
                            .camera = params->camera,
                            .position = params->camera_position,
                            .target = params->camera_target,
                            .fov_y = params->fov_y,
                            .aspect = (float)params->width / (float)params->height};
    if (!lsf_state_update(&setup->state, setup->scene, &view, error))
        return false;
    view.time = params->time - (double)setup->pass_params.gbuffer.frame_time;
    if ((params->aovs & LSF_AOV_MOTION) &&
        !lsf_state_update(&setup->previous, setup->scene, &view, error))
        return false;
    setup->plan = lsf_alloc(1, sizeof *setup->plan);
    if (!setup->plan)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
    begin_plan(setup, scene, params);
    return true;
}

static void plan_technique(lsf_setup *setup, const lsf_render_params *params)
{
    lsf_plan *plan = setup->plan;
    plan->technique = setup->technique->name;
    set_layers(setup, params->aovs);
    setup->technique->plan(plan, &setup->pass_params, &setup->state);
    if (plan->straight)
        lsf_plan_remark(plan, "light goes straight through materials that transmit, neither "
                              "scattered nor refracted; voxel_path and the reference do that");
    lsf_accumulate_plan(plan, setup->layer_count, setup->layer_names);
    if (params->rgb8)
        lsf_tonemap_plan(plan);
    else
        lsf_plan_omit(plan, "tonemap", "no 8-bit output is asked for");
}

bool lsf_setup_init(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                    lsf_error *error)
{
    if (!lsf_setup_begin(setup, scene, params, error))
        return false;
    setup->technique = lsf_technique_find(params->technique);
    if (!setup->technique)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "technique '%s' does not exist; --list-techniques shows all",
                             params->technique);
    plan_technique(setup, params);
    if (setup->plan->failed)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
    return true;
}

void lsf_setup_finish(lsf_setup *setup)
{
    lsf_state_finish(&setup->state);
    lsf_state_finish(&setup->previous);
    lsf_plan_destroy(setup->plan);
    lsf_scene_tessellated_destroy(setup->tessellated);
    setup->plan = NULL;
    setup->tessellated = NULL;
}

lsf_plan *lsf_plan_create(const lsf_scene *scene, const lsf_render_params *params, lsf_error *error)
{
    lsf_setup setup;
    lsf_plan *plan = NULL;
    if (lsf_setup_init(&setup, scene, params, error)) {
        plan = setup.plan;
        setup.plan = NULL;
    }
    lsf_setup_finish(&setup);
    return plan;
}
