#include "plan/flow.h"

#include <ctype.h>
#include <string.h>

/* "gbuffer" is "gbuffer.depth" and all other resources of that stem; "view" is one resource. */
static bool names(const char *word, size_t length, const char *resource)
{
    return strncmp(word, resource, length) == 0 &&
           (resource[length] == '\0' || resource[length] == '.');
}

static bool is_listed(const lsf_plan *plan, const char *word, size_t length)
{
    for (uint64_t i = 0; i < plan->resource_count; i++)
        if (names(word, length, plan->resources[i].name))
            return true;
    return false;
}

/* Whether the first of "a|b|c" that the plan lists names the resource. */
static bool choice_names(const lsf_plan *plan, const char *choice, size_t size,
                         const char *resource)
{
    const char *end = choice + size;
    while (choice < end) {
        size_t length = strcspn(choice, "| ");
        if (is_listed(plan, choice, length))
            return names(choice, length, resource);
        choice += length + 1;
    }
    return false;
}

static bool list_names(const lsf_plan *plan, const char *list, const char *resource)
{
    while (*list) {
        size_t size = strcspn(list, " ");
        if (choice_names(plan, list, size, resource))
            return true;
        list += size + (list[size] == ' ');
    }
    return false;
}

bool lsf_plan_pass_reads(const lsf_plan *plan, const lsf_plan_pass *pass, const char *resource)
{
    for (int i = 0; pass->reads[i]; i++)
        if (list_names(plan, pass->reads[i], resource))
            return true;
    return false;
}

bool lsf_plan_pass_fills(const lsf_plan_pass *pass, const char *resource)
{
    const char *name = pass->fills ? pass->fills : pass->name;
    size_t stem = lsf_plan_stem_length(resource);
    return strncmp(resource, name, stem) == 0 && (name[stem] == '\0' || name[stem] == '_');
}

size_t lsf_plan_stem_length(const char *resource)
{
    return strcspn(resource, ".");
}

bool lsf_plan_same_stem(const char *a, const char *b)
{
    size_t length = lsf_plan_stem_length(a);
    return lsf_plan_stem_length(b) == length && strncmp(a, b, length) == 0;
}

bool lsf_plan_starts_stem(const lsf_plan *plan, uint64_t resource)
{
    for (uint64_t i = 0; i < resource; i++)
        if (lsf_plan_same_stem(plan->resources[i].name, plan->resources[resource].name))
            return false;
    return true;
}

size_t lsf_plan_kind_length(const char *resource)
{
    size_t length = strlen(resource), digits = length;
    while (digits > 0 && isdigit((unsigned char)resource[digits - 1]))
        digits--;
    bool numbered = digits < length && digits > 1 && strchr("._", resource[digits - 1]);
    return numbered ? digits - 1 : length;
}

bool lsf_plan_same_kind(const char *a, const char *b)
{
    size_t length = lsf_plan_kind_length(a);
    return lsf_plan_kind_length(b) == length && strncmp(a, b, length) == 0;
}

bool lsf_plan_starts_kind(const lsf_plan *plan, uint64_t resource)
{
    for (uint64_t i = 0; i < resource; i++)
        if (lsf_plan_same_kind(plan->resources[i].name, plan->resources[resource].name))
            return false;
    return true;
}

lsf_plan_flow lsf_plan_flow_of(const lsf_plan *plan, const lsf_plan_pass *pass, uint64_t first)
{
    lsf_plan_flow flow = LSF_PLAN_NO_FLOW;
    for (uint64_t i = first; i < plan->resource_count; i++) {
        const char *resource = plan->resources[i].name;
        if (!lsf_plan_same_stem(resource, plan->resources[first].name))
            continue;
        if (lsf_plan_pass_fills(pass, resource))
            return LSF_PLAN_FILLS;
        if (lsf_plan_pass_reads(plan, pass, resource))
            flow = LSF_PLAN_READS;
    }
    return flow;
}
