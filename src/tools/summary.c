#include "tools/summary.h"

#include "tools/number.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void add_aovs(lsf_json *json, uint32_t aovs)
{
    lsf_json_begin(json, "aovs", '[');
    for (uint32_t aov = 1; aov && aov <= aovs; aov <<= 1)
        if (aovs & aov)
            lsf_json_string(json, NULL, lsf_aov_name(aov));
    lsf_json_end(json, ']');
}

/* The last -D of that key, or the default. */
static const char *effective_value(const lsf_list_setting *defines, const lsf_option *option)
{
    size_t length = strlen(option->key);
    for (uint32_t i = defines->count; i-- > 0;)
        if (strncmp(defines->items[i], option->key, length) == 0 &&
            defines->items[i][length] == '=')
            return defines->items[i] + length + 1;
    return option->value;
}

static void add_pass_options(lsf_json *json, const lsf_list_setting *defines)
{
    lsf_json_begin(json, "passes", '{');
    lsf_option option;
    for (uint32_t i = 0; lsf_option_list(i, &option); i++) {
        const char *value = effective_value(defines, &option);
        double number;
        bool numeric = strcmp(option.type, "int") == 0 || strcmp(option.type, "float") == 0;
        if (numeric && lsf_parse_number(value, -DBL_MAX, DBL_MAX, &number))
            lsf_json_number(json, option.key, number);
        else if (strcmp(option.type, "bool") == 0)
            lsf_json_bool(json, option.key,
                          strcmp(value, "true") == 0 || strcmp(value, "1") == 0 ||
                              strcmp(value, "on") == 0);
        else
            lsf_json_string(json, option.key, value);
    }
    lsf_json_end(json, '}');
}

static void add_options(lsf_json *json, const lsf_settings *settings)
{
    static const char *const backends[] = {"auto", "egl", "osmesa", "glfw"};
    static const char *const backgrounds[] = {
        [LSF_BACKGROUND_AUTO] = NULL,
        [LSF_BACKGROUND_ENVIRONMENT] = "environment",
        [LSF_BACKGROUND_TRANSPARENT] = "transparent",
    };
    static const char *const curves[] = {"neutral", "none", "aces", "agx"};
    static const char *const default_lights[] = {"auto", "always", "never"};
    const lsf_vector_setting *position = &settings->camera_position;
    const lsf_vector_setting *target = &settings->camera_target;
    lsf_render_params params = lsf_settings_render_params(settings);

    lsf_json_begin(json, "options", '{');
    if (params.samples == UINT32_MAX)
        lsf_json_string(json, "samples", NULL);
    else
        lsf_json_integer(json, "samples", params.samples);
    lsf_json_number(json, "time_limit", settings->time_limit);
    lsf_json_string(json, "camera", settings->camera);
    lsf_json_vector(json, "camera_position", position->given ? position->value : NULL, 3);
    lsf_json_vector(json, "camera_target", target->given ? target->value : NULL, 3);
    lsf_json_number(json, "fov_y", settings->fov_y);
    lsf_json_number(json, "time", settings->time);
    if (settings->exposure.automatic)
        lsf_json_string(json, "exposure", "auto");
    else
        lsf_json_number(json, "exposure", (double)settings->exposure.ev);
    lsf_json_string(json, "tonemap", curves[settings->tonemap]);
    add_aovs(json, settings->aovs);
    if (settings->environment.uniform.given)
        lsf_json_vector(json, "environment", settings->environment.uniform.value, 3);
    else
        lsf_json_string(json, "environment", settings->environment.path);
    lsf_json_number(json, "environment_rotation", settings->environment_rotation);
    lsf_json_number(json, "environment_strength", settings->environment_strength);
    if (settings->background.kind == LSF_BACKGROUND_UNIFORM)
        lsf_json_vector(json, "background", settings->background.radiance, 3);
    else
        lsf_json_string(json, "background", backgrounds[settings->background.kind]);
    lsf_json_string(json, "default_light", default_lights[settings->default_light]);
    lsf_json_bool(json, "diffuse_only", settings->diffuse_only);
    lsf_json_bool(json, "show_back_faces", settings->show_back_faces);
    lsf_json_bool(json, "lenient", settings->lenient);
    lsf_json_string(json, "scene", settings->scene);
    lsf_json_begin(json, "animations", '[');
    for (uint32_t i = 0; i < settings->animations.count; i++)
        lsf_json_string(json, NULL, settings->animations.items[i]);
    lsf_json_end(json, ']');
    lsf_json_string(json, "variant", settings->variant);
    lsf_json_bool(json, "halves", settings->halves);
    lsf_json_string(json, "backend", backends[settings->backend]);
    lsf_json_string(json, "shader_dir", settings->shader_dir);
    lsf_json_bool(json, "gl_debug", settings->gl_debug);
    add_pass_options(json, &settings->defines);
    lsf_json_end(json, '}');
}

