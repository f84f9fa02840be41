#include "base/base.h"
#include "tools/begin.h"
#include "tools/report.h"
#include "tools/tools.h"

#include <stdlib.h>

static bool print_plan(const lsf_settings *settings, lsf_error *error)
{
    char *path = lsf_tool_scene_path(settings, error);
    if (!path)
        return false;
    lsf_scene_params scene_params = lsf_settings_scene_params(settings);
    lsf_render_params params = lsf_settings_render_params(settings);
    lsf_plan *plan = NULL;
    lsf_scene *scene = lsf_scene_load(path, &scene_params, error);
    if (scene)
        plan = lsf_plan_create(scene, &params, error);
    bool good = plan != NULL;
    if (good && !lsf_settings_print_json(settings))
        good = lsf_tool_print("-", lsf_plan_describe(plan, false), error);
    if (good && settings->json_path)
        good = lsf_tool_print(settings->json_path, lsf_plan_describe(plan, true), error);
    lsf_plan_destroy(plan);
    lsf_scene_destroy(scene);
    free(path);
    return good;
}

int lsf_tool_plan(int argc, char **argv)
{
    lsf_settings settings;
    lsf_error error;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_PLAN, argc, argv);
    if (status == LSF_GO_ON)
        status = print_plan(&settings, &error) ? 0 : lsf_report_error(&error);
    lsf_settings_finish(&settings);
    return status;
}
