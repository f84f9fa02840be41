#include "base/base.h"
#include "tools/begin.h"
#include "tools/report.h"
#include "tools/tools.h"

static bool print_scene(const lsf_settings *settings, lsf_error *error)
{
    lsf_scene_params params = lsf_settings_scene_params(settings);
    lsf_scene *scene = lsf_scene_load(settings->operands.items[0], &params, error);
    if (!scene)
        return false;
    bool good = true;
    if (!lsf_settings_print_json(settings))
        good = lsf_tool_print("-", lsf_scene_describe(scene, false), error);
    if (good && settings->json_path)
        good = lsf_tool_print(settings->json_path, lsf_scene_describe(scene, true), error);
    lsf_scene_destroy(scene);
    return good;
}

int lsf_tool_info(int argc, char **argv)
{
    lsf_settings settings;
    lsf_error error;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_INFO, argc, argv);
    if (status == LSF_GO_ON) {
        /* What loading warns of is in the description; it is not said twice. */
        if (!settings.verbose)
            lsf_report_start(LSF_VERBOSITY_QUIET);
        status = print_scene(&settings, &error) ? 0 : lsf_report_error(&error);
    }
    lsf_settings_finish(&settings);
    return status;
}