void lsf_summary_add_device(lsf_json *json, const lsf_context_info *device)
{
    lsf_json_begin(json, "device", '{');
    lsf_json_string(json, "backend", device ? device->backend : "embree");
    if (device) {
        lsf_json_string(json, "vendor", device->vendor);
        lsf_json_string(json, "renderer", device->renderer);
        lsf_json_string(json, "version", device->version);
        lsf_json_bool(json, "software", device->software);
        lsf_json_bool(json, "robust", device->robust);
    }
    lsf_json_end(json, '}');
}

static void add_passes(lsf_json *json, const lsf_renderer_stats *stats)
{
    lsf_json_begin(json, "passes", '[');
    for (uint32_t i = 0; i < stats->pass_count; i++) {
        const lsf_pass_stats *pass = &stats->passes[i];
        lsf_json_begin(json, NULL, '{');
        lsf_json_string(json, "name", pass->name);
        lsf_json_integer(json, "runs", pass->runs);
        lsf_json_number(json, "milliseconds", pass->milliseconds);
        lsf_json_begin(json, "counts", '{');
        for (uint32_t j = 0; j < pass->count_count; j++)
            lsf_json_integer(json, pass->count_names[j], pass->counts[j]);
        lsf_json_end(json, '}');
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
}

uint32_t lsf_summary_bounces(const lsf_settings *settings, const lsf_scene *scene)
{
    return settings->bounces == LSF_BOUNCES_AUTO ? lsf_scene_get_requirements(scene)->bounces
                                                 : settings->bounces;
}

void lsf_summary_add(lsf_json *json, const lsf_summary *summary)
{
    const lsf_settings *settings = summary->settings;
    lsf_json_begin(json, NULL, '{');
    lsf_json_string(json, "lightsheaf", lsf_version());
    lsf_json_string(json, "command", settings->command->name);
    lsf_json_string(json, "scene", summary->scene_path);
    lsf_json_string(json, "output", summary->output);
    if (summary->half_paths) {
        lsf_json_begin(json, "halves", '[');
        lsf_json_string(json, NULL, summary->half_paths[0]);
        lsf_json_string(json, NULL, summary->half_paths[1]);
        lsf_json_end(json, ']');
    }
    lsf_json_string(json, "technique", summary->technique);
    lsf_json_integer(json, "seed", settings->seed);
    lsf_json_integer(json, "bounces", summary->bounces);
    lsf_json_vector(json, "resolution",
                    (float[]){(float)settings->resolution[0], (float)settings->resolution[1]}, 2);
    lsf_json_integer(json, "samples", summary->samples);
    lsf_json_bool(json, "interrupted", summary->interrupted);
    lsf_json_number(json, "exposure", (double)summary->exposure);
    if (summary->stats) {
        lsf_json_number(json, "lost_share", summary->stats->lost_share);
        lsf_json_string(json, "denoiser_weights", summary->weights);
    }
    add_options(json, settings);
    lsf_summary_add_device(json, summary->device);

    lsf_json_begin(json, "seconds", '{');
    for (uint32_t i = 0; i < summary->seconds_count; i++)
        lsf_json_number(json, summary->seconds[i].name, summary->seconds[i].value);
    lsf_json_end(json, '}');
    if (summary->stats) {
        add_passes(json, summary->stats);
        lsf_json_begin(json, "gl_bytes", '{');
        lsf_json_integer(json, "plan", summary->plan_bytes);
        lsf_json_integer(json, "now", summary->device->gl_bytes);
        lsf_json_integer(json, "peak", summary->device->gl_bytes_peak);
        lsf_json_end(json, '}');
    } else {
        lsf_json_integer(json, "rays", summary->rays);
    }

    lsf_json_begin(json, "notes", '[');
    for (uint32_t i = 0; i < lsf_scene_note_count(summary->scene); i++)
        lsf_json_string(json, NULL, lsf_scene_note(summary->scene, i));
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}
