/* The passes, resources and switches that one plan has and another one has not. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "plan/flow.h"

static bool add_word(lsf_price_list *list, const char *first, const char *second)
{
    char *word = *second ? lsf_format("%s %s", first, second) : lsf_format("%s", first);
    if (!word || !lsf_grow((void **)&list->names, &list->capacity, list->count + 1ull,
                           sizeof *list->names)) {
        free(word);
        return false;
    }
    list->names[list->count++] = word;
    return true;
}

static bool compare_passes(const lsf_plan *with, const lsf_plan *without, lsf_price *price)
{
    for (uint64_t p = 0; p < with->pass_count; p++) {
        const lsf_plan_pass *pass = &with->passes[p];
        if (!lsf_plan_find_pass(without, pass->name)) {
            if (!add_word(&price->passes, pass->name, ""))
                return false;
            continue;
        }
        for (uint32_t i = 0; i < pass->switch_count; i++) {
            const lsf_define *define = &pass->switches[i].define;
            if (define->value && !lsf_plan_switch_value(without, pass->name, define->name) &&
                !add_word(&price->switches, pass->name, define->name))
                return false;
        }
    }
    return true;
}

static uint64_t count_kind(const lsf_plan *plan, const char *name)
{
    uint64_t count = 0;
    for (uint64_t i = 0; i < plan->resource_count; i++)
        count += lsf_plan_same_kind(plan->resources[i].name, name);
    return count;
}

/* "ray_bundle.keys x 16": their order does not matter. */
static bool compare_resources(const lsf_plan *with, const lsf_plan *without, lsf_price *price)
{
    for (uint64_t i = 0; i < with->resource_count; i++) {
        const char *name = with->resources[i].name;
        uint64_t before = count_kind(with, name), after = count_kind(without, name);
        if (!lsf_plan_starts_kind(with, i) || after >= before)
            continue;
        char kind[80];
        snprintf(kind, sizeof kind, "%.*s", (int)lsf_plan_kind_length(name), name);
        if (before - after > 1)
            snprintf(kind + strlen(kind), sizeof kind - strlen(kind), " x %u",
                     (unsigned)(before - after));
        if (!add_word(&price->resources, kind, ""))
            return false;
    }
    return true;
}

bool lsf_plan_price(const lsf_plan *with, const lsf_plan *without, lsf_price *price,
                    lsf_error *error)
{
    if (!lsf_given(with, "with", error) || !lsf_given(without, "without", error) ||
        !lsf_given(price, "price", error))
        return false;
    *price = (lsf_price){.bytes = (int64_t)lsf_plan_bytes(with) - (int64_t)lsf_plan_bytes(without)};
    if (compare_passes(with, without, price) && compare_resources(with, without, price))
        return true;
    lsf_price_finish(price);
    return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

static void finish_list(lsf_price_list *list)
{
    for (uint32_t i = 0; i < list->count; i++)
        free(list->names[i]);
    free(list->names);
}

void lsf_price_finish(lsf_price *price)
{
    if (!price)
        return;
    finish_list(&price->passes);
    finish_list(&price->switches);
    finish_list(&price->resources);
    *price = (lsf_price){0};
}
