#include "tools/bench.h"

#include "tools/begin.h"
#include "tools/number.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/summary.h"
#include "tools/tools.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    bool (*run)(lsf_bench *bench, lsf_error *error);
} measurements[] = {
    {"rays", lsf_bench_rays},
    {"bidirectional", lsf_bench_frames},
    {"cone", lsf_bench_frames},
    {"voxel_path", lsf_bench_frames},
};

static const char *next_measurement(size_t index, void *user)
{
    (void)user;
    return index < LSF_COUNT(measurements) ? measurements[index].name : NULL;
}

bool lsf_bench_print(const lsf_bench *bench, lsf_error *error, const char *format, ...)
{
    if (lsf_settings_print_json(&bench->settings) || bench->settings.quiet)
        return true;
    va_list arguments;
    va_start(arguments, format);
    char *text = NULL;
    int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    bool good = lsf_file_write("-", text, (size_t)length, error);
    free(text);
    return good;
}

static bool start(lsf_bench *bench, lsf_error *error)
{
    double seconds;
    lsf_context_params params = lsf_settings_context_params(&bench->settings);
    bench->scene_path = lsf_tool_scene_path(&bench->settings, 0, error);
    if (bench->scene_path)
        bench->scene = lsf_tool_load_scene(&bench->settings, bench->scene_path, &seconds, error);
    if (bench->scene)
        bench->context = lsf_context_create(&params, error);
    if (!bench->context)
        return false;
    bench->device = lsf_context_get_info(bench->context);
    return true;
}

static void begin_json(lsf_bench *bench, const char *measurement)
{
    lsf_json *json = &bench->json;
    lsf_tool_begin_json(json, &bench->settings);
    lsf_json_string(json, "measurement", measurement);
    lsf_json_string(json, "scene", bench->scene_path);
    lsf_json_integer(json, "seed", bench->settings.seed);
    lsf_summary_add_device(json, &bench->device);
}

static bool end_json(lsf_bench *bench, lsf_error *error)
{
    lsf_json_end(&bench->json, '}');
    return lsf_json_write(&bench->json, bench->settings.json_path, error);
}

static bool run(lsf_bench *bench, lsf_error *error)
{
    const char *name = bench->settings.operands.items[0];
    for (size_t i = 0; i < LSF_COUNT(measurements); i++)
        if (strcmp(measurements[i].name, name) == 0) {
            if (!start(bench, error))
                return false;
            begin_json(bench, name);
            return measurements[i].run(bench, error) && end_json(bench, error);
        }
    const char *nearest = lsf_nearest(name, next_measurement, NULL);
    return lsf_error_set(error, LSF_ERROR_USAGE, "%s: no such measurement%s%s%s", name,
                         nearest ? "; did you mean "
                                 : "; bench takes rays, bidirectional, cone or voxel_path",
                         nearest ? nearest : "", nearest ? "?" : "");
}

int lsf_tool_bench(int argc, char **argv)
{
    lsf_bench bench = {0};
    lsf_error error;
    int status = lsf_tool_begin(&bench.settings, LSF_COMMAND_BENCH, argc, argv);
    if (status == LSF_GO_ON) {
        status = run(&bench, &error) ? 0 : lsf_report_error(&error);
        lsf_context_destroy(bench.context);
        lsf_scene_destroy(bench.scene);
        free(bench.scene_path);
        free(bench.json.text.text);
    }
    lsf_settings_finish(&bench.settings);
    return status;
}
