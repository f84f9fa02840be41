/* The plan as text and as JSON. */
#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "plan/flow.h"

static void describe_text(const lsf_plan *plan, lsf_string *out)
{
    lsf_string_add(out, "technique %s, %ux%u, ", plan->technique, plan->width, plan->height);
    if (plan->samples == UINT32_MAX)
        lsf_string_add(out, "as many iterations as the time limit allows");
    else
        lsf_string_add(out, "%u iteration%s", plan->samples, lsf_plural(plan->samples));
    if (plan->bounces > 0)
        lsf_string_add(out, ", %u bounce%s\n", plan->bounces, lsf_plural(plan->bounces));
    else
        lsf_string_add(out, ", no bounces\n");
    lsf_string_add(out, "\npasses, in order\n");
    for (uint64_t i = 0; i < plan->pass_count; i++) {
        const lsf_plan_pass *pass = &plan->passes[i];
        lsf_string_add(out, "  %-18s %s\n", pass->name, pass->why);
        for (uint32_t k = 0; k < pass->switch_count; k++)
            lsf_string_add(out, "    %-31s %-3d when %s\n", pass->switches[k].define.name,
                           pass->switches[k].define.value, pass->switches[k].when);
    }
    lsf_string_add(out, "\nresources\n");
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        const lsf_plan_resource *resource = &plan->resources[i];
        const lsf_texture_desc *texture = &resource->texture;
        lsf_string shape = {0};
        if (resource->is_buffer)
            lsf_string_add(&shape, "buffer");
        else
            lsf_string_add(&shape, "%s %ux%u", lsf_format_name(texture->internal_format) + 3,
                           texture->width, texture->height);
        if (texture->depth > 1)
            lsf_string_add(&shape, "x%u", texture->depth);
        if (texture->levels > 1)
            lsf_string_add(&shape, " mips");
        lsf_string size = {0};
        lsf_string_add_size(&size, (double)resource->bytes);
        lsf_string_add(out, "  %-26s %-34s %12s  %s\n", resource->name,
                       shape.text ? shape.text : "", size.text ? size.text : "", resource->why);
        free(shape.text);
        free(size.text);
    }
    lsf_string_add(out, "  total ");
    lsf_string_add_size(out, (double)lsf_plan_bytes(plan));
    lsf_string_add(out, "\n\nleft out\n");
    for (uint64_t i = 0; i < plan->omission_count; i++)
        lsf_string_add(out, "  %-26s %s\n", plan->omissions[i].name, plan->omissions[i].why);
    for (uint64_t i = 0; i < plan->remark_count; i++)
        lsf_string_add(out, "%snote: %s\n", i ? "" : "\n", plan->remarks[i]);
}

static void add_text_field(lsf_string *out, const char *key, const char *value)
{
    lsf_string_add(out, "\"%s\": ", key);
    lsf_string_add_json(out, value);
}

/* Stems of resources that a pass reads or fills. */
static void add_stems(const lsf_plan *plan, const lsf_plan_pass *pass, lsf_plan_flow flow,
                      lsf_string *out)
{
    const char *separator = "[";
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        const char *name = plan->resources[i].name;
        if (!lsf_plan_starts_stem(plan, i) || lsf_plan_flow_of(plan, pass, i) != flow)
            continue;
        lsf_string_add(out, "%s\"%.*s\"", separator, (int)lsf_plan_stem_length(name), name);
        separator = ", ";
    }
    lsf_string_add(out, "%s]", *separator == '[' ? "[" : "");
}

static void describe_json(const lsf_plan *plan, lsf_string *out)
{
    lsf_string_add(out, "{\n  ");
    add_text_field(out, "technique", plan->technique);
    lsf_string_add(out, ",\n  \"resolution\": [%u, %u], \"samples\": ", plan->width, plan->height);
    lsf_string_add_json_number(out, plan->samples == UINT32_MAX ? INFINITY : plan->samples);
    lsf_string_add(out, ", \"bounces\": %u,\n  \"bytes\": %llu,\n  \"passes\": [", plan->bounces,
                   (unsigned long long)lsf_plan_bytes(plan));
    for (uint64_t i = 0; i < plan->pass_count; i++) {
        const lsf_plan_pass *pass = &plan->passes[i];
        lsf_string_add(out, "%s\n    {", i ? "," : "");
        add_text_field(out, "name", pass->name);
        lsf_string_add(out, ", ");
        add_text_field(out, "why", pass->why);
        lsf_string_add(out, ", \"switches\": [");
        for (uint32_t k = 0; k < pass->switch_count; k++) {
            lsf_string_add(out, "%s\n      {", k ? "," : "");
            add_text_field(out, "name", pass->switches[k].define.name);
            lsf_string_add(out, ", \"value\": %d, ", pass->switches[k].define.value);
            add_text_field(out, "when", pass->switches[k].when);
            lsf_string_add(out, "}");
        }
        lsf_string_add(out, "], \"reads\": ");
        add_stems(plan, pass, LSF_PLAN_READS, out);
        lsf_string_add(out, ", \"fills\": ");
        add_stems(plan, pass, LSF_PLAN_FILLS, out);
        lsf_string_add(out, "}");
    }
    lsf_string_add(out, "],\n  \"resources\": [");
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        const lsf_plan_resource *resource = &plan->resources[i];
        lsf_string_add(out, "%s\n    {", i ? "," : "");
        add_text_field(out, "name", resource->name);
        lsf_string_add(out, ", \"kind\": \"%s\"", resource->is_buffer ? "buffer" : "texture");
        if (!resource->is_buffer)
            lsf_string_add(out,
                           ", \"format\": \"%s\", \"width\": %u, \"height\": %u, \"depth\": %u, "
                           "\"levels\": %u",
                           lsf_format_name(resource->texture.internal_format),
                           resource->texture.width, resource->texture.height,
                           resource->texture.depth, resource->texture.levels);
        lsf_string_add(out, ", \"bytes\": %llu, ", (unsigned long long)resource->bytes);
        add_text_field(out, "why", resource->why);
        lsf_string_add(out, "}");
    }
    lsf_string_add(out, "],\n  \"left_out\": [");
    for (uint64_t i = 0; i < plan->omission_count; i++) {
        lsf_string_add(out, "%s\n    {", i ? "," : "");
        add_text_field(out, "name", plan->omissions[i].name);
        lsf_string_add(out, ", ");
        add_text_field(out, "why", plan->omissions[i].why);
        lsf_string_add(out, "}");
    }
    lsf_string_add(out, "],\n  \"notes\": [");
    for (uint64_t i = 0; i < plan->remark_count; i++) {
        lsf_string_add(out, "%s\n    ", i ? "," : "");
        lsf_string_add_json(out, plan->remarks[i]);
    }
    lsf_string_add(out, "]\n}\n");
}

char *lsf_plan_describe(const lsf_plan *plan, bool json)
{
    if (!plan)
        return NULL;
    lsf_string out = {0};
    if (json)
        describe_json(plan, &out);
    else
        describe_text(plan, &out);
    if (out.failed) {
        free(out.text);
        return NULL;
    }
    return out.text;
}
