#include "techniques/setup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "passes/accumulate.h"
#include "passes/tonemap.h"
#include "scene/checks.h"
#include "scene/tessellate.h"
#include "techniques/defaults.h"

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
    if (params->raw && params->temporal)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "raw and temporal: the mean of a frame's iterations alone holds no "
                             "light of frames before; leave one of them out");
    if (params->camera_position && params->camera_target &&
        memcmp(params->camera_position, params->camera_target, 3 * sizeof(float)) == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "the camera's position and target are the same point");
    return true;
}

static void set_layers(lsf_setup *setup, uint32_t aovs)
{
    uint32_t asked = aovs | (setup->plan->background.coverage ? LSF_LAYER_COVERAGE : 0);
    for (size_t i = 0; i < LSF_LAYER_COUNT; i++) {
        if (lsf_layers[i].bit != 0 && !(asked & lsf_layers[i].bit))
            continue;
        setup->layer_aovs[setup->layer_count] = lsf_layers[i].bit;
        setup->layer_names[setup->layer_count++] = lsf_layers[i].name;
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

/* Whether pixels draw rays or samples of their own. */
static bool draws_itself(const lsf_technique *technique)
{
    return !technique || technique->draws_lobes || technique->draws_alone;
}

/* A filter needs noise that differs between neighbours: not so where all pixels take the same
 * samples. */
static bool filters(const lsf_setup *setup, const lsf_technique *technique)
{
    const lsf_pass_params *params = &setup->pass_params;
    return !setup->params.raw && params->light_filter.steps > 0 &&
           (params->sparse.interleave > 1 || draws_itself(technique));
}

/* What an iteration sees, and where light that bounces is gathered there. */
static void set_seen(lsf_setup *setup, const lsf_technique *technique)
{
    lsf_plan *plan = setup->plan;
    uint32_t side = plan->pixel_side = lsf_default_pixel_side(setup, technique);
    plan->seen_width = side * plan->width;
    plan->seen_height = side * plan->height;
    if (side == 1)
        return;
    plan->stride = plan->finest_stride = technique->bounces ? side : 1;
    lsf_plan_remark(plan, "%u points of each pixel are sampled in an iteration%s (gbuffer.side)",
                    side * side,
                    technique->bounces ? ", one of which gathers the light that bounces" : "");
}

static void set_basis(lsf_plan_basis *basis, const lsf_setup *setup)
{
    const lsf_state *state = &setup->state;
    memset(basis, 0, sizeof *basis); /* padding, too: it is compared as bytes */
    memcpy(&basis->requirements, &setup->scene->requirements, sizeof basis->requirements);
    for (uint32_t i = 0; i < state->light_count; i++) {
        basis->lights[state->lights[i].type]++;
        basis->shines = basis->shines || lsf_light_power(&state->lights[i]) > 0.0f;
    }
    basis->movable = setup->scene->edits.movable;
    basis->orthographic = state->camera.orthographic;
    basis->open = lsf_stands_in_the_open(setup);
    basis->divided = setup->plan->islands.count > 1;
    basis->width = setup->params.width;
    basis->height = setup->params.height;
}

static bool begin_plan(lsf_setup *setup, lsf_error *error)
{
    const lsf_render_params *params = &setup->params;
    const lsf_technique *technique = lsf_technique_find(params->technique);
    lsf_plan *plan = setup->plan = lsf_alloc(1, sizeof *plan);
    if (!plan)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
    lsf_default_maps(setup);
    lsf_default_points(setup);
    lsf_default_point_samples(setup);
    lsf_default_filter_steps(setup);
    plan->hurried = lsf_hurries(setup);
    plan->voxels = lsf_default_voxels(setup);
    plan->requirements = setup->scene->requirements;
    plan->transmission = plan->requirements.transmissive;
    plan->straight = plan->transmission && technique && !technique->refracts;
    plan->seen_through = plan->straight || (technique && plan->requirements.thin_walls);
    plan->scattered = plan->transmission && technique && plan->requirements.rough_walls;
    plan->width = params->width;
    plan->height = params->height;
    plan->samples = params->samples;
    plan->filtered = filters(setup, technique);
    int32_t grid = setup->pass_params.sparse.grid;
    plan->stride = technique && technique->bounces ? 1u << (grid - 1) : 1;
    plan->finest_stride =
        lsf_sparse_grid_finest(plan->stride, params->temporal ? UINT32_MAX : params->samples);
    bool by_scene = params->bounces == LSF_BOUNCES_AUTO;
    if (technique && technique->bounces)
        plan->bounces = by_scene ? plan->requirements.bounces : params->bounces;
    plan->aovs = params->aovs;
    plan->open = lsf_stands_in_the_open(setup);
    if (plan->requirements.environment_map || !technique || !technique->draws_lobes)
        plan->sky_lights =
            lsf_sky_light_count(&plan->requirements, &setup->pass_params.sky_light, plan->open);
    set_seen(setup, technique);
    bool shared = !technique || !draws_itself(technique);
    plan->pattern = plan->filtered && shared ? (uint32_t)setup->pass_params.sparse.interleave : 1;
    bool blurs_sky = lsf_shares_samples(setup) && plan->pattern == 1 && !params->temporal;
    plan->sky_split = plan->filtered && !blurs_sky && plan->sky_lights > 0;
    if (!technique || technique->maps_scene)
        lsf_islands_find(&plan->islands, setup->scene, &setup->state);
    plan->temporal = params->temporal;
    plan->orthographic = setup->state.camera.orthographic;
    plan->background = lsf_background_resolve(setup->source, params);
    lsf_scene_gpu_plan(plan, setup->scene);
    lsf_iteration_plan(plan);
    if (by_scene && plan->bounces > 0 && plan->requirements.transmissive)
        lsf_plan_remark(plan,
                        "%u bounces, for light takes one to cross each side of a wall of glass",
                        plan->bounces);
    if (!by_scene && params->bounces > plan->bounces)
        lsf_plan_remark(plan, "the %s technique has no bounces; %u asked for", params->technique,
                        params->bounces);
    if (setup->tessellated)
        lsf_plan_remark(plan, "tessellation.factor=%d: %llu triangles became %llu",
                        setup->pass_params.tessellation.factor,
                        (unsigned long long)setup->source->requirements.triangles,
                        (unsigned long long)setup->tessellated->requirements.triangles);
    if (setup->tessellated && setup->scene->deformer_count > 0)
        lsf_plan_remark(plan, "tessellation.factor leaves what skins and morph targets deform");
    set_basis(&setup->basis, setup);
    return true;
}

static const float *keep_point(float kept[3], const float *point)
{
    if (!point)
        return NULL;
    memcpy(kept, point, 3 * sizeof *kept);
    return kept;
}

/* Options are read once; the rest of what `params` points to is needed for each frame. */
static bool keep_params(lsf_setup *setup, const lsf_render_params *params, lsf_error *error)
{
    lsf_render_params *kept = &setup->params;
    *kept = *params;
    kept->options = NULL;
    kept->option_count = 0;
    kept->camera_position = keep_point(setup->camera_position, params->camera_position);
    kept->camera_target = keep_point(setup->camera_target, params->camera_target);
    kept->camera = params->camera ? strdup(params->camera) : NULL;
    return !params->camera || kept->camera ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
}

static lsf_view_params view_of(const lsf_setup *setup, double time, const lsf_view *view)
{
    const lsf_render_params *params = &setup->params;
    return (lsf_view_params){.time = time,
                             .view = view,
                             .camera = params->camera,
                             .position = params->camera_position,
                             .target = params->camera_target,
                             .fov_y = params->fov_y,
                             .aspect = (float)params->width / (float)params->height};
}

static bool measures_motion(const lsf_setup *setup)
{
    return setup->params.temporal || (setup->params.aovs & LSF_AOV_MOTION);
}

/* Without a frame before, motion is that of the animation. */
static bool update_previous(lsf_setup *setup, double time, const lsf_view *view, lsf_error *error)
{
    lsf_view_params params =
        view_of(setup, time - (double)setup->pass_params.gbuffer.frame_time, view);
    return !measures_motion(setup) ||
           lsf_state_update(&setup->previous, setup->scene, &params, error);
}

/* A range that has a gap: options have a least and a largest value. */
static bool check_side(const char *option, int32_t side, int32_t least, lsf_error *error)
{
    return side == 0 || side >= least ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "-D %s=%d: at least %d texels, or 0 to choose by the number of iterations",
                         option, side, least);
}

static bool read_options(lsf_pass_params *pass_params, const lsf_render_params *params,
                         lsf_error *error)
{
    for (uint32_t i = 0; i < params->option_count; i++)
        if (!lsf_given(params->options, "lsf_render_params.options", error) ||
            !lsf_given(params->options[i], "one of lsf_render_params.options", error) ||
            !lsf_option_set(lsf_pass_option_tables, lsf_pass_option_table_count, pass_params,
                            params->options[i], error))
            return false;
    return check_side("bundle.resolution", pass_params->ray_bundle.resolution, LSF_RAY_BUNDLE_LEAST,
                      error) &&
           check_side("rsm.resolution", pass_params->reflective_shadow_map.resolution,
                      LSF_REFLECTIVE_SHADOW_MAP_LEAST, error);
}

bool lsf_setup_begin(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                     bool software, lsf_error *error)
{
    *setup = (lsf_setup){
        .pass_params = {LSF_PASS_PARAMS_DEFAULTS}, .source = scene, .software = software};
    if (!lsf_scene_given(scene, error) || !lsf_given(params, "params", error) ||
        !lsf_given(params->technique, "lsf_render_params.technique", error) ||
        !check_params(params, error) || !read_options(&setup->pass_params, params, error) ||
        !keep_params(setup, params, error) || !tessellate(setup, scene, error))
        return false;
    setup->asked = setup->pass_params;
    lsf_view_params view = view_of(setup, params->time, NULL);
    return lsf_state_update(&setup->state, setup->scene, &view, error) &&
           update_previous(setup, params->time, NULL, error) && begin_plan(setup, error);
}

static bool wants_network(const lsf_setup *setup)
{
    return setup->pass_params.light_filter.kind == LSF_LIGHT_FILTER_NETWORK;
}

/* What a network would be given is recorded for those who train one. */
static bool records(const lsf_setup *setup)
{
    return wants_network(setup) && lsf_denoise_record_path();
}

#define WEIGHTS "LIGHTSHEAF_DENOISER_WEIGHTS"

/* Where it is to be recorded there may be none yet. */
static bool load_network(lsf_setup *setup, lsf_error *error)
{
    if (!wants_network(setup) || !filters(setup, setup->technique) || records(setup))
        return true;
    setup->net = lsf_net_load(getenv(WEIGHTS), error);
    return setup->net != NULL;
}

static void plan_denoiser(lsf_setup *setup)
{
    lsf_plan *plan = setup->plan;
    const char *weights = setup->net ? getenv(WEIGHTS) : NULL;
    plan->weights = weights ? lsf_format("%s", weights) : NULL;
    plan->failed |= weights && !plan->weights;
    lsf_denoise_plan(plan, setup->net);
}

static bool plan_technique(lsf_setup *setup, lsf_error *error)
{
    const lsf_render_params *params = &setup->params;
    lsf_plan *plan = setup->plan;
    plan->technique = setup->technique->name;
    setup->layer_count = 0;
    set_layers(setup, params->aovs);
    setup->technique->plan(plan, &setup->pass_params, &setup->state);
    if (plan->straight && plan->refracted)
        lsf_plan_remark(plan, "media refract what they show to the eye; other light goes straight "
                              "through materials that transmit, and rough thin walls scatter it "
                              "to the eye alone; voxel_path and the reference refract all");
    else if (plan->straight)
        lsf_plan_remark(plan, "light goes straight through materials that transmit, not refracted, "
                              "and scattered by rough thin walls alone, where one looks at them; "
                              "voxel_path and the reference do that");
    lsf_accumulate_plan(plan, setup->layer_count, setup->layer_names);
    const lsf_light_mean_use light = {
        .indirect = lsf_plan_switch_value(plan, "compose", "LSF_INDIRECT"),
        .split_direct = lsf_plan_switch_value(plan, "compose", "LSF_SPLIT_DIRECT"),
        .sky = lsf_plan_switch_value(plan, "compose", "LSF_SKY_LIGHT")};
    bool split = light.indirect || light.sky;
    if (split && (plan->filtered || plan->temporal)) {
        lsf_light_mean_plan(plan, &light);
        lsf_light_guide_plan(plan);
    }
    if (split && plan->temporal)
        lsf_temporal_plan(plan, &setup->pass_params.temporal, plan->filtered && setup->net);
    else if (plan->temporal)
        lsf_plan_omit(plan, "temporal", "no light is noisy but for edges and shadows");
    if (split && plan->filtered) {
        lsf_light_filter_plan(plan, &setup->pass_params.light_filter);
        if (setup->net || records(setup))
            plan_denoiser(setup);
    } else if (!plan->filtered)
        lsf_plan_omit(plan, "light_filter", "%s",
                      params->raw ? "the raw picture is asked for"
                                  : "light_filter.steps is 0, or all pixels take the same samples");
    if (params->rgb8 || params->present)
        lsf_tonemap_plan(plan, params->rgb8);
    else
        lsf_plan_omit(plan, "tonemap", "no 8-bit output is asked for");
    return !plan->failed ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the frame plan");
}

bool lsf_setup_init(lsf_setup *setup, const lsf_scene *scene, const lsf_render_params *params,
                    bool software, lsf_error *error)
{
    if (!lsf_setup_begin(setup, scene, params, software, error))
        return false;
    setup->technique = lsf_technique_find(params->technique);
    if (!setup->technique)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "technique '%s' does not exist; lsf_technique_name has all",
                             params->technique);
    setup->params.technique = setup->technique->name;
    return load_network(setup, error) && plan_technique(setup, error);
}

