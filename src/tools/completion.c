#include "tools/completion.h"

#include "tools/options.h"

#include <stdlib.h>
#include <string.h>

/* Words that the shells ask the command for, so that names are those of its version: the
 * techniques, and each pass.key= with the values that it takes. */
#define LIST_TECHNIQUES " render --list-techniques 2>/dev/null | awk '{ print $1 }'"
#define LIST_DEFINES                                                                               \
    " render --list-options 2>/dev/null | awk 'NR > 1 { n = split($3, v, \"|\"); "                 \
    "if (n < 2) print $1 \"=\"; else for (i = 1; i <= n; i++) print $1 \"=\" v[i] }'"

/* Within single quotes, which every shell ends alike. */
static void add_quoted(lsf_string *page, const char *text)
{
    for (; *text; text++)
        lsf_string_add(page, *text == '\'' ? "'\\''" : "%c", *text);
}

/* The alternatives in "FILE|rays|auto" that are to be typed as they are, up to a space; their
 * number. `page` NULL: they are counted alone. */
static uint32_t add_literals(lsf_string *page, const char *alternatives)
{
    uint32_t count = 0;
    for (const char *part = alternatives; part && *part; part++) {
        size_t length = strcspn(part, "| ");
        if (length > 0 && strspn(part, "abcdefghijklmnopqrstuvwxyz_") == length) {
            if (page)
                lsf_string_add(page, "%s%.*s", count ? " " : "", (int)length, part);
            count++;
        }
        part += length;
        if (*part != '|')
            break;
    }
    return count;
}

/* The words that the option takes, separated by spaces; their number. */
static uint32_t add_words(lsf_string *page, const lsf_command_option *option)
{
    return add_literals(page, option->choices ? option->choices : option->argument);
}

static uint32_t add_first_operands(lsf_string *page, const lsf_command *command)
{
    if (command->bit != LSF_COMMAND_HELP)
        return add_literals(page, command->operands);
    uint32_t count = 0;
    for (; lsf_command_at(count); count++)
        lsf_string_add(page, "%s%s", count ? " " : "", lsf_command_at(count)->name);
    return count;
}

static bool takes_file(const lsf_command_option *option)
{
    return option->type == LSF_VALUE_ENVIRONMENT || option->type == LSF_VALUE_JSON ||
           option->type == LSF_VALUE_PRESET ||
           (option->type == LSF_VALUE_TEXT && strncmp(option->argument, "NAME", 4) != 0);
}

static bool is_repeatable(const lsf_command_option *option)
{
    return option->type == LSF_VALUE_DEFINE || option->type == LSF_VALUE_SWEEP ||
           option->type == LSF_VALUE_TEXTS || option->type == LSF_VALUE_TECHNIQUES ||
           option->type == LSF_VALUE_THRESHOLD || option->type == LSF_VALUE_AOVS;
}

static bool is_technique(const lsf_command_option *option)
{
    return option->type == LSF_VALUE_TECHNIQUE || option->type == LSF_VALUE_TECHNIQUES;
}

static bool is_define(const lsf_command_option *option)
{
    return option->type == LSF_VALUE_DEFINE || option->type == LSF_VALUE_SWEEP;
}

/* --- bash --- */

/* A pattern for "COMMAND:OPTION". */
static void add_bash_pattern(lsf_string *page, const lsf_command_option *option)
{
    const char *bar = "";
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        if (!(option->commands & command->bit))
            continue;
        lsf_string_add(page, "%s%s:--%s", bar, command->name, option->name);
        bar = "|";
        if (option->letter)
            lsf_string_add(page, "|%s:-%c", command->name, option->letter);
    }
}

static void add_bash_values(lsf_string *page)
{
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (!option->argument)
            continue;
        lsf_string_add(page, "    ");
        add_bash_pattern(page, option);
        lsf_string_add(page, ")\n        ");
        if (is_technique(option)) {
            lsf_string_add(page, "list=$(\"$1\"" LIST_TECHNIQUES ")");
        } else if (is_define(option)) {
            lsf_string_add(page, "list=$(\"$1\"" LIST_DEFINES ")");
        } else {
            lsf_string_add(page, "list='");
            add_words(page, option);
            lsf_string_add(page, "'");
        }
        if (option->type == LSF_VALUE_AOVS || option->type == LSF_VALUE_TECHNIQUES)
            lsf_string_add(page, " separator=,");
        if (option->type == LSF_VALUE_THRESHOLD)
            lsf_string_add(page, " suffix==");
        if (takes_file(option))
            lsf_string_add(page, " files=1");
        lsf_string_add(page, " ;;\n");
    }
}

