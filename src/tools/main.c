/* lightsheaf COMMAND [OPTION]... */
#include "base/base.h"
#include "tools/help.h"
#include "tools/interrupt.h"
#include "tools/number.h"
#include "tools/report.h"
#include "tools/tools.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    lsf_command_bit bit;
    int (*run)(int argc, char **argv);
} tools[] = {
    {LSF_COMMAND_RENDER, lsf_tool_render},   {LSF_COMMAND_REFERENCE, lsf_tool_reference},
    {LSF_COMMAND_COMPARE, lsf_tool_compare}, {LSF_COMMAND_INFO, lsf_tool_info},
    {LSF_COMMAND_PLAN, lsf_tool_plan},       {LSF_COMMAND_BENCH, lsf_tool_bench},
    {LSF_COMMAND_MEASURE, lsf_tool_measure}, {LSF_COMMAND_SANDBOX, lsf_tool_sandbox},
    {LSF_COMMAND_VIEW, lsf_tool_view},       {LSF_COMMAND_HELP, lsf_tool_help},
};

static const char *next_command(size_t index, void *user)
{
    (void)user;
    return lsf_command_at(index) ? lsf_command_at(index)->name : NULL;
}

static int refuse_command(const char *name)
{
    const char *nearest = lsf_nearest(name, next_command, NULL);
    lsf_error error;
    lsf_error_set(&error, LSF_ERROR_USAGE,
                  "%s: no such command%s%s%s; `lightsheaf help` lists them", name,
                  nearest ? "; did you mean " : "", nearest ? nearest : "", nearest ? "?" : "");
    return lsf_report_error(&error);
}

int main(int argc, char **argv)
{
    lsf_report_start(LSF_VERBOSITY_NORMAL);
    lsf_interrupt_install();
    if (argc < 2) {
        lsf_string text = {0};
        lsf_help_overview(&text);
        fputs(text.text ? text.text : "", stderr);
        free(text.text);
        return LSF_ERROR_USAGE;
    }
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        name = "help";
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        /* The help command answers it, as every command does. */
        return lsf_tool_help(argc, argv);
    }
    for (size_t i = 0; i < LSF_COUNT(tools); i++)
        if (strcmp(name, lsf_command_find(tools[i].bit)->name) == 0)
            return tools[i].run(argc - 1, argv + 1);
    return refuse_command(name);
}
