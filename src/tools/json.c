#include "tools/json.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void start_value(lsf_json *json, const char *name)
{
    if (json->depth)
        lsf_string_add(&json->text, "%s\n%*s", json->filled ? "," : "", 2 * (int)json->depth, "");
    json->filled = true;
    if (name) {
        lsf_string_add_json(&json->text, name);
        lsf_string_add_bytes(&json->text, ": ", 2);
    }
}

void lsf_json_begin(lsf_json *json, const char *name, char bracket)
{
    start_value(json, name);
    lsf_string_add_bytes(&json->text, &bracket, 1);
    json->depth++;
    json->filled = false;
}

void lsf_json_end(lsf_json *json, char bracket)
{
    json->depth--;
    if (json->filled)
        lsf_string_add(&json->text, "\n%*s", 2 * (int)json->depth, "");
    lsf_string_add_bytes(&json->text, &bracket, 1);
    if (json->depth == 0)
        lsf_string_add_bytes(&json->text, "\n", 1);
    json->filled = true;
}

void lsf_json_string(lsf_json *json, const char *name, const char *value)
{
    start_value(json, name);
    if (value)
        lsf_string_add_json(&json->text, value);
    else
        lsf_string_add_bytes(&json->text, "null", 4);
}

void lsf_json_number(lsf_json *json, const char *name, double value)
{
    start_value(json, name);
    lsf_string_add_json_number(&json->text, value);
}

void lsf_json_integer(lsf_json *json, const char *name, uint64_t value)
{
    start_value(json, name);
    lsf_string_add(&json->text, "%" PRIu64, value);
}

void lsf_json_bool(lsf_json *json, const char *name, bool value)
{
    start_value(json, name);
    lsf_string_add(&json->text, value ? "true" : "false");
}

void lsf_json_vector(lsf_json *json, const char *name, const float *values, uint32_t count)
{
    start_value(json, name);
    if (!values) {
        lsf_string_add_bytes(&json->text, "null", 4);
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        lsf_string_add(&json->text, i ? ", " : "[");
        lsf_string_add_json_number(&json->text, values[i]);
    }
    lsf_string_add_bytes(&json->text, "]", 1);
}

void lsf_json_members(lsf_json *json, char *object)
{
    char *first = object ? strchr(object, '{') : NULL, *last = first ? strrchr(first, '}') : NULL;
    json->text.failed |= !object;
    if (last) {
        do
            *last = '\0'; /* removes the blanks before it as well */
        while (last > first + 1 && strchr(" \n", *--last));
        start_value(json, NULL);
        first += 1 + strspn(first + 1, " \n");
        lsf_string_add_bytes(&json->text, first, strlen(first));
    }
    free(object);
}

bool lsf_json_write(const lsf_json *json, const char *path, lsf_error *error)
{
    if (!path)
        return true;
    if (json->text.failed)
        return lsf_error_set(error, LSF_ERROR_RENDER, "--json %s: no memory left", path);
    return lsf_file_write(path, json->text.text, json->text.length, error);
}
