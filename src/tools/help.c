#include "tools/help.h"

#include "tools/begin.h"
#include "tools/number.h"
#include "tools/report.h"
#include "tools/tools.h"

#include <stdlib.h>
#include <string.h>

static const char *next_command(size_t index, void *user)
{
    (void)user;
    return lsf_command_at(index) ? lsf_command_at(index)->name : NULL;
}

static bool add_help(lsf_string *text, const char *name, lsf_error *error)
{
    if (!name) {
        lsf_help_overview(text);
        return true;
    }
    for (size_t i = 0; lsf_command_at(i); i++) {
        if (strcmp(lsf_command_at(i)->name, name) == 0) {
            lsf_help_command(text, lsf_command_at(i));
            return true;
        }
    }
    const char *nearest = lsf_nearest(name, next_command, NULL);
    return lsf_error_set(error, LSF_ERROR_USAGE, "%s: no such command%s%s%s", name,
                         nearest ? "; did you mean " : "; `lightsheaf help` lists them",
                         nearest ? nearest : "", nearest ? "?" : "");
}

int lsf_tool_help(int argc, char **argv)
{
    lsf_settings settings;
    lsf_error error;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_HELP, argc, argv);
    if (status == LSF_GO_ON) {
        lsf_string text = {0};
        bool good =
            add_help(&text, settings.operands.count ? settings.operands.items[0] : NULL, &error) &&
            lsf_file_write("-", text.text, text.length, &error);
        status = good ? 0 : lsf_report_error(&error);
        free(text.text);
    }
    lsf_settings_finish(&settings);
    return status;
}
