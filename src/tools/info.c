#include "base/base.h"
#include "tools/begin.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/tools.h"

static void add_json(const lsf_settings *settings, char *description, lsf_json *json)
{
    lsf_tool_begin_json(json, settings);
    lsf_json_members(json, description);
    lsf_json_end(json, '}');
}

static bool print_picture(const lsf_settings *settings, uint32_t index, const char *path,
                          lsf_json *json, lsf_error *error)
{
    char *text = lsf_image_describe(path, false, error);
    bool good = text && lsf_tool_print(settings, index, text, error);
    if (good)
        add_json(settings, lsf_image_describe(path, true, error), json);
    return good;
}

static bool print_file(void *user, uint32_t index, const char *path, lsf_json *json,
                       lsf_error *error)
{
    const lsf_settings *settings = user;
    double seconds;
    if (lsf_image_recognise(path))
        return print_picture(settings, index, path, json, error);
    lsf_scene *scene = lsf_tool_load_scene(settings, path, &seconds, error);
    if (!scene)
        return false;
    bool good = lsf_tool_print(settings, index, lsf_scene_describe(scene, false), error);
    if (good)
        add_json(settings, lsf_scene_describe(scene, true), json);
    lsf_scene_destroy(scene);
    return good;
}

int lsf_tool_info(int argc, char **argv)
{
    lsf_settings settings;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_INFO, argc, argv);
    if (status == LSF_GO_ON) {
        /* What loading warns of is in the description; it is not said twice. */
        if (!settings.verbose)
            lsf_report_start(LSF_VERBOSITY_QUIET);
        status = lsf_tool_for_each_scene(&settings, print_file, &settings);
    }
    lsf_settings_finish(&settings);
    return status;
}
