#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

static int technique_of(const char *name)
{
    for (uint32_t i = 0; lsf_technique_name(i); i++)
        if (strcmp(lsf_technique_name(i), name) == 0)
            return (int)i;
    return 0;
}

/* Takes over the options of -D. */
static void assign(lsf_viewer_settings *settings, const char *assignment)
{
    const char *equals = strchr(assignment, '=');
    size_t length = equals ? (size_t)(equals - assignment) : strlen(assignment);
    for (uint32_t i = 0; equals && i < settings->option_count; i++) {
        lsf_viewer_option *option = &settings->options[i];
        if (strlen(option->key) == length && strncmp(option->key, assignment, length) == 0)
            lsf_print(option->value, sizeof option->value, "%s", equals + 1);
    }
}

void lsf_viewer_settings_start(lsf_viewer_settings *settings, const lsf_viewer_start *start)
{
    const lsf_render_params *render = &start->render;
    lsf_option option;
    *settings = (lsf_viewer_settings){
        .technique = technique_of(render->technique),
        .samples = render->samples == UINT32_MAX ? 64 : render->samples,
        .bounces = render->bounces == LSF_BOUNCES_AUTO ? -1 : (int)render->bounces,
        .seed = render->seed,
        .raw = render->raw,
        .exposure = start->exposure,
        .curve = (int)start->curve,
        .background = render->background,
    };
    memcpy(settings->background_radiance, render->background_radiance,
           sizeof settings->background_radiance);
    for (uint32_t i = 0; i < LSF_VIEWER_OPTIONS && lsf_option_list(i, &option); i++) {
        lsf_viewer_option *own = &settings->options[settings->option_count++];
        *own = (lsf_viewer_option){.key = option.key, .type = option.type, .help = option.help};
        lsf_print(own->range, sizeof own->range, "%s", option.range);
        lsf_print(own->initial, sizeof own->initial, "%s", option.value);
        lsf_print(own->value, sizeof own->value, "%s", option.value);
        lsf_print(own->unit, sizeof own->unit, "%s", option.unit);
    }
    for (uint32_t i = 0; i < render->option_count; i++)
        assign(settings, render->options[i]);
}

bool lsf_viewer_option_changed(const lsf_viewer_option *option)
{
    return strcmp(option->value, option->initial) != 0;
}

void lsf_viewer_settings_params(const lsf_viewer_settings *settings, lsf_render_params *params,
                                lsf_viewer_assignments *storage)
{
    storage->count = 0;
    for (uint32_t i = 0; i < settings->option_count; i++) {
        const lsf_viewer_option *option = &settings->options[i];
        if (!lsf_viewer_option_changed(option))
            continue;
        char *text = storage->text[storage->count];
        lsf_print(text, sizeof storage->text[0], "%s=%s", option->key, option->value);
        storage->items[storage->count++] = text;
    }
    params->technique = lsf_technique_name((uint32_t)settings->technique);
    params->samples = settings->samples;
    params->bounces = settings->bounces < 0 ? LSF_BOUNCES_AUTO : (uint32_t)settings->bounces;
    params->seed = settings->seed;
    params->raw = settings->raw;
    params->background = settings->background;
    memcpy(params->background_radiance, settings->background_radiance,
           sizeof params->background_radiance);
    params->aovs = settings->layer > 0 ? 1u << (settings->layer - 1) : 0;
    params->options = storage->items;
    params->option_count = storage->count;
}
