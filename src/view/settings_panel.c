/* The tabs of settings and of the times of passes. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- light and display --- */

static void display_section(lsf_viewer *viewer)
{
    static const char *const curves[] = {"neutral", "none", "aces", "agx"};
    lsf_viewer_settings *settings = &viewer->settings;
    if (lsf_ui_slider("Exposure", &settings->exposure, -8.0f, 8.0f, "%+.2f EV", false))
        viewer->tones_changed = true;
    lsf_ui_help("Multiplies radiance by 2 to this power; Ctrl+click to type");
    if (lsf_ui_choice("Tone curve", &settings->curve, curves, LSF_COUNT(curves)))
        viewer->tones_changed = true;
    lsf_ui_help("neutral preserves base colours, none is clamped at 1, aces and agx resemble film");
    if (lsf_ui_button("Expose for this picture"))
        viewer->expose_wanted = true;
    lsf_ui_help("Brings the picture's log-average luminance to middle grey");
}

static void picture_section(lsf_viewer *viewer)
{
    lsf_viewer_settings *settings = &viewer->settings;
    static const char *names[8];
    int count = 0;
    for (; count < 8 && lsf_technique_name((uint32_t)count); count++)
        names[count] = lsf_technique_name((uint32_t)count);
    int technique = settings->technique, samples = (int)settings->samples;
    if (lsf_ui_choice("Technique", &technique, names, count))
        lsf_viewer_set_technique(viewer, technique);
    lsf_ui_help(lsf_technique_help((uint32_t)technique));
    if (lsf_ui_slider_int("Iterations", &samples, 1, 1024, NULL, true)) {
        settings->samples = (uint32_t)(samples < 1 ? 1 : samples);
        lsf_viewer_touch_settings(viewer);
    }
    lsf_ui_help("Iterations of a finished still picture");
    int bounces = settings->bounces;
    if (lsf_ui_slider_int("Bounces", &bounces, -1, 16, bounces < 0 ? "as the scene asks" : NULL,
                          false)) {
        settings->bounces = bounces;
        lsf_viewer_touch_settings(viewer);
    }
    lsf_ui_help("Indirect bounces of light; 0 is direct light only; the leftmost position takes "
                "the scene's default");
    if (lsf_ui_check("Raw", &settings->raw))
        lsf_viewer_touch_settings(viewer);
    lsf_ui_help("The mean of the iterations without a filter");
}

static void background_choice(lsf_viewer *viewer)
{
    static const char *const names[] = {[LSF_BACKGROUND_AUTO] = "auto",
                                        [LSF_BACKGROUND_ENVIRONMENT] = "environment",
                                        [LSF_BACKGROUND_UNIFORM] = "uniform",
                                        [LSF_BACKGROUND_TRANSPARENT] = "transparent"};
    lsf_viewer_settings *settings = &viewer->settings;
    int background = (int)settings->background;
    bool changed = lsf_ui_choice("Background", &background, names, (int)LSF_COUNT(names));
    lsf_ui_help(
        "Background where no surface is; transparent is black in the window, and gives saved "
        "pictures an alpha channel");
    settings->background = (lsf_background)background;
    if (settings->background == LSF_BACKGROUND_UNIFORM)
        changed = lsf_ui_color3("Its radiance", settings->background_radiance) || changed;
    if (changed)
        lsf_viewer_touch_settings(viewer);
}

static void layer_choice(lsf_viewer *viewer)
{
    static const char *names[LSF_AOV_COUNT + 1];
    int count = 0;
    for (; lsf_viewer_layer_name(count); count++)
        names[count] = lsf_viewer_layer_name(count);
    if (lsf_ui_choice("Layer", &viewer->settings.layer, names, count))
        lsf_viewer_touch_settings(viewer);
    lsf_ui_help("Shows the picture or one of its layers; layers of voxels with voxel techniques");
}

/* --- options of passes --- */

