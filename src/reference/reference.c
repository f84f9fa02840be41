/* The library's side of the reference: evaluates the scene, loads the module and calls it. */
#include <lightsheaf/reference.h>

#include <dlfcn.h>
#include <math.h>
#include <string.h>

#include "base/base.h"
#include "reference/module.h"
#include "scene/checks.h"
#include "scene/layer.h"
#include "scene/state.h"

/* In the order of the image's channels. */
static const struct {
    lsf_reference_layer layer;
    uint32_t bit; /* as in lsf_layer */
} layers[] = {
    {LSF_REFERENCE_BEAUTY, 0},
    {LSF_REFERENCE_COVERAGE, LSF_LAYER_COVERAGE},
    {LSF_REFERENCE_ALBEDO, LSF_AOV_ALBEDO},
    {LSF_REFERENCE_NORMAL, LSF_AOV_NORMAL},
    {LSF_REFERENCE_DEPTH, LSF_AOV_DEPTH},
    {LSF_REFERENCE_EMISSION, LSF_AOV_EMISSION},
    {LSF_REFERENCE_DIRECT, LSF_AOV_DIRECT},
    {LSF_REFERENCE_INDIRECT_DIFFUSE, LSF_AOV_INDIRECT_DIFFUSE},
    {LSF_REFERENCE_INDIRECT_SPECULAR, LSF_AOV_INDIRECT_SPECULAR},
};

static bool check_params(const lsf_render_params *params, uint32_t half, lsf_error *error)
{
    if (params->width == 0 || params->height == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "resolution %u,%u: a picture needs at least 1 x 1 pixels",
                             params->width, params->height);
    if (params->samples == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE, "samples 0: at least 1 is needed");
    if (params->bounces > LSF_BOUNCES_MAX && params->bounces != LSF_BOUNCES_AUTO)
        return lsf_error_set(error, LSF_ERROR_USAGE, "bounces %u: at most %u", params->bounces,
                             LSF_BOUNCES_MAX);
    if (half > 1)
        return lsf_error_set(error, LSF_ERROR_USAGE, "there is no half %u, only 0 and 1", half);
    return true;
}

/* Creates the picture with the requested channels, and the first channel of each layer. */
static lsf_image *create_image(const lsf_render_params *params, lsf_reference_job *job,
                               lsf_error *error)
{
    char names[3 * LSF_COUNT(layers)][LSF_CHANNEL_NAME_SIZE];
    const char *list[3 * LSF_COUNT(layers)];
    uint32_t count = 0;
    uint32_t asked = params->aovs | (job->background.coverage ? LSF_LAYER_COVERAGE : 0);
    for (size_t i = 0; i < LSF_COUNT(layers); i++) {
        bool wanted = layers[i].bit == 0 || (asked & layers[i].bit) != 0;
        job->channels[layers[i].layer] = wanted ? (int)count : -1;
        if (wanted)
            count += lsf_layer_channels(lsf_layer_of(layers[i].bit), names + count);
    }
    for (uint32_t c = 0; c < count; c++)
        list[c] = names[c];
    return lsf_image_create(params->width, params->height, count, list, error);
}

/* LSF_AOV_ALL includes motion, which a single instant does not have. */
static void warn_of_missing(const lsf_render_params *params)
{
    if (params->aovs & LSF_AOV_MOTION)
        lsf_log(LSF_LOG_WARNING, "layer motion: the reference shows one instant and has no such "
                                 "layer; it is left out");
    if (params->aovs & ~(uint32_t)LSF_AOV_ALL)
        lsf_log(LSF_LOG_WARNING, "layer %s: the reference has no voxels; it is left out",
                lsf_aov_name(params->aovs & ~(uint32_t)LSF_AOV_ALL));
}

static void *load_symbol(const char *name, lsf_error *error)
{
    static const char hint[] = "the reference is built where libembree-dev is installed";
    lsf_error cause;
    void *module = lsf_module_open(LSF_REFERENCE_MODULE_NAME, hint, &cause);
    if (module == NULL) {
        lsf_error_set(error, LSF_ERROR_USAGE, "%s", cause.message);
        return NULL;
    }
    void *symbol = dlsym(module, name);
    if (symbol == NULL)
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "%s.so has no symbol %s; install library and module of one version",
                      LSF_REFERENCE_MODULE_NAME, name);
    return symbol;
}

const lsf_reference_ray_functions *lsf_reference_load_rays(lsf_error *error)
{
    return load_symbol(LSF_REFERENCE_RAYS_ENTRY, error);
}

lsf_image *lsf_reference_render(const lsf_scene *scene, const lsf_render_params *params,
                                uint32_t half, lsf_reference_result *result, lsf_error *error)
{
    if (!lsf_scene_given(scene, error) || !lsf_given(params, "params", error))
        return NULL;
    if (!check_params(params, half, error))
        return NULL;
    warn_of_missing(params);
    lsf_render_params resolved = *params;
    if (params->bounces == LSF_BOUNCES_AUTO)
        resolved.bounces = scene->requirements.bounces;
    void *symbol = load_symbol(LSF_REFERENCE_MODULE_ENTRY, error);
    if (symbol == NULL)
        return NULL;
    lsf_reference_module_function render;
    memcpy(&render, &symbol, sizeof render); /* ISO C has no cast from object to function */

    lsf_state state = {0};
    lsf_reference_job job = {.scene = scene,
                             .state = &state,
                             .params = &resolved,
                             .half = half,
                             .background = lsf_background_resolve(scene, params)};
    lsf_view_params view = {
        .time = params->time,
        .camera = params->camera,
        .position = params->camera_position,
        .target = params->camera_target,
        .fov_y = params->fov_y,
        .aspect = (float)params->width / (float)params->height,
    };
    bool ok = lsf_state_update(&state, scene, &view, error);
    if (ok) {
        job.image = create_image(params, &job, error);
        ok = job.image != NULL && render(&job, error);
    }
    lsf_state_finish(&state);
    if (!ok) {
        lsf_image_destroy(job.image);
        return NULL;
    }
    if (result != NULL)
        *result = job.result;
    return job.image;
}
