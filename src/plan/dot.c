/* The plan as a graph in the language of Graphviz ("The DOT Language", graphviz.org). */
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "plan/flow.h"
#include "plan/plan.h"

/* Within a quoted string. */
static void add_quoted(lsf_string *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        lsf_string_add(out, text[i] == '"' || text[i] == '\\' ? "\\%c" : "%c", text[i]);
}

static void add_kind(const lsf_plan *plan, uint64_t first, lsf_string *out)
{
    const lsf_plan_resource *resource = &plan->resources[first];
    uint64_t count = 0, bytes = 0;
    bool alike = !resource->is_buffer;
    for (uint64_t i = first; i < plan->resource_count; i++)
        if (lsf_plan_same_kind(resource->name, plan->resources[i].name)) {
            count++;
            bytes += plan->resources[i].bytes;
            alike &= plan->resources[i].bytes == resource->bytes;
        }
    size_t length = lsf_plan_kind_length(resource->name),
           stem = lsf_plan_stem_length(resource->name);
    size_t shown = stem < length ? stem + 1 : 0; /* "depth" of "gbuffer.depth" */
    add_quoted(out, resource->name + shown, length - shown);
    if (count > 1)
        lsf_string_add(out, " x %llu", (unsigned long long)count);
    if (alike)
        lsf_string_add(out, ", %s %ux%u", lsf_format_name(resource->texture.internal_format) + 3,
                       resource->texture.width, resource->texture.height);
    lsf_string_add(out, ", ");
    lsf_string_add_size(out, (double)bytes);
    lsf_string_add(out, "\\l");
}

/* Resources of a stem are one node. */
static void add_stem(const lsf_plan *plan, uint64_t first, lsf_string *out)
{
    const char *name = plan->resources[first].name;
    uint64_t bytes = 0;
    for (uint64_t i = first; i < plan->resource_count; i++)
        if (lsf_plan_same_stem(name, plan->resources[i].name))
            bytes += plan->resources[i].bytes;
    lsf_string_add(out, "  \"resources ");
    add_quoted(out, name, lsf_plan_stem_length(name));
    lsf_string_add(out, "\" [shape=note, fillcolor=\"#eef3f8\", label=\"");
    add_quoted(out, name, lsf_plan_stem_length(name));
    lsf_string_add(out, ", ");
    lsf_string_add_size(out, (double)bytes);
    lsf_string_add(out, "\\l");
    for (uint64_t i = first; i < plan->resource_count; i++)
        if (lsf_plan_same_stem(name, plan->resources[i].name) && lsf_plan_starts_kind(plan, i))
            add_kind(plan, i, out);
    lsf_string_add(out, "\"];\n");
}

static void add_pass(const lsf_plan *plan, uint64_t index, lsf_string *out)
{
    const lsf_plan_pass *pass = &plan->passes[index];
    lsf_string_add(out, "  \"%s\" [shape=box, fillcolor=\"#fbf1df\", label=\"%llu  %s\\l",
                   pass->name, (unsigned long long)index + 1, pass->name);
    add_quoted(out, pass->why, strlen(pass->why));
    lsf_string_add(out, "\\l");
    for (uint32_t i = 0; i < pass->switch_count; i++) {
        const lsf_define *define = &pass->switches[i].define;
        if (define->value != 0)
            lsf_string_add(out, "%s %d\\l", define->name, define->value);
    }
    lsf_string_add(out, "\"];\n");
    if (index > 0)
        lsf_string_add(out, "  \"%s\" -> \"%s\" [style=dotted, arrowhead=none, weight=8];\n",
                       plan->passes[index - 1].name, pass->name);
}

static void add_edges(const lsf_plan *plan, uint64_t first, lsf_string *out)
{
    const char *name = plan->resources[first].name;
    for (uint64_t p = 0; p < plan->pass_count; p++) {
        const lsf_plan_pass *pass = &plan->passes[p];
        lsf_plan_flow flow = lsf_plan_flow_of(plan, pass, first);
        if (flow == LSF_PLAN_FILLS) {
            lsf_string_add(out, "  \"%s\" -> \"resources ", pass->name);
            add_quoted(out, name, lsf_plan_stem_length(name));
            lsf_string_add(out, "\" [color=\"#b5651d\"];\n");
        } else if (flow == LSF_PLAN_READS) {
            lsf_string_add(out, "  \"resources ");
            add_quoted(out, name, lsf_plan_stem_length(name));
            lsf_string_add(out, "\" -> \"%s\" [color=\"#4a7aa7\"];\n", pass->name);
        }
    }
}

char *lsf_plan_dot(const lsf_plan *plan)
{
    if (!plan)
        return NULL;
    lsf_string out = {0};
    lsf_string_add(&out,
                   "digraph plan {\n"
                   "  graph [label=\"%s, %ux%u, ",
                   plan->technique, plan->width, plan->height);
    lsf_string_add_size(&out, (double)lsf_plan_bytes(plan));
    lsf_string_add(&out, "\", labelloc=t, fontname=\"sans-serif\"];\n"
                         "  edge [arrowsize=0.7];\n"
                         "  node [style=filled, fontname=\"sans-serif\", fontsize=10];\n");
    for (uint64_t i = 0; i < plan->pass_count; i++)
        add_pass(plan, i, &out);
    for (uint64_t i = 0; i < plan->resource_count; i++)
        if (lsf_plan_starts_stem(plan, i)) {
            add_stem(plan, i, &out);
            add_edges(plan, i, &out);
        }
    lsf_string_add(&out, "}\n");
    if (out.failed) {
        free(out.text);
        return NULL;
    }
    return out.text;
}