static bool number_option(lsf_viewer_option *option)
{
    double low = 0.0, high = 1.0;
    char *end;
    low = lsf_read_number(option->range, &end);
    if (strncmp(end, "..", 2) == 0)
        high = lsf_read_number(end + 2, &end);
    bool wide = low >= 0.0 && high > 64.0 * fmax(low, 1.0);
    if (strcmp(option->type, "int") == 0) {
        int value = atoi(option->value);
        if (!lsf_ui_slider_int(option->key, &value, (int)low, (int)high, NULL, wide))
            return false;
        lsf_print(option->value, sizeof option->value, "%d", value);
        return true;
    }
    float value = (float)lsf_read_number(option->value, &end);
    if (!lsf_ui_slider(option->key, &value, (float)low, (float)high, "%.4g", wide))
        return false;
    value = fminf(fmaxf(value, (float)low), (float)high);
    lsf_print(option->value, sizeof option->value, "%.6g", (double)value);
    return true;
}

static bool choice_option(lsf_viewer_option *option)
{
    static char words[sizeof option->range];
    const char *names[12];
    int count = 0, value = 0;
    lsf_print(words, sizeof words, "%s", option->range);
    char *rest = words;
    for (char *word; count < 12 && (word = strsep(&rest, "|")) != NULL; count++) {
        names[count] = word;
        if (strcmp(word, option->value) == 0)
            value = count;
    }
    if (!lsf_ui_choice(option->key, &value, names, count))
        return false;
    lsf_print(option->value, sizeof option->value, "%s", names[value]);
    return true;
}

static bool switch_option(lsf_viewer_option *option)
{
    bool on = strcmp(option->value, "on") == 0 || strcmp(option->value, "true") == 0;
    if (!lsf_ui_check(option->key, &on))
        return false;
    lsf_print(option->value, sizeof option->value, "%s", on ? "on" : "off");
    return true;
}

static bool show_option(lsf_viewer_option *option)
{
    char help[640];
    bool changed = strcmp(option->type, "enum") == 0   ? choice_option(option)
                   : strcmp(option->type, "bool") == 0 ? switch_option(option)
                                                       : number_option(option);
    lsf_print(help, sizeof help, "%s\n\n-D %s=%s\nfrom %s, %s unless set%s%s", option->help,
              option->key, option->value, option->range, option->initial,
              option->unit[0] ? ", in " : "", option->unit);
    lsf_ui_help(help);
    return changed;
}

static size_t group_length(const char *key)
{
    return strcspn(key, ".");
}

/* How the passes begin that a group of options is of, where the name differs. */
static const char *pass_of(const char *group)
{
    static const char *const names[][2] = {
        {"shadow", "shadow_map"},       {"rsm", "reflective_shadow_map"},
        {"bundle", "ray_bundle"},       {"bidirectional", "bidirectional_shade"},
        {"voxel", "voxelize"},          {"cone", "cone_trace"},
        {"mis", "bidirectional_shade"}, {"environment", "sky"},
        {"interleave", "sparse"},       {"cloud", "vpl_cloud"},
    };
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        if (strcmp(names[i][0], group) == 0)
            return names[i][1];
    return group;
}

/* Whether the plan has that pass. */
static bool runs(const lsf_viewer *viewer, const char *group)
{
    char line[64];
    const char *passes = viewer->plan_text ? strstr(viewer->plan_text, "\npasses") : NULL;
    const char *end = passes ? strstr(passes, "\nresources") : NULL;
    lsf_print(line, sizeof line, "\n  %s", pass_of(group));
    const char *found = passes ? strstr(passes, line) : NULL;
    return !passes || (found && found < end) || strcmp(group, "tessellation") == 0;
}

static bool same_group(const lsf_viewer_option *a, const lsf_viewer_option *b)
{
    size_t length = group_length(a->key) + 1;
    return strncmp(a->key, b->key, length) == 0;
}

