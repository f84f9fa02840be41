/* Writes what is made from the option table at build time:
 * lightsheaf-pages man|bash|zsh|fish|markdown */
#include "base/base.h"
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
    if (option->choices)
        lsf_string_add(page, " (%s)", option->choices);
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

/* --- shell completion --- */

/* Single quotes end a quoted word in every shell; the table has none, and this keeps it so. */
static void add_quoted(lsf_string *page, const char *text)
{
    for (; *text; text++)
        lsf_string_add(page, *text == '\'' ? "'\\''" : "%c", *text);
}

static void add_words(lsf_string *page, const char *choices)
{
    for (; *choices; choices++)
        lsf_string_add(page, "%c", *choices == '|' ? ' ' : *choices);
}

static bool takes_file(const lsf_command_option *option)
{
    return option->type == LSF_VALUE_ENVIRONMENT ||
           (option->type == LSF_VALUE_TEXT && strncmp(option->argument, "NAME", 4) != 0);
}

static void add_bash_values(lsf_string *page)
{
    lsf_string_add(page, "    case $previous in\n");
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (!option->argument)
            continue;
        lsf_string_add(page, "    --%s", option->name);
        if (option->letter)
            lsf_string_add(page, "|-%c", option->letter);
        lsf_string_add(page, ")\n");
        if (option->choices) {
            lsf_string_add(page, "        COMPREPLY=($(compgen -W '");
            add_words(page, option->choices);
            lsf_string_add(page, "' -- \"$word\"))\n");
        } else if (option->type == LSF_VALUE_TECHNIQUE) {
            lsf_string_add(page, "        COMPREPLY=($(compgen -W \"$(\"$1\" render "
                                 "--list-techniques 2>/dev/null |\n"
                                 "            cut -d ' ' -f 1)\" -- \"$word\"))\n");
        } else if (option->type == LSF_VALUE_DEFINE) {
            lsf_string_add(page, "        COMPREPLY=($(compgen -S = -W \"$(\"$1\" render "
                                 "--list-options 2>/dev/null |\n"
                                 "            sed 1d | cut -d ' ' -f 1)\" -- \"$word\"))\n"
                                 "        compopt -o nospace\n");
        } else if (option->type == LSF_VALUE_AOVS) {
            lsf_string_add(page, "        COMPREPLY=($(compgen -W 'albedo normal depth emission "
                                 "direct indirect_diffuse\n"
                                 "            indirect_specular motion voxel_albedo voxel_normal "
                                 "voxel_radiance all' -- \"$word\"))\n");
        } else if (takes_file(option)) {
            lsf_string_add(page, "        compopt -o default\n");
        }
        lsf_string_add(page, "        return ;;\n");
    }
    lsf_string_add(page, "    esac\n");
}

static void add_bash(lsf_string *page)
{
    lsf_string_add(page, "# bash completion for lightsheaf, made from its option table\n"
                         "_lightsheaf()\n{\n"
                         "    local word=${COMP_WORDS[COMP_CWORD]} "
                         "previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
                         "    COMPREPLY=()\n"
                         "    if ((COMP_CWORD == 1)); then\n"
                         "        COMPREPLY=($(compgen -W '");
    for (size_t i = 0; lsf_command_at(i); i++)
        lsf_string_add(page, "%s ", lsf_command_at(i)->name);
    lsf_string_add(page, "--help --version' -- \"$word\"))\n        return\n    fi\n");
    add_bash_values(page);
    lsf_string_add(page, "    if [[ $word != -* ]]; then\n"
                         "        if [[ ${COMP_WORDS[1]} == help ]]; then\n"
                         "            COMPREPLY=($(compgen -W '");
    for (size_t i = 0; lsf_command_at(i); i++)
        lsf_string_add(page, "%s%s", i ? " " : "", lsf_command_at(i)->name);
    lsf_string_add(page, "' -- \"$word\"))\n"
                         "        else\n            compopt -o default\n        fi\n"
                         "        return\n    fi\n    case ${COMP_WORDS[1]} in\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        lsf_string_add(page, "    %s)\n        COMPREPLY=($(compgen -W '", lsf_command_at(i)->name);
        const char *space = "";
        for (size_t j = 0; lsf_command_option_at(j); j++) {
            if (!(lsf_command_option_at(j)->commands & lsf_command_at(i)->bit))
                continue;
            lsf_string_add(page, "%s--%s", space, lsf_command_option_at(j)->name);
            space = " ";
        }
        lsf_string_add(page, "' -- \"$word\")) ;;\n");
    }
    lsf_string_add(page, "    esac\n}\ncomplete -F _lightsheaf lightsheaf\n");
}

static void add_fish(lsf_string *page)
{
    lsf_string_add(page, "# fish completion for lightsheaf, made from its option table\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        lsf_string_add(page, "complete -c lightsheaf -n __fish_use_subcommand -f -a %s -d '",
                       command->name);
        add_quoted(page, command->summary);
        lsf_string_add(page, "'\n");
        for (size_t j = 0; lsf_command_option_at(j); j++) {
            const lsf_command_option *option = lsf_command_option_at(j);
            if (!(option->commands & command->bit))
                continue;
            lsf_string_add(page, "complete -c lightsheaf -n '__fish_seen_subcommand_from %s' -l %s",
                           command->name, option->name);
            if (option->letter)
                lsf_string_add(page, " -s %c", option->letter);
            if (option->argument)
                lsf_string_add(page, takes_file(option) ? " -r" : " -x");
            if (option->choices) {
                lsf_string_add(page, " -a '");
                add_words(page, option->choices);
                lsf_string_add(page, "'");
            }
            lsf_string_add(page, " -d '");
            add_quoted(page, option->help);
            lsf_string_add(page, "'\n");
        }
    }
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
                for (const char *c = option->choices; *c; c++)
                    lsf_string_add(page, *c == '|' ? ", " : "%c", *c);
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
    } pages[] = {
        {"man", add_man}, {"bash", add_bash}, {"fish", add_fish}, {"markdown", add_markdown}};
    for (size_t i = 0; argc == 2 && i < LSF_COUNT(pages); i++) {
        if (strcmp(argv[1], pages[i].name) != 0)
            continue;
        lsf_string page = {0};
        pages[i].add(&page);
        bool good = !page.failed && fputs(page.text, stdout) != EOF && fflush(stdout) != EOF;
        free(page.text);
        return good ? 0 : 1;
    }
    fprintf(stderr, "usage: lightsheaf-pages man|bash|fish|markdown\n");
    return 2;
}