bool lsf_setup_plans_alike(const lsf_setup *setup, const lsf_render_params *params, bool *alike,
                           lsf_error *error)
{
    lsf_setup other = {.pass_params = {LSF_PASS_PARAMS_DEFAULTS}};
    const lsf_render_params *own = &setup->params;
    if (!lsf_given(params->technique, "lsf_render_params.technique", error) ||
        !check_params(params, error) || !read_options(&other.pass_params, params, error))
        return false;
    *alike = strcmp(own->technique, params->technique) == 0 && own->width == params->width &&
             own->height == params->height && own->samples == params->samples &&
             !(own->time_limit < params->time_limit) && !(own->time_limit > params->time_limit) &&
             own->bounces == params->bounces && own->seed == params->seed &&
             own->raw == params->raw && own->temporal == params->temporal &&
             own->rgb8 == params->rgb8 && own->present == params->present &&
             own->aovs == params->aovs && own->background == params->background &&
             memcmp(own->background_radiance, params->background_radiance,
                    sizeof own->background_radiance) == 0 &&
             memcmp(&setup->asked, &other.pass_params, sizeof other.pass_params) == 0;
    return true;
}

bool lsf_setup_take(lsf_setup *setup, const lsf_render_params *params, lsf_error *error)
{
    lsf_setup taken = {0};
    if (!keep_params(&taken, params, error))
        return false;
    free((char *)setup->params.camera);
    const char *technique = setup->params.technique;
    keep_point(setup->camera_position, params->camera_position);
    keep_point(setup->camera_target, params->camera_target);
    setup->params = taken.params;
    setup->params.technique = technique;
    setup->params.camera_position = params->camera_position ? setup->camera_position : NULL;
    setup->params.camera_target = params->camera_target ? setup->camera_target : NULL;
    return true;
}