static void add_bash_options(lsf_string *page)
{
    for (size_t i = 0; lsf_command_at(i); i++) {
        lsf_string_add(page, "        %s:-*) list='", lsf_command_at(i)->name);
        const char *space = "";
        for (size_t j = 0; lsf_command_option_at(j); j++) {
            if (!(lsf_command_option_at(j)->commands & lsf_command_at(i)->bit))
                continue;
            lsf_string_add(page, "%s--%s", space, lsf_command_option_at(j)->name);
            space = " ";
        }
        lsf_string_add(page, "' ;;\n");
    }
}

static void add_bash_operands(lsf_string *page)
{
    for (size_t i = 0; lsf_command_at(i); i++) {
        lsf_string words = {0};
        if (add_first_operands(&words, lsf_command_at(i)) > 0)
            lsf_string_add(page, "        %s:*) ((${#words[@]} == 3)) && list='%s' || files=1 ;;\n",
                           lsf_command_at(i)->name, words.text);
        free(words.text);
    }
}

void lsf_completion_add_bash(lsf_string *page)
{
    lsf_string_add(
        page, "%s",
        "# bash completion for lightsheaf, made from its option table\n"
        "_lightsheaf()\n{\n"
        "    # Readline may take \"=\" for a word of its own: what was typed as one is "
        "joined.\n"
        "    local words=() i\n"
        "    for ((i = 0; i <= COMP_CWORD; i++)); do\n"
        "        if ((i > 1)) && [[ ${COMP_WORDS[i]} == = || ${COMP_WORDS[i - 1]} == = ]]; "
        "then\n"
        "            words[-1]+=${COMP_WORDS[i]}\n"
        "        else\n"
        "            words+=(\"${COMP_WORDS[i]}\")\n"
        "        fi\n"
        "    done\n"
        "    local word=${words[-1]} option=${words[-2]} command=${words[1]}\n"
        "    local head= list= separator= suffix= files=\n"
        "    if [[ $word == --*=* ]]; then\n"
        "        option=${word%%=*} head=${word%%=*}= word=${word#*=}\n"
        "    fi\n"
        "    local typed=$head$word\n"
        "    ((${#words[@]} == 2)) && command= option=\n"
        "    case $command:$option in\n"
        "    :) list='");
    for (size_t i = 0; lsf_command_at(i); i++)
        lsf_string_add(page, "%s ", lsf_command_at(i)->name);
    lsf_string_add(page, "--help --version' ;;\n");
    add_bash_values(page);
    lsf_string_add(page, "    *)\n        case $command:$word in\n");
    add_bash_options(page);
    add_bash_operands(page);
    lsf_string_add(
        page, "%s",
        "        *) files=1 ;;\n"
        "        esac ;;\n"
        "    esac\n"
        "    if [[ $separator && $word == *$separator* ]]; then\n"
        "        head+=${word%\"$separator\"*}$separator word=${word##*\"$separator\"}\n"
        "    fi\n"
        "    COMPREPLY=($(compgen -P \"$head\" -S \"$suffix\" -W \"$list\" -- \"$word\"))\n"
        "    [[ $files ]] && compopt -o default\n"
        "    [[ $separator || ${COMPREPLY[0]} == *= ]] && compopt -o nospace\n"
        "    if [[ $COMP_WORDBREAKS == *=* && $typed == *=* ]]; then\n"
        "        COMPREPLY=(\"${COMPREPLY[@]#\"${typed%=*}=\"}\")\n"
        "    fi\n"
        "}\ncomplete -F _lightsheaf lightsheaf\n");
}

/* --- fish --- */

static void add_fish_option(lsf_string *page, const lsf_command *command,
                            const lsf_command_option *option)
{
    lsf_string_add(page, "complete -c lightsheaf -n '__fish_seen_subcommand_from %s' -l %s",
                   command->name, option->name);
    if (option->letter)
        lsf_string_add(page, " -s %c", option->letter);
    if (option->argument)
        lsf_string_add(page, takes_file(option) ? " -r" : " -x");
    if (is_technique(option)) {
        lsf_string_add(page, " -a '(lightsheaf");
        add_quoted(page, LIST_TECHNIQUES);
        lsf_string_add(page, ")'");
    } else if (is_define(option)) {
        lsf_string_add(page, " -a '(lightsheaf");
        add_quoted(page, LIST_DEFINES);
        lsf_string_add(page, ")'");
    } else if (add_words(NULL, option) > 0) {
        lsf_string_add(page, option->type == LSF_VALUE_AOVS ? " -a '(__fish_append , " : " -a '");
        add_words(page, option);
        lsf_string_add(page, option->type == LSF_VALUE_AOVS ? ")'" : "'");
    }
    lsf_string_add(page, " -d '");
    add_quoted(page, option->help);
    lsf_string_add(page, "'\n");
}