/* Whether options before that one are of its group, which may stand apart in the table. */
static bool comes_later(const lsf_viewer_settings *settings, uint32_t index)
{
    for (uint32_t i = 0; i < index; i++)
        if (same_group(&settings->options[index], &settings->options[i]))
            return true;
    return false;
}

static void option_group(lsf_viewer *viewer, uint32_t first, const char *group)
{
    lsf_viewer_settings *settings = &viewer->settings;
    char label[112];
    bool changed = false;
    for (uint32_t i = first; i < settings->option_count; i++)
        changed = changed || (same_group(&settings->options[first], &settings->options[i]) &&
                              lsf_viewer_option_changed(&settings->options[i]));
    lsf_print(label, sizeof label, "%s%s###%s", group, changed ? "  (set)" : "", group);
    if (!lsf_ui_section(label, false))
        return;
    for (uint32_t i = first; i < settings->option_count; i++)
        if (same_group(&settings->options[first], &settings->options[i]) &&
            show_option(&settings->options[i]))
            lsf_viewer_touch_settings(viewer);
}

static void option_groups(lsf_viewer *viewer, bool running)
{
    const lsf_viewer_settings *settings = &viewer->settings;
    for (uint32_t i = 0; i < settings->option_count; i++) {
        const char *key = settings->options[i].key;
        char group[48];
        lsf_print(group, sizeof group, "%.*s", (int)group_length(key), key);
        if (!comes_later(settings, i) && runs(viewer, group) == running)
            option_group(viewer, i, group);
    }
}

static void options_section(lsf_viewer *viewer)
{
    lsf_viewer_settings *settings = &viewer->settings;
    bool any = false;
    for (uint32_t i = 0; i < settings->option_count; i++)
        any = any || lsf_viewer_option_changed(&settings->options[i]);
    lsf_ui_disable_begin(!any);
    if (lsf_ui_button("Reset options")) {
        for (uint32_t i = 0; i < settings->option_count; i++)
            memcpy(settings->options[i].value, settings->options[i].initial,
                   sizeof settings->options[i].initial);
        lsf_viewer_touch_settings(viewer);
    }
    lsf_ui_disable_end();
    option_groups(viewer, true);
    lsf_ui_gap();
    if (lsf_ui_section("Passes that do not run", false))
        option_groups(viewer, false);
}

void lsf_viewer_picture_tab(lsf_viewer *viewer)
{
    lsf_ui_gap();
    picture_section(viewer);
    layer_choice(viewer);
    background_choice(viewer);
    lsf_ui_gap();
    display_section(viewer);
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_ACCENT, "Options of passes");
    options_section(viewer);
    lsf_ui_gap();
    if (lsf_ui_button("Copy command line"))
        lsf_viewer_copy_command(viewer);
    lsf_ui_help("The call of lightsheaf render that makes this very picture");
    lsf_ui_same_line();
    if (lsf_ui_button("Save view"))
        lsf_viewer_save_view(viewer);
}

/* --- times of passes --- */

static const uint32_t pass_colors[] = {0x4c8df0ff, 0xe8b04bff, 0x57b55cff, 0xe5534bff, 0xa57be0ff,
                                       0x4fc1c9ff, 0xe388b8ff, 0x9aa84fff, 0xc98a5cff, 0x7f8a99ff};