/* A tessellated copy borrows what edits change, except for what is derived from it. */
static bool follow_edits(lsf_setup *setup, lsf_error *error)
{
    lsf_scene *copy = setup->tessellated;
    if (!copy || memcmp(&copy->edits, &setup->source->edits, sizeof copy->edits) == 0)
        return true;
    copy->edits = setup->source->edits;
    copy->environment = setup->source->environment;
    return lsf_scene_update_requirements(copy) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit of the scene");
}

/* Whether an animation has changed things of a kind since the previous state. */
static bool is_animated(const lsf_setup *setup, lsf_kind kind, const lsf_state *before)
{
    return !lsf_animated_has(setup->scene, kind, &setup->state.animated, before->animated.values);
}

static bool same_camera(const lsf_camera_state *a, const lsf_camera_state *b)
{
    const size_t first = offsetof(lsf_camera_state, start); /* the members from here on are
                                                             * floats */
    return a->orthographic == b->orthographic &&
           memcmp((const char *)a + first, (const char *)b + first, sizeof *a - first) == 0;
}

static bool same_lights(const lsf_state *a, const lsf_state *b)
{
    return a->light_count == b->light_count &&
           (a->light_count == 0 ||
            memcmp(a->lights, b->lights, a->light_count * sizeof *a->lights) == 0);
}

