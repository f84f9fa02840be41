#include "tools/help.h"

#include <stdlib.h>
#include <string.h>

enum { MARGIN = 26, WIDTH = 80 };

/* Words of `words` from `column` on, broken at WIDTH and continued at MARGIN. */
static void add_wrapped(lsf_string *text, const char *words, size_t column, size_t margin)
{
    while (*words) {
        size_t length = strcspn(words, " ");
        if (column + length > WIDTH && column > margin) {
            lsf_string_add(text, "\n%*s", (int)margin, "");
            column = margin;
        }
        lsf_string_add_bytes(text, words, length);
        column += length;
        words += length;
        if (*words == ' ') {
            words++;
            if (column + 1 + strcspn(words, " ") <= WIDTH) {
                lsf_string_add_bytes(text, " ", 1);
                column++;
            } else {
                lsf_string_add(text, "\n%*s", (int)margin, "");
                column = margin;
            }
        }
    }
    lsf_string_add_bytes(text, "\n", 1);
}

void lsf_help_overview(lsf_string *text)
{
    lsf_string_add(text, "Usage: lightsheaf COMMAND [OPTION]...\n"
                         "Global illumination by rasterisation alone.\n\nCommands:\n");
    for (size_t i = 0; lsf_command_at(i); i++)
        lsf_string_add(text, "  %-12s%s\n", lsf_command_at(i)->name, lsf_command_at(i)->summary);
    lsf_string_add(text, "\n`lightsheaf help COMMAND` or `lightsheaf COMMAND --help` lists a "
                         "command's options.\n\n"
                         "Exit status: 0 done, 1 rendering failed, 2 wrong usage, 3 a file is at "
                         "fault,\n4 no OpenGL, 5 images differ.\n");
}

void lsf_help_option_title(lsf_string *text, const lsf_command_option *option)
{
    if (option->letter)
        lsf_string_add(text, "-%c, ", option->letter);
    lsf_string_add(text, "--%s%s%s", option->name, option->argument ? " " : "",
                   option->argument ? option->argument : "");
}

static void add_option(lsf_string *text, const lsf_command_option *option)
{
    size_t start = text->length;
    lsf_string_add(text, option->letter ? "  " : "      ");
    lsf_help_option_title(text, option);
    size_t column = text->length - start;
    if (column + 2 > MARGIN) {
        lsf_string_add_bytes(text, "\n", 1);
        column = 0;
    }
    lsf_string_add(text, "%*s", (int)(MARGIN - column), "");

    lsf_string words = {0};
    lsf_string_add(&words, "%s", option->help);
    if (option->choices) {
        lsf_string_add(&words, " (");
        lsf_command_option_add_choices(&words, option, ", ");
        lsf_string_add(&words, option->initial ? "; default %s)" : ")", option->initial);
    } else if (option->initial) {
        lsf_string_add(&words, " (default %s)", option->initial);
    }
    add_wrapped(text, words.text ? words.text : option->help, MARGIN, MARGIN);
    free(words.text);
}

void lsf_help_command(lsf_string *text, const lsf_command *command)
{
    lsf_string_add(text, "Usage: lightsheaf %s %s [OPTION]...\n", command->name, command->operands);
    add_wrapped(text, command->text, 0, 0);
    const char *group = NULL;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (!(option->commands & command->bit))
            continue;
        if (!group || strcmp(group, option->group) != 0)
            lsf_string_add(text, "\n%s:\n", option->group);
        group = option->group;
        add_option(text, option);
    }
}

void lsf_help_pass_options(lsf_string *text)
{
    lsf_option option;
    lsf_string_add(text, "%-28s%-7s%-24s%-12s%s\n", "option", "type", "range", "default", "effect");
    for (uint32_t i = 0; lsf_option_list(i, &option); i++) {
        const char *unit = option.unit ? option.unit : "";
        lsf_string_add(text, "%-27s %-6s %-23s %-11s ", option.key, option.type, option.range,
                       option.value);
        lsf_string_add(text, *unit ? "%s [%s]\n" : "%s\n", option.help, unit);
    }
}

void lsf_help_techniques(lsf_string *text)
{
    for (uint32_t i = 0; lsf_technique_name(i); i++)
        lsf_string_add(text, "%-16s%s\n", lsf_technique_name(i), lsf_technique_help(i));
}

void lsf_help_sandbox_names(lsf_string *text)
{
    lsf_sandbox_name name;
    const char *group = "";
    for (uint32_t i = 0; lsf_sandbox_list(i, &name); i++) {
        if (strcmp(group, name.group) != 0)
            lsf_string_add(text, "%s%ss\n", *group ? "\n" : "", name.group);
        group = name.group;
        lsf_string_add(text, "  %s\n%6s", name.use, "");
        add_wrapped(text, name.help, 6, 6);
    }
}
