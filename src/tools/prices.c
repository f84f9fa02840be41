#include "tools/prices.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

/* How the plan of a scene is made. */
typedef struct plan_maker {
    lsf_prices_plan *plan;
    const void *user;
} plan_maker;

/* NULL, with good true, where an animation needs the feature, or a shader of the user's own. */
static lsf_plan *plan_without(const lsf_scene *scene, const plan_maker *maker, lsf_feature feature,
                              bool *good, lsf_error *error)
{
    lsf_error cause = {0};
    lsf_scene *without = lsf_scene_without(scene, feature, &cause);
    lsf_plan *plan = without ? maker->plan(maker->user, without, &cause) : NULL;
    lsf_scene_destroy(without);
    *good = plan || cause.code == LSF_ERROR_USAGE ||
            lsf_error_set(error, cause.code, "%s", cause.message);
    return plan;
}

static bool add_feature(lsf_prices *prices, const lsf_scene *scene, const plan_maker *maker,
                        const lsf_plan *with, lsf_feature feature, lsf_error *error)
{
    bool good;
    lsf_plan *plan = plan_without(scene, maker, feature, &good, error);
    if (!plan)
        return good;
    lsf_feature_price *row = &prices->features[prices->count];
    *row = (lsf_feature_price){.feature = feature, .milliseconds = {NAN, NAN, NAN}};
    good = lsf_plan_price(with, plan, &row->price, error);
    prices->count += good;
    lsf_plan_destroy(plan);
    return good;
}

bool lsf_prices_make_of(lsf_prices *prices, const lsf_scene *scene, const lsf_render_params *params,
                        lsf_prices_plan *plan, const void *user, lsf_error *error)
{
    const plan_maker maker = {plan, user};
    *prices = (lsf_prices){
        .technique = params->technique, .width = params->width, .height = params->height};
    lsf_plan *with = plan(user, scene, error);
    bool good = with;
    for (int f = 0; good && f < LSF_FEATURE_COUNT; f++)
        if (lsf_scene_has(scene, (lsf_feature)f))
            good = add_feature(prices, scene, &maker, with, (lsf_feature)f, error);
    lsf_plan_destroy(with);
    return good;
}

static lsf_plan *plan_technique(const void *user, const lsf_scene *scene, lsf_error *error)
{
    return lsf_plan_create(scene, user, error);
}

bool lsf_prices_make(lsf_prices *prices, const lsf_scene *scene, const lsf_render_params *params,
                     lsf_error *error)
{
    return lsf_prices_make_of(prices, scene, params, plan_technique, params, error);
}

void lsf_prices_finish(lsf_prices *prices)
{
    for (uint32_t i = 0; i < prices->count; i++)
        lsf_price_finish(&prices->features[i].price);
    prices->count = 0;
}

/* --- text --- */

/* A few names, and how many more. */
static void add_names(lsf_string *text, const lsf_price_list *list, const char *what)
{
    enum { SHOWN = 3 };
    if (list->count == 0)
        return;
    lsf_string_add(text, "; %s ", what);
    for (uint32_t i = 0; i < list->count && i < SHOWN; i++)
        lsf_string_add(text, "%s%s", i ? ", " : "", list->names[i]);
    if (list->count > SHOWN)
        lsf_string_add(text, " and %u more", list->count - SHOWN);
}

static void add_size(lsf_string *text, int64_t bytes)
{
    lsf_string size = {0};
    lsf_string_add_size(&size, fabs((double)bytes));
    lsf_string_add(text, "%s%s", bytes < 0 ? "-" : "", size.text ? size.text : "");
    free(size.text);
}

/* Where the interval holds 0, what was measured is the machine's unrest. */
static void add_milliseconds(lsf_string *text, lsf_estimate saved)
{
    if (!isfinite(saved.value))
        return;
    bool shows = saved.low > 0.0 || saved.high < 0.0;
    lsf_string_add(text, "; %.3g ms (95 %%: %.3g to %.3g%s)", saved.value, saved.low, saved.high,
                   shows ? "" : ", nothing that shows");
}

void lsf_prices_add_text(lsf_string *text, const lsf_prices *prices)
{
    lsf_string_add(text, "%-18s %12s  %s\n", "without", "saved", "and what goes");
    for (uint32_t i = 0; i < prices->count; i++) {
        const lsf_feature_price *row = &prices->features[i];
        lsf_string bytes = {0}, rest = {0};
        add_size(&bytes, row->price.bytes);
        add_milliseconds(&rest, row->milliseconds);
        add_names(&rest, &row->price.passes, "passes");
        add_names(&rest, &row->price.resources, "resources");
        if (row->price.switches.count)
            lsf_string_add(&rest, "; %u switch%s", row->price.switches.count,
                           row->price.switches.count == 1 ? "" : "es");
        lsf_string_add(text, "%-18s %12s  %s\n", lsf_feature_name(row->feature),
                       bytes.text ? bytes.text : "", rest.text ? rest.text + 2 : "nothing");
        free(bytes.text);
        free(rest.text);
    }
    if (prices->count == 0)
        lsf_string_add(text, "nothing: the scene has none of the features with a cost\n");
}

/* --- JSON --- */

static void add_estimate(lsf_json *json, lsf_estimate saved)
{
    if (!isfinite(saved.value)) {
        lsf_json_string(json, "milliseconds", NULL);
        return;
    }
    lsf_json_begin(json, "milliseconds", '{');
    lsf_json_number(json, "value", saved.value);
    lsf_json_number(json, "low", saved.low);
    lsf_json_number(json, "high", saved.high);
    lsf_json_end(json, '}');
}

static void add_list(lsf_json *json, const char *name, const lsf_price_list *list)
{
    lsf_json_begin(json, name, '[');
    for (uint32_t i = 0; i < list->count; i++)
        lsf_json_string(json, NULL, list->names[i]);
    lsf_json_end(json, ']');
}

void lsf_prices_add_json(lsf_json *json, const char *name, const lsf_prices *prices)
{
    if (!prices->technique) {
        lsf_json_string(json, name, NULL);
        return;
    }
    lsf_json_begin(json, name, '{');
    lsf_json_string(json, "technique", prices->technique);
    lsf_json_vector(json, "resolution", (float[]){(float)prices->width, (float)prices->height}, 2);
    lsf_json_begin(json, "features", '[');
    for (uint32_t i = 0; i < prices->count; i++) {
        const lsf_feature_price *row = &prices->features[i];
        lsf_json_begin(json, NULL, '{');
        lsf_json_string(json, "feature", lsf_feature_name(row->feature));
        lsf_json_number(json, "bytes", (double)row->price.bytes);
        add_estimate(json, row->milliseconds);
        add_list(json, "passes", &row->price.passes);
        add_list(json, "resources", &row->price.resources);
        add_list(json, "switches", &row->price.switches);
        lsf_json_end(json, '}');
    }
    lsf_json_end(json, ']');
    lsf_json_end(json, '}');
}
