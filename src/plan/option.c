#include "plan/option.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

static const lsf_option_row *find_row(const lsf_option_table *tables, uint32_t table_count,
                                      const char *key, size_t length, size_t *offset)
{
    for (uint32_t t = 0; t < table_count; t++)
        for (uint32_t i = 0; i < tables[t].count; i++) {
            const lsf_option_row *row = &tables[t].rows[i];
            if (strlen(row->key) == length && strncmp(row->key, key, length) == 0) {
                *offset = tables[t].params_offset + row->offset;
                return row;
            }
        }
    return NULL;
}

/* Index of `text` among "a|b|c", or -1. */
static int choice_index(const char *choices, const char *text)
{
    size_t length = strlen(text);
    int index = 0;
    for (const char *at = choices; at; index++) {
        const char *end = strchr(at, '|');
        size_t choice_length = end ? (size_t)(end - at) : strlen(at);
        if (choice_length == length && strncmp(at, text, length) == 0)
            return index;
        at = end ? end + 1 : NULL;
    }
    return -1;
}

static void print_range(char *out, size_t size, const lsf_option_row *row)
{
    switch (row->type) {
    case LSF_OPTION_INT:
    case LSF_OPTION_FLOAT:
        lsf_print(out, size, "%.9g..%.9g", row->minimum, row->maximum);
        break;
    case LSF_OPTION_BOOL:
        snprintf(out, size, "on|off");
        break;
    case LSF_OPTION_ENUM:
        snprintf(out, size, "%s", row->choices);
        break;
    }
}

static bool set_value(const lsf_option_row *row, void *value, const char *text)
{
    char *end;
    if (row->type == LSF_OPTION_BOOL) {
        int on = choice_index("off|on|false|true|0|1", text);
        if (on >= 0)
            *(bool *)value = on & 1;
        return on >= 0;
    }
    if (row->type == LSF_OPTION_ENUM) {
        int choice = choice_index(row->choices, text);
        if (choice >= 0)
            *(int32_t *)value = choice;
        return choice >= 0;
    }
    double number =
        row->type == LSF_OPTION_INT ? (double)strtoll(text, &end, 10) : lsf_read_number(text, &end);
    if (end == text || *end || !isfinite(number) || number < row->minimum || number > row->maximum)
        return false;
    if (row->type == LSF_OPTION_INT)
        *(int32_t *)value = (int32_t)number;
    else
        *(float *)value = (float)number;
    return true;
}

/* Options of former versions and the options that do their work now; a point at the end stands
 * for all options of a pass. */
static const struct {
    const char *key, *instead;
} gone[] = {
    {"cone.scale", "sparse.grid=2 gathers light at every second pixel along both sides"},
    {"voxel_path.scale", "sparse.grid=2 gathers light at every second pixel along both sides"},
    {"upsample_search.radius", "sparse.radius"},
    {"upsample_search.min_cosine", "sparse.normal_weight"},
    {"upsample_search.slope", "sparse.slope"},
    {"interleave.periods", "sparse.blur=3 takes the place of the filter of two periods"},
    {"interleave.depth_weight", "sparse.blur has no such weight"},
    {"interleave.normal_weight", "sparse.blur has no such weight"},
    {"blur.phases", "sparse.blur"},
    {"bundle.room", "bundle.capacity"},
    {"cone.turn", "cone.rotate"},
    {"blur.", "sparse.blur is the one option of the blur"},
};

const char *lsf_option_replaced(const char *key)
{
    for (size_t i = 0; key && i < LSF_COUNT(gone); i++) {
        size_t length = strlen(gone[i].key);
        bool all = gone[i].key[length - 1] == '.';
        if (all ? strncmp(gone[i].key, key, length) == 0 : strcmp(gone[i].key, key) == 0)
            return gone[i].instead;
    }
    return NULL;
}

static bool refuse_unknown(const char *assignment, size_t length, lsf_error *error)
{
    char key[64];
    snprintf(key, sizeof key, "%.*s", (int)length, assignment);
    const char *instead = lsf_option_replaced(key);
    if (instead)
        return lsf_error_set(error, LSF_ERROR_USAGE, "-D %s: this option was replaced by: %s",
                             assignment, instead);
    return lsf_error_set(error, LSF_ERROR_USAGE,
                         "%s: no such option of a pass; lsf_option_list has all (lightsheaf "
                         "render --list-options)",
                         assignment);
}

bool lsf_option_set(const lsf_option_table *tables, uint32_t table_count, void *params,
                    const char *assignment, lsf_error *error)
{
    const char *equals = strchr(assignment, '=');
    if (!equals)
        return lsf_error_set(error, LSF_ERROR_USAGE, "-D %s: expected pass.key=value", assignment);
    size_t offset;
    const lsf_option_row *row =
        find_row(tables, table_count, assignment, (size_t)(equals - assignment), &offset);
    if (!row)
        return refuse_unknown(assignment, (size_t)(equals - assignment), error);
    if (set_value(row, (char *)params + offset, equals + 1))
        return true;
    char range[256];
    print_range(range, sizeof range, row);
    return lsf_error_set(error, LSF_ERROR_USAGE, "-D %s: '%s' is not allowed; %s takes %s%s%s",
                         assignment, equals + 1, row->key, range, row->unit[0] ? " " : "",
                         row->unit);
}

bool lsf_option_at(const lsf_option_table *tables, uint32_t table_count, uint32_t index,
                   lsf_option *option)
{
    static _Thread_local char range[256], value[64];
    static const char *const type_names[] = {"int", "float", "bool", "enum"};
    for (uint32_t t = 0; t < table_count; index -= tables[t++].count) {
        if (index >= tables[t].count)
            continue;
        const lsf_option_row *row = &tables[t].rows[index];
        const void *at = (const char *)tables[t].defaults + row->offset;
        print_range(range, sizeof range, row);
        if (row->type == LSF_OPTION_INT)
            snprintf(value, sizeof value, "%d", *(const int32_t *)at);
        else if (row->type == LSF_OPTION_FLOAT)
            lsf_print(value, sizeof value, "%g", (double)*(const float *)at);
        else if (row->type == LSF_OPTION_BOOL)
            snprintf(value, sizeof value, "%s", *(const bool *)at ? "on" : "off");
        else {
            const char *choice = row->choices;
            for (int32_t i = *(const int32_t *)at; i > 0; i--)
                choice = strchr(choice, '|') + 1;
            snprintf(value, sizeof value, "%.*s", (int)strcspn(choice, "|"), choice);
        }
        *option = (lsf_option){row->key, type_names[row->type], range, value, row->unit, row->help};
        return true;
    }
    return false;
}