static void plot(const lsf_viewer_times *times)
{
    lsf_rect area = lsf_ui_area(7.0f);
    float most = 1e-3f, bar = area.width / (float)LSF_VIEWER_HISTORY;
    for (uint32_t f = 0; f < LSF_VIEWER_HISTORY; f++) {
        float sum = 0.0f;
        for (uint32_t i = 0; i < times->pass_count; i++)
            sum += times->milliseconds[f][i];
        most = fmaxf(most, sum);
    }
    lsf_ui_draw_begin(LSF_IN_PANEL, &area);
    lsf_ui_draw_rect(area, 0x00000040, true, 3.0f);
    for (uint32_t f = 0; f < LSF_VIEWER_HISTORY; f++) {
        const float *row = times->milliseconds[(times->next + f) % LSF_VIEWER_HISTORY];
        float base = area.y + area.height;
        for (uint32_t i = 0; i < times->pass_count; i++) {
            float high = 0.94f * area.height * row[i] / most;
            base -= high;
            lsf_ui_draw_rect((lsf_rect){area.x + bar * (float)f, base, bar, high},
                             pass_colors[i % LSF_COUNT(pass_colors)], true, 0.0f);
        }
    }
    char text[32];
    lsf_print(text, sizeof text, "%.1f ms", (double)most);
    lsf_ui_draw_text(area.x + 6.0f, area.y + 2.0f, lsf_ui_rgba(LSF_UI_DIM), text);
    lsf_ui_draw_end();
}

static void legend(const lsf_viewer_times *times)
{
    float sum = 0.0f, line = lsf_ui_em();
    for (uint32_t i = 0; i < times->pass_count; i++)
        sum += times->mean[i];
    for (uint32_t i = 0; i < times->pass_count; i++) {
        if (times->mean[i] < 1e-4f * sum)
            continue;
        lsf_rect area = lsf_ui_area(0.01f);
        lsf_ui_draw_begin(LSF_IN_PANEL, NULL);
        lsf_ui_draw_rect((lsf_rect){area.x, area.y + 0.5f * line, 0.7f * line, 0.7f * line},
                         pass_colors[i % LSF_COUNT(pass_colors)], true, 2.0f);
        lsf_ui_draw_end();
        lsf_ui_text(LSF_UI_TEXT, "     %s", times->names[i]);
        lsf_ui_at(16.0f);
        lsf_ui_text(LSF_UI_DIM, "%8.2f ms", (double)times->mean[i]);
    }
    lsf_ui_rule();
    lsf_ui_text(LSF_UI_TEXT, "     a frame");
    lsf_ui_at(16.0f);
    lsf_ui_text(LSF_UI_TEXT, "%8.2f ms", (double)sum);
}

static void memory_section(const lsf_viewer *viewer)
{
    lsf_context_info info = lsf_context_get_info(viewer->context);
    lsf_ui_text(LSF_UI_TEXT, "%.1f MiB of OpenGL, %.1f MiB at most", (double)info.gl_bytes / 0x1p20,
                (double)info.gl_bytes_peak / 0x1p20);
    if (viewer->still.renderer)
        lsf_ui_text(LSF_UI_DIM, "%.1f MiB of them for the still picture",
                    (double)lsf_plan_bytes(lsf_renderer_plan(viewer->still.renderer)) / 0x1p20);
    lsf_ui_text_wrapped(LSF_UI_DIM, viewer->device.renderer);
    lsf_ui_text_wrapped(LSF_UI_DIM, viewer->device.version);
}

void lsf_viewer_passes_tab(lsf_viewer *viewer)
{
    float budget = (float)(1e3 * viewer->budget.seconds);
    lsf_ui_gap();
    if (lsf_ui_slider("Frame budget", &budget, 5.0f, 1000.0f, "%.0f ms", true))
        viewer->budget.seconds = 1e-3 * (double)budget;
    lsf_ui_help("Time of a frame while something moves, which decides the size of pictures and "
                "the fineness of maps");
    lsf_ui_text(LSF_UI_DIM, "moving pictures at %.0f %% of the sides%s",
                100.0 * lsf_budget_scale(&viewer->budget),
                lsf_budget_coarse(&viewer->budget) > 0 ? ", coarser maps" : "");
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_ACCENT, "Milliseconds of passes");
    plot(&viewer->times);
    legend(&viewer->times);
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_ACCENT, "Memory");
    memory_section(viewer);
    lsf_ui_gap();
    lsf_ui_text(LSF_UI_ACCENT, "Plan of the still picture");
    if (viewer->plan_text)
        lsf_ui_listing("plan", viewer->plan_text, 22.0f);
}
