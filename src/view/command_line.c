/* The command line that makes the picture that is shown. */
#include "view/app.h"

#include "base/base.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Text of options: in a line for a shell, or each in a line of its own for --view. */
typedef struct writer {
    lsf_string text;
    bool lines;
} writer;

/* Within single quotes where a shell would take it for more than a word. */
static void add_quoted(lsf_string *text, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=./,:%@";
    if (*word && word[strspn(word, plain)] == '\0') {
        lsf_string_add(text, "%s", word);
        return;
    }
    lsf_string_add(text, "'");
    for (; *word; word++)
        lsf_string_add(text, *word == '\'' ? "'\\''" : "%c", *word);
    lsf_string_add(text, "'");
}

static void add(writer *w, const char *option, const char *value)
{
    lsf_string_add(&w->text, w->lines ? "%s" : " --%s", option);
    if (value)
        lsf_string_add(&w->text, w->lines ? "=" : " ");
    if (value && w->lines)
        lsf_string_add(&w->text, "%s", value);
    else if (value)
        add_quoted(&w->text, value);
    if (w->lines)
        lsf_string_add(&w->text, "\n");
}

static void add_format(writer *w, const char *option, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void add_format(writer *w, const char *option, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *value = lsf_format_arguments(format, arguments);
    va_end(arguments);
    w->text.failed = w->text.failed || !value;
    if (value)
        add(w, option, value);
    free(value);
}

static void add_vector(writer *w, const char *option, const float v[3])
{
    add_format(w, option, "%.9g,%.9g,%.9g", (double)v[0], (double)v[1], (double)v[2]);
}

static void add_scene(writer *w, const lsf_scene_params *params)
{
    static const char *const whens[] = {"auto", "always", "never"};
    if (params->environment_path)
        add(w, "environment", params->environment_path);
    if (params->environment_radiance)
        add_vector(w, "environment", params->environment_radiance);
    if (params->environment_rotation != 0.0f)
        add_format(w, "environment-rotation", "%.9g", (double)params->environment_rotation);
    if (params->environment_strength != 1.0f)
        add_format(w, "environment-strength", "%.9g", (double)params->environment_strength);
    if (params->default_light != LSF_DEFAULT_LIGHT_AUTO)
        add(w, "default-light", whens[params->default_light]);
    if (params->diffuse_only)
        add(w, "diffuse-only", NULL);
    if (params->show_back_faces)
        add(w, "show-back-faces", NULL);
    if (params->lenient)
        add(w, "lenient", NULL);
    if (params->scene)
        add(w, "scene", params->scene);
    if (params->variant)
        add(w, "variant", params->variant);
    for (uint32_t i = 0; i < params->animation_count; i++)
        add(w, "animation", params->animations[i]);
    if (params->animations && params->animation_count == 0)
        add(w, "animation", "none");
}

static void add_camera(writer *w, const lsf_viewer *viewer)
{
    const lsf_viewer_camera *camera = &viewer->camera;
    if (viewer->file_camera > 0)
        add_format(w, "camera", "%u", viewer->file_camera);
    if (camera->own) {
        add_vector(w, "camera-position", camera->position);
        add_vector(w, "camera-target", camera->target);
    }
    if (!isnan(camera->fov_y))
        add_format(w, "fov-y", "%.9g", (double)camera->fov_y);
    if (viewer->time != 0.0)
        add_format(w, "time", "%.17g", viewer->time);
}

static void add_picture(writer *w, const lsf_viewer *viewer)
{
    static const char *const curves[] = {"neutral", "none", "aces", "agx"};
    const lsf_viewer_settings *settings = &viewer->settings;
    add(w, "technique", lsf_technique_name((uint32_t)settings->technique));
    add_format(w, "resolution", "%.0f,%.0f", (double)viewer->area.width,
               (double)viewer->area.height);
    add_format(w, "samples", "%u", settings->samples);
    if (settings->bounces >= 0)
        add_format(w, "bounces", "%d", settings->bounces);
    if (settings->raw)
        add(w, "raw", NULL);
    if (settings->seed != 0)
        add_format(w, "seed", "%" PRIu64, settings->seed);
    for (uint32_t i = 0; i < settings->option_count; i++)
        if (lsf_viewer_option_changed(&settings->options[i]))
            add_format(w, "define", "%s=%s", settings->options[i].key, settings->options[i].value);
    if (settings->background == LSF_BACKGROUND_UNIFORM)
        add_vector(w, "background", settings->background_radiance);
    if (settings->background == LSF_BACKGROUND_ENVIRONMENT)
        add(w, "background", "environment");
    if (settings->background == LSF_BACKGROUND_TRANSPARENT)
        add(w, "background", "transparent");
    if (settings->exposure != 0.0f)
        add_format(w, "exposure", "%.9g", (double)settings->exposure);
    if (settings->curve != LSF_TONE_CURVE_NEUTRAL)
        add(w, "tonemap", curves[settings->curve]);
}

static void add_edits(writer *w, const lsf_viewer *viewer)
{
    const lsf_scene_params *params = &viewer->scene_params;
    for (uint32_t i = 0; i < params->light_count; i++) {
        const float *rgb = params->lights[i].light.intensity;
        const double *at = params->lights[i].matrix + 12;
        add_format(w, "light", "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", at[0], at[1], at[2], (double)rgb[0],
                   (double)rgb[1], (double)rgb[2]);
    }
    char *edits = lsf_viewer_edits(viewer), *rest = edits, *line;
    w->text.failed = w->text.failed || !edits;
    while (edits && (line = strsep(&rest, "\n")) != NULL)
        if (*line)
            add(w, "edit", line);
    free(edits);
}

static char *write(lsf_viewer *viewer, writer *w)
{
    add_picture(w, viewer);
    add_camera(w, viewer);
    add_scene(w, &viewer->scene_params);
    add_edits(w, viewer);
    if (w->text.failed) {
        free(w->text.text);
        return NULL;
    }
    return w->text.text;
}

char *lsf_viewer_command(lsf_viewer *viewer)
{
    writer w = {.lines = false};
    lsf_string_add(&w.text, "lightsheaf render ");
    add_quoted(&w.text, viewer->paths[viewer->shown]);
    return write(viewer, &w);
}

char *lsf_viewer_view_file(lsf_viewer *viewer)
{
    writer w = {.lines = true};
    char *real = realpath(viewer->paths[viewer->shown], NULL);
    lsf_string_add(&w.text,
                   "# A view, for lightsheaf render --view and lightsheaf view --view.\nfile=%s\n",
                   real ? real : viewer->paths[viewer->shown]);
    free(real);
    return write(viewer, &w);
}
