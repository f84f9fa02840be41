#include "tools/preset.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "tools/imprint.h"
#include "tools/number.h"
#include "tools/value.h"

enum { LARGEST = 1 << 16 }; /* bytes */

/* Options that say where a picture goes, and what is reported about it, are for the command line
 * alone. */
static bool may_stand(const lsf_command_option *option)
{
    static const char *const groups[] = {"Picture", "Camera", "Scene"};
    static const char *const others[] = {"exposure", "tonemap", "resolution", "technique",
                                         "samples"};
    for (size_t i = 0; i < LSF_COUNT(others); i++)
        if (strcmp(option->name, others[i]) == 0)
            return true;
    for (size_t i = 0; i < LSF_COUNT(groups); i++)
        if (strcmp(option->group, groups[i]) == 0)
            return strcmp(option->name, "preset") != 0 && strcmp(option->name, "view") != 0;
    return false;
}

static const char *next_name(size_t index, void *user)
{
    const lsf_command *command = user;
    size_t seen = 0;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if ((option->commands & command->bit) && may_stand(option) && seen++ == index)
            return option->name;
    }
    return NULL;
}

static const lsf_command_option *find(const lsf_command *command, const char *name)
{
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if ((option->commands & command->bit) && strcmp(option->name, name) == 0 &&
            may_stand(option))
            return option;
    }
    return NULL;
}

/* The path tracer is what a technique's settings are measured against: it has no use for them, and
 * for few samples least of all. */
static bool is_passed_over(const lsf_settings *settings, const lsf_command_option *option)
{
    static const char *const names[] = {"technique", "define", "samples", "raw"};
    if (settings->command->bit != LSF_COMMAND_REFERENCE)
        return false;
    for (size_t i = 0; i < LSF_COUNT(names); i++)
        if (strcmp(option->name, names[i]) == 0)
            return true;
    return false;
}

static bool read_line(lsf_settings *settings, char *line, lsf_error *error)
{
    char *value = strchr(line, '=');
    if (value)
        *value++ = '\0';
    const lsf_command_option *option = find(settings->command, line);
    if (!option) {
        const char *nearest = lsf_nearest(line, next_name, (void *)(uintptr_t)settings->command);
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: not an option of %s that a preset can have%s%s%s", line,
                             settings->command->name, nearest ? "; did you mean " : "",
                             nearest ? nearest : "", nearest ? "?" : "");
    }
    if (!option->argument != !value) {
        char *range = lsf_command_option_range(option);
        lsf_error_set(error, LSF_ERROR_USAGE, "%s: %s%s", line,
                      value ? "takes no value; write it alone" : "write =VALUE behind it: ",
                      value ? "" : (range ? range : option->argument));
        free(range);
        return false;
    }
    if (is_passed_over(settings, option))
        return true;
    if (!lsf_settings_set(settings, option, value, error))
        return false;
    lsf_settings_note(settings, option, value);
    return true;
}

/* Without the space around it; NULL: there is nothing in it. */
static char *trim(char *line)
{
    line += strspn(line, " \t\r");
    size_t length = strlen(line);
    while (length > 0 && strchr(" \t\r", line[length - 1]))
        line[--length] = '\0';
    return *line && *line != '#' ? line : NULL;
}

/* The word before the scene's path in a view. */
#define SCENE "file="

static bool read_file(lsf_settings *settings, const char *path, char **content, bool view,
                      lsf_error *error)
{
    size_t length;
    lsf_error cause;
    free(*content);
    *content = lsf_file_read(path, LARGEST, &length, error);
    if (!*content)
        return false;
    if (strlen(*content) != length)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: is no %s: it holds a NUL", path,
                             view ? "view" : "preset");
    char *rest = *content, *line;
    for (uint32_t number = 1; (line = strsep(&rest, "\n")); number++) {
        char *text = trim(line);
        if (text && view && strncmp(text, SCENE, strlen(SCENE)) == 0)
            settings->view_scene = text + strlen(SCENE);
        else if (text && !read_line(settings, text, &cause))
            return lsf_error_set(error, cause.code, "%s: line %u: %s", path, number, cause.message);
    }
    return true;
}

int lsf_preset_number(const lsf_command_option *option, const char *text)
{
    size_t length = strlen(text);
    int number = 0;
    for (const char *name = option->choices; name; number++) {
        size_t end = strcspn(name, "|");
        if (end == length && strncmp(name, text, length) == 0)
            return number;
        name = name[end] ? name + end + 1 : NULL;
    }
    return LSF_PRESET_FILE;
}

bool lsf_preset_read(lsf_settings *settings, const char *path, lsf_error *error)
{
    return read_file(settings, path, &settings->preset_text, false, error);
}

bool lsf_view_read(lsf_settings *settings, const char *path, lsf_error *error)
{
    return read_file(settings, path, &settings->view_text, true, error);
}
