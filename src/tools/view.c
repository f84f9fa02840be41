#include "view/view.h"

#include "base/base.h"
#include "tools/begin.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/tools.h"

#include <stdlib.h>
#include <string.h>

static bool print_keys(const lsf_window_module *module, lsf_error *error)
{
    lsf_string text = {0};
    lsf_viewer_key_row row;
    for (uint32_t i = 0; module->view_key(i, &row); i++)
        lsf_string_add(&text, "%-30s %s\n", row.keys, row.effect);
    bool good = text.failed ? lsf_error_set(error, LSF_ERROR_RENDER, "no memory left")
                            : lsf_file_write("-", text.text, text.length, error);
    free(text.text);
    return good;
}

/* The folder of the scenes that come with Lightsheaf; NULL where they are not installed. */
static char *find_scenes(const lsf_settings *settings)
{
    lsf_settings none = {.command = settings->command};
    lsf_error error;
    char *path = lsf_tool_scene_path(&none, 0, &error);
    char *slash = path ? strrchr(path, '/') : NULL;
    if (slash)
        *slash = '\0';
    return path;
}

static bool view(const lsf_window_module *module, const lsf_settings *settings, lsf_error *error)
{
    char *folder = find_scenes(settings);
    lsf_viewer_start start = {
        .paths = settings->operands.items,
        .path_count = settings->operands.count,
        .scene_folder = folder,
        .scene = lsf_settings_scene_params(settings),
        .edits = settings->edits.items,
        .edit_count = settings->edits.count,
        .render = lsf_settings_render_params(settings),
        .auto_exposure = settings->exposure.automatic,
        .exposure = settings->exposure.ev,
        .curve = (lsf_tone_curve)settings->tonemap,
        .budget = 1e-3 * settings->budget,
        .frame_times = settings->frame_times,
        .window = {LSF_WINDOW_PARAMS_DEFAULTS},
    };
    start.window.full_screen = settings->full_screen;
    start.window.shader_dir = settings->shader_dir;
    start.window.record = settings->record;
    start.window.replay = settings->replay;
    start.window.coverage = settings->coverage;
    if (lsf_settings_given(settings, "resolution")) {
        start.window.width = settings->resolution[0];
        start.window.height = settings->resolution[1];
    }
    bool good = module->view(&start, error);
    free(folder);
    return good;
}

int lsf_tool_view(int argc, char **argv)
{
    static const void *table;
    lsf_settings settings;
    lsf_error error;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_VIEW, argc, argv);
    if (status == LSF_GO_ON) {
        const lsf_window_module *module =
            lsf_module_table(LSF_WINDOW_MODULE_NAME, LSF_WINDOW_MODULE_TABLE,
                             "it comes with Lightsheaf, and needs libglfw3", &table, &error);
        bool good = module && (settings.list_keys ? print_keys(module, &error)
                                                  : view(module, &settings, &error));
        status = good ? 0 : lsf_report_error(&error);
    }
    lsf_settings_finish(&settings);
    return status;
}
