/* Writes what is made from the option table at build time:
 * lightsheaf-pages man|bash|fish|zsh|markdown */
#include "base/base.h"
#include "tools/completion.h"
#include "tools/options.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- man page --- */

/* Dashes that are typed, and backslashes, are escaped; a leading dot or quote would be a request.
 */
static void add_roff(lsf_string *page, const char *text)
{
    if (*text == '.' || *text == '\'')
        lsf_string_add(page, "\\&");
    for (; *text; text++)
        lsf_string_add(page, *text == '-' ? "\\-" : *text == '\\' ? "\\e" : "%c", *text);
}

static void add_man_option(lsf_string *page, const lsf_command_option *option)
{
    lsf_string_add(page, ".TP\n");
    if (option->letter)
        lsf_string_add(page, "\\fB\\-%c\\fR, ", option->letter);
    lsf_string_add(page, "\\fB\\-\\-");
    add_roff(page, option->name);
    lsf_string_add(page, "\\fR");
    if (option->argument) {
        lsf_string_add(page, " \\fI");
        add_roff(page, option->argument);
        lsf_string_add(page, "\\fR");
    }
    lsf_string_add(page, "\n");
    add_roff(page, option->help);
    if (option->choices) {
        lsf_string_add(page, " (");
        lsf_command_option_add_choices(page, option, ", ");
        lsf_string_add(page, ")");
    }
    if (option->initial) {
        lsf_string_add(page, " (default ");
        add_roff(page, option->initial);
        lsf_string_add(page, ")");
    }
    lsf_string_add(page, "\n");
}

static void add_man(lsf_string *page)
{
    lsf_string_add(page,
                   ".TH LIGHTSHEAF 1 \"\" \"Lightsheaf %d.%d.%d\"\n.SH NAME\n"
                   "lightsheaf \\- global illumination by rasterisation\n.SH SYNOPSIS\n",
                   LSF_VERSION_MAJOR, LSF_VERSION_MINOR, LSF_VERSION_PATCH);
    for (size_t i = 0; lsf_command_at(i); i++) {
        lsf_string_add(page, "%s.B lightsheaf %s\n", i ? ".br\n" : "", lsf_command_at(i)->name);
        add_roff(page, lsf_command_at(i)->operands);
        lsf_string_add(page, "\n[\\fIOPTION\\fR]...\n");
    }
    lsf_string_add(page, ".SH DESCRIPTION\nRenders glTF scenes offscreen with OpenGL 4.5, without "
                         "display or GPU, and measures the pictures against a path tracer. Options "
                         "and operands may come in any order.\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        lsf_string_add(page, ".SH \"LIGHTSHEAF ");
        for (const char *c = command->name; *c; c++)
            lsf_string_add(page, "%c", toupper((unsigned char)*c));
        lsf_string_add(page, "\"\n");
        for (const char *c = command->text; *c; c++)
            if (*c != '`')
                lsf_string_add(page, *c == '-' ? "\\-" : "%c", *c);
        lsf_string_add(page, "\n");
        for (size_t j = 0; lsf_command_option_at(j); j++)
            if (lsf_command_option_at(j)->commands & command->bit)
                add_man_option(page, lsf_command_option_at(j));
    }
    lsf_string_add(page, ".SH \"EXIT STATUS\"\n"
                         ".TP\n0\ndone\n.TP\n1\nrendering failed or was interrupted\n"
                         ".TP\n2\nan option or operand is wrong\n"
                         ".TP\n3\na file is missing, malformed or cannot be written\n"
                         ".TP\n4\nno OpenGL 4.5 context could be made\n"
                         ".TP\n5\nthe compared images differ by more than a threshold\n"
                         ".SH EXAMPLES\n.nf\n"
                         "lightsheaf render \\-o interior.png\n"
                         "lightsheaf render atrium.gltf \\-o atrium.exr \\-s 1024 \\-\\-aov "
                         "albedo,normal\n"
                         "lightsheaf reference atrium.gltf \\-o truth.exr \\-\\-halves \\-b 0\n"
                         "lightsheaf compare atrium.exr truth_a.exr truth_b.exr\n.fi\n");
}

/* --- docs/command.md --- */

static void add_markdown(lsf_string *page)
{
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        lsf_string_add(page,
                       "%s### `lightsheaf %s %s`\n\n%s\n\n| option | effect |\n| --- | --- |\n",
                       i ? "\n" : "", command->name, command->operands, command->text);
        for (size_t j = 0; lsf_command_option_at(j); j++) {
            const lsf_command_option *option = lsf_command_option_at(j);
            if (!(option->commands & command->bit))
                continue;
            lsf_string_add(page, "| `");
            if (option->letter)
                lsf_string_add(page, "-%c, ", option->letter);
            lsf_string_add(page, "--%s", option->name);
            lsf_string_add(page, option->argument ? " " : "");
            /* a bar would end the table's cell */
            for (const char *c = option->argument ? option->argument : ""; *c; c++)
                lsf_string_add(page, *c == '|' ? "\\|" : "%c", *c);
            lsf_string_add(page, "` | %s", option->help);
            if (option->choices) {
                lsf_string_add(page, " (");
                lsf_command_option_add_choices(page, option, ", ");
                lsf_string_add(page, ")");
            }
            if (option->initial)
                lsf_string_add(page, " (default %s)", option->initial);
            lsf_string_add(page, " |\n");
        }
    }
}

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        void (*add)(lsf_string *page);
    } pages[] = {{"man", add_man},
                 {"bash", lsf_completion_add_bash},
                 {"fish", lsf_completion_add_fish},
                 {"zsh", lsf_completion_add_zsh},
                 {"markdown", add_markdown}};
    for (size_t i = 0; argc == 2 && i < LSF_COUNT(pages); i++) {
        if (strcmp(argv[1], pages[i].name) != 0)
            continue;
        lsf_string page = {0};
        pages[i].add(&page);
        bool good = !page.failed && fputs(page.text, stdout) != EOF && fflush(stdout) != EOF;
        free(page.text);
        return good ? 0 : 1;
    }
    fprintf(stderr, "usage: lightsheaf-pages man|bash|fish|zsh|markdown\n");
    return 2;
}