bool lsf_setup_frame(lsf_setup *setup, const lsf_frame *frame, lsf_error *error)
{
    lsf_state *state = &setup->previous; /* the oldest */
    lsf_view_params view = view_of(setup, frame->time, frame->view);
    if (!follow_edits(setup, error) || !lsf_state_update(state, setup->scene, &view, error))
        return false;
    lsf_state before = setup->state;
    setup->state = *state;
    setup->previous = before;
    const lsf_edits *now = &setup->scene->edits;
    bool environment = before.edits.environment != now->environment;
    bool animated = before.time != frame->time && setup->scene->channel_count > 0;
    setup->changes = (lsf_changes){.view = !same_camera(&before.camera, &setup->state.camera),
                                   .moved = animated || before.edits.nodes != now->nodes ||
                                            is_animated(setup, LSF_KIND_NODE, &before),
                                   .environment = environment,
                                   .lights = environment || before.edits.lights != now->lights ||
                                             is_animated(setup, LSF_KIND_LIGHT, &before) ||
                                             is_animated(setup, LSF_KIND_NODE, &before),
                                   .shining = environment || !same_lights(&before, &setup->state),
                                   .materials = before.edits.materials != now->materials ||
                                                is_animated(setup, LSF_KIND_MATERIAL, &before)};
    if (setup->changes.moved && setup->plan && setup->plan->islands.count > 0)
        lsf_islands_find(&setup->plan->islands, setup->scene, &setup->state);
    return !frame->cut || update_previous(setup, frame->time, frame->view, error);
}

