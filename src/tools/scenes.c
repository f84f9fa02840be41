#include "tools/scenes.h"

#include "tools/interrupt.h"
#include "tools/report.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define STANDARD_INPUT "standard input" /* as messages call it */

/* The operand that is the first scene. */
static uint32_t first_scene(const lsf_settings *settings)
{
    return settings->command->bit == LSF_COMMAND_BENCH ? 1 : 0;
}

uint32_t lsf_tool_scene_count(const lsf_settings *settings)
{
    uint32_t first = first_scene(settings);
    return settings->operands.count > first ? settings->operands.count - first : 1;
}

/* Beside the executable, in the build folder or moved with its prefix; else where the build was
 * told to install it. */
static char *find_default_scene(void)
{
    static const char *const folders[] = {"/../data/scenes/", "/../share/lightsheaf/scenes/"};
    char self[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    self[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(self, '/');
    if (slash)
        *slash = '\0';
    for (size_t i = 0; i <= LSF_COUNT(folders); i++) {
        char *path = i < LSF_COUNT(folders) ? lsf_format("%s%sinterior.gltf", self, folders[i])
                                            : lsf_format("%s/scenes/interior.gltf", LSF_DATA_DIR);
        if (path && access(path, R_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}

char *lsf_tool_scene_path(const lsf_settings *settings, uint32_t index, lsf_error *error)
{
    uint32_t operand = first_scene(settings) + index;
    bool named = operand < settings->operands.count;
    char *path = named ? strdup(settings->operands.items[operand]) : find_default_scene();
    if (path)
        return path;
    if (named)
        lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    else
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "%s: needs a scene: the one that comes with Lightsheaf is not installed",
                      settings->command->name);
    return NULL;
}

static lsf_scene *load_standard_input(lsf_scene_params *params, lsf_error *error)
{
    if (isatty(STDIN_FILENO)) {
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "-: standard input is a terminal; redirect a .glb or .gltf into it, or give "
                      "the path of a scene");
        return NULL;
    }
    params->name = STANDARD_INPUT;
    size_t length;
    char *content = lsf_file_read_standard_input(params->memory_limit, &length, error);
    lsf_scene *scene = content ? lsf_scene_load_memory(content, length, NULL, params, error) : NULL;
    free(content);
    return scene;
}

lsf_scene *lsf_tool_load_scene(const lsf_settings *settings, const char *path, double *seconds,
                               lsf_error *error)
{
    lsf_scene_params params = lsf_settings_scene_params(settings);
    double start = lsf_now();
    lsf_scene *scene = strcmp(path, "-") == 0 ? load_standard_input(&params, error)
                                              : lsf_scene_load(path, &params, error);
    for (uint32_t i = 0; scene && i < settings->edits.count; i++)
        if (!lsf_scene_edit(scene, settings->edits.items[i], error)) {
            lsf_scene_destroy(scene);
            scene = NULL;
        }
    *seconds = lsf_now() - start;
    return scene;
}

/* --- each of them --- */

static void add_failure(lsf_json *json, const char *path, const lsf_error *error)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_string(json, "scene", path);
    lsf_json_string(json, "error", error->message);
    lsf_json_end(json, '}');
}

int lsf_tool_for_each_scene(const lsf_settings *settings, lsf_tool_scene_function *run, void *user)
{
    uint32_t count = lsf_tool_scene_count(settings);
    lsf_error error;
    lsf_json json = {0};
    int status = 0;
    if (count > 1)
        lsf_json_begin(&json, NULL, '[');
    bool ended = false;
    for (uint32_t i = 0; i < count && !ended; i++) {
        char *path = lsf_tool_scene_path(settings, i, &error);
        bool interrupted = i > 0 && lsf_interrupted();
        bool standard_input = path && strcmp(path, "-") == 0;
        lsf_report_about(count == 1 ? NULL : standard_input ? STANDARD_INPUT : path);
        bool good = path && !interrupted && run(user, i, path, &json, &error);
        if (path && interrupted)
            lsf_error_set(&error, LSF_ERROR_RENDER, "%s: interrupted before this scene%s", path,
                          i + 1 < count ? " and those behind it" : "");
        if (!good && path && count > 1)
            add_failure(&json, path, &error);
        if (!good && status == 0)
            status = (int)error.code;
        if (!good)
            lsf_report_error(&error);
        lsf_report_about(NULL);
        ended = interrupted || (!good && error.code == LSF_ERROR_NO_GL); /* of no other, either */
        free(path);
    }
    if (count > 1)
        lsf_json_end(&json, ']');
    if ((count > 1 || status == 0) && !lsf_json_write(&json, settings->json_path, &error)) {
        lsf_report_error(&error);
        status = status ? status : (int)error.code;
    }
    free(json.text.text);
    return status;
}
