#include "base/base.h"
#include "tools/begin.h"
#include "tools/prices.h"
#include "tools/report.h"
#include "tools/sandbox.h"
#include "tools/scenes.h"
#include "tools/tools.h"

static lsf_plan *plan_sandbox(const void *user, const lsf_scene *scene, lsf_error *error)
{
    return lsf_sandbox_plan(scene, user, error);
}

static bool make_prices(lsf_prices *prices, const lsf_settings *settings, const lsf_scene *scene,
                        lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(settings);
    if (!settings->sandbox)
        return lsf_prices_make(prices, scene, &params, error);
    lsf_sandbox_params sandbox = lsf_settings_sandbox_params(settings);
    return lsf_prices_make_of(prices, scene, &params, plan_sandbox, &sandbox, error);
}

static bool print_prices(const lsf_settings *settings, uint32_t index, const char *path,
                         const lsf_scene *scene, lsf_json *json, lsf_error *error)
{
    lsf_prices prices;
    lsf_string text = {0};
    bool good = make_prices(&prices, settings, scene, error);
    if (good) {
        lsf_prices_add_text(&text, &prices);
        good = lsf_tool_print(settings, index, text.text, error);
    }
    if (good) {
        lsf_tool_begin_json(json, settings);
        lsf_json_string(json, "scene", path);
        lsf_prices_add_json(json, "prices", &prices);
        lsf_json_end(json, '}');
    }
    lsf_prices_finish(&prices);
    return good;
}

/* NULL: it could not be made. Destroys the plan. */
static bool print_whole(const lsf_settings *settings, uint32_t index, const char *path,
                        lsf_plan *plan, lsf_json *json, lsf_error *error)
{
    bool good =
        plan &&
        lsf_tool_print(settings, index,
                       settings->dot ? lsf_plan_dot(plan) : lsf_plan_describe(plan, false), error);
    if (good) {
        lsf_tool_begin_json(json, settings);
        lsf_json_string(json, "scene", path);
        lsf_json_members(json, lsf_plan_describe(plan, true));
        lsf_json_end(json, '}');
    }
    lsf_plan_destroy(plan);
    return good;
}

static bool print_plan(void *user, uint32_t index, const char *path, lsf_json *json,
                       lsf_error *error)
{
    const lsf_settings *settings = user;
    lsf_render_params params = lsf_settings_render_params(settings);
    double seconds;
    lsf_scene *scene = lsf_tool_load_scene(settings, path, &seconds, error);
    bool good = scene;
    if (good && settings->prices)
        good = print_prices(settings, index, path, scene, json, error);
    else if (good)
        good =
            print_whole(settings, index, path, lsf_plan_create(scene, &params, error), json, error);
    lsf_scene_destroy(scene);
    return good;
}

/* Of a shader of somebody's own, with or without a scene. */
static bool print_sandbox(void *user, uint32_t index, const char *path, lsf_json *json,
                          lsf_error *error)
{
    const lsf_settings *settings = user;
    lsf_sandbox_params params = lsf_settings_sandbox_params(settings);
    bool named = settings->operands.count > 0;
    double seconds;
    if (settings->prices && !named)
        return lsf_error_set(error, LSF_ERROR_USAGE, "--prices: needs a scene after the shader");
    lsf_scene *scene = named ? lsf_tool_load_scene(settings, path, &seconds, error) : NULL;
    bool good = scene || !named;
    if (good && settings->prices)
        good = print_prices(settings, index, path, scene, json, error);
    else if (good)
        good = print_whole(settings, index, named ? path : NULL,
                           lsf_sandbox_plan(scene, &params, error), json, error);
    lsf_scene_destroy(scene);
    return good;
}

int lsf_tool_plan(int argc, char **argv)
{
    lsf_settings settings;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_PLAN, argc, argv);
    if (status == LSF_GO_ON)
        status = lsf_tool_for_each_scene(&settings, settings.sandbox ? print_sandbox : print_plan,
                                         &settings);
    lsf_settings_finish(&settings);
    return status;
}
