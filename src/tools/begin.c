#include "tools/begin.h"

#include "base/base.h"
#include "tools/help.h"
#include "tools/report.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The text that --help and its like ask for; false when none does. */
static bool add_answer(lsf_string *text, const lsf_settings *settings)
{
    if (settings->help)
        lsf_help_command(text, settings->command);
    else if (settings->version)
        lsf_string_add(text, "lightsheaf %s\n", lsf_version());
    else if (settings->list_techniques)
        lsf_help_techniques(text);
    else if (settings->list_options)
        lsf_help_pass_options(text);
    else
        return false;
    return true;
}

int lsf_tool_begin(lsf_settings *settings, lsf_command_bit command, int argc, char **argv)
{
    lsf_error error;
    bool good = lsf_settings_parse(settings, command, argc, argv, &error);
    lsf_report_start(settings->quiet     ? LSF_VERBOSITY_QUIET
                     : settings->verbose ? LSF_VERBOSITY_VERBOSE
                                         : LSF_VERBOSITY_NORMAL);
    if (!good)
        return lsf_report_error(&error);
    lsf_string text = {0};
    int status = LSF_GO_ON;
    if (add_answer(&text, settings))
        status = lsf_file_write("-", text.text, text.length, &error) ? 0 : lsf_report_error(&error);
    else if (settings->json_path && !lsf_file_can_write(settings->json_path, &error))
        status = lsf_report_error(&error);
    free(text.text);
    return status;
}

char *lsf_tool_scene_path(const lsf_settings *settings, lsf_error *error)
{
    char *path = NULL;
    uint32_t operand = settings->command->operands_min; /* behind those that have to be there */
    if (settings->operands.count > operand) {
        path = strdup(settings->operands.items[operand]);
        if (!path)
            lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
        return path;
    }

    /* Beside the executable, in the build folder or moved with its prefix; else where the build
     * was told to install it. */
    static const char *const folders[] = {"/../data/scenes/", "/../share/lightsheaf/scenes/"};
    char self[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(self, '/');
    if (slash)
        *slash = '\0';
    for (size_t i = 0; i <= LSF_COUNT(folders); i++) {
        path = i < LSF_COUNT(folders) ? lsf_format("%s%sinterior.gltf", self, folders[i])
                                      : lsf_format("%s/scenes/interior.gltf", LSF_DATA_DIR);
        if (path && access(path, R_OK) == 0)
            return path;
        free(path);
    }
    lsf_error_set(error, LSF_ERROR_USAGE,
                  "%s: needs a scene: the one that comes with Lightsheaf is not installed",
                  settings->command->name);
    return NULL;
}

lsf_scene *lsf_tool_load_scene(const lsf_settings *settings, char **path, double *seconds,
                               lsf_error *error)
{
    lsf_scene_params params = lsf_settings_scene_params(settings);
    double start = lsf_now();
    *path = lsf_tool_scene_path(settings, error);
    lsf_scene *scene = *path ? lsf_scene_load(*path, &params, error) : NULL;
    *seconds = lsf_now() - start;
    return scene;
}

bool lsf_tool_print(const char *path, char *text, lsf_error *error)
{
    bool good = text ? lsf_file_write(path, text, strlen(text), error)
                     : lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    free(text);
    return good;
}