bool lsf_setup_fits(const lsf_setup *setup)
{
    lsf_plan_basis now;
    set_basis(&now, setup);
    return memcmp(&now, &setup->basis, sizeof now) == 0;
}

bool lsf_setup_replan(lsf_setup *setup, lsf_plan **old, lsf_error *error)
{
    *old = setup->plan;
    setup->plan = NULL;
    return begin_plan(setup, error) && plan_technique(setup, error);
}

const lsf_state *lsf_setup_previous(const lsf_setup *setup)
{
    return measures_motion(setup) ? &setup->previous : NULL;
}

void lsf_setup_finish(lsf_setup *setup)
{
    lsf_state_finish(&setup->state);
    lsf_state_finish(&setup->previous);
    lsf_plan_destroy(setup->plan);
    lsf_net_destroy(setup->net);
    lsf_scene_tessellated_destroy(setup->tessellated);
    free((char *)setup->params.camera);
    *setup = (lsf_setup){0};
}

bool lsf_render_params_view(const lsf_scene *scene, const lsf_render_params *params, lsf_view *view,
                            lsf_error *error)
{
    lsf_setup setup = {0};
    bool good = lsf_scene_given(scene, error) && lsf_given(params, "params", error) &&
                lsf_given(view, "view", error) && check_params(params, error) &&
                keep_params(&setup, params, error);
    if (good) {
        lsf_view_params wanted = view_of(&setup, params->time, NULL);
        good = lsf_state_update(&setup.state, scene, &wanted, error);
    }
    if (good)
        *view = setup.state.view;
    lsf_setup_finish(&setup);
    return good;
}

lsf_plan *lsf_plan_create(const lsf_scene *scene, const lsf_render_params *params, lsf_error *error)
{
    lsf_setup setup;
    lsf_plan *plan = NULL;
    if (lsf_setup_init(&setup, scene, params, true, error)) {
        plan = setup.plan;
        setup.plan = NULL;
    }
    lsf_setup_finish(&setup);
    return plan;
}