void lsf_completion_add_fish(lsf_string *page)
{
    lsf_string_add(page, "# fish completion for lightsheaf, made from its option table\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        lsf_string_add(page, "complete -c lightsheaf -n __fish_use_subcommand -f -a %s -d '",
                       command->name);
        add_quoted(page, command->summary);
        lsf_string_add(page, "'\n");
        lsf_string words = {0};
        if (add_first_operands(&words, command) > 0)
            lsf_string_add(page,
                           "complete -c lightsheaf -n '__fish_seen_subcommand_from %s' -a '%s'\n",
                           command->name, words.text);
        free(words.text);
        for (size_t j = 0; lsf_command_option_at(j); j++)
            if (lsf_command_option_at(j)->commands & command->bit)
                add_fish_option(page, command, lsf_command_option_at(j));
    }
}

/* --- zsh --- */

/* Brackets end an explanation. */
static void add_zsh_text(lsf_string *page, const char *text)
{
    for (; *text; text++)
        lsf_string_add(page,
                       *text == '\''                  ? "'\\''"
                       : *text == '[' || *text == ']' ? "\\%c"
                                                      : "%c",
                       *text);
}

static void add_zsh_value(lsf_string *page, const lsf_command_option *option)
{
    lsf_string_add(page, ":%s:", takes_file(option) ? "file" : "value");
    if (is_technique(option)) {
        lsf_string_add(page, "_lightsheaf_techniques");
    } else if (is_define(option)) {
        lsf_string_add(page, "_lightsheaf_defines");
    } else if (option->type == LSF_VALUE_AOVS) {
        lsf_string_add(page, "_values -s , layer ");
        add_words(page, option);
    } else if (option->type == LSF_VALUE_THRESHOLD) {
        lsf_string_add(page, "compadd -S = -- ");
        add_words(page, option);
    } else if (add_words(NULL, option) > 0) {
        lsf_string_add(page, "(");
        add_words(page, option);
        lsf_string_add(page, ")");
    } else if (takes_file(option)) {
        lsf_string_add(page, "_files");
    }
}

/* '(-o --output)'{-o+,--output=}'[where the picture goes]:file:_files' */
static void add_zsh_option(lsf_string *page, const lsf_command_option *option)
{
    const char *value = option->argument ? "=" : "";
    if (is_repeatable(option))
        lsf_string_add(page, "            '*'");
    else if (option->letter)
        lsf_string_add(page, "            '(-%c --%s)'", option->letter, option->name);
    else
        lsf_string_add(page, "            ");
    if (option->letter)
        lsf_string_add(page, "{-%c%s,--%s%s}'[", option->letter, option->argument ? "+" : "",
                       option->name, value);
    else
        lsf_string_add(page, "'--%s%s[", option->name, value);
    add_zsh_text(page, option->help);
    lsf_string_add(page, "]");
    if (option->argument)
        add_zsh_value(page, option);
    lsf_string_add(page, "' \\\n");
}

void lsf_completion_add_zsh(lsf_string *page)
{
    lsf_string_add(page, "#compdef lightsheaf\n"
                         "# zsh completion for lightsheaf, made from its option table\n"
                         "_lightsheaf_techniques()\n{\n"
                         "    local -a names=(${(f)\"$(\"$program\"" LIST_TECHNIQUES ")\"})\n"
                         "    compadd -a names\n}\n"
                         "_lightsheaf_defines()\n{\n"
                         "    local -a names=(${(f)\"$(\"$program\"" LIST_DEFINES ")\"})\n"
                         "    compadd -S '' -- ${(M)names:#*=}\n"
                         "    compadd -- ${names:#*=}\n}\n"
                         "_lightsheaf()\n{\n"
                         "    local curcontext=$curcontext program=$words[1] command=$words[2]\n"
                         "    if ((CURRENT == 2)); then\n"
                         "        local -a commands=(\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        lsf_string_add(page, "            '%s:", lsf_command_at(i)->name);
        add_quoted(page, lsf_command_at(i)->summary);
        lsf_string_add(page, "'\n");
    }
    lsf_string_add(page, "        )\n"
                         "        _describe -t commands command commands\n"
                         "        return\n"
                         "    fi\n"
                         "    shift words\n"
                         "    ((CURRENT--))\n"
                         "    case $command in\n");
    for (size_t i = 0; lsf_command_at(i); i++) {
        const lsf_command *command = lsf_command_at(i);
        lsf_string_add(page, "    %s)\n        _arguments -s -S \\\n", command->name);
        for (size_t j = 0; lsf_command_option_at(j); j++)
            if (lsf_command_option_at(j)->commands & command->bit)
                add_zsh_option(page, lsf_command_option_at(j));
        lsf_string words = {0};
        if (add_first_operands(&words, command) > 0)
            lsf_string_add(page, "            '1:what:(%s)' \\\n", words.text);
        free(words.text);
        lsf_string_add(page, "            '*:file:_files' ;;\n");
    }
    lsf_string_add(page, "    esac\n}\n_lightsheaf \"$@\"\n");
}
