#include "tools/begin.h"

#include <lightsheaf/lightsheaf.h>

#include "base/base.h"
#include "tools/help.h"
#include "tools/report.h"

#include <stdlib.h>
#include <string.h>

/* The text that --help and its like ask for; false when none does. */
static bool add_answer(lsf_string *text, const lsf_settings *settings)
{
    if (settings->help)
        lsf_help_command(text, settings->command);
    else if (settings->version)
        lsf_string_add(text, "lightsheaf %s\n", lsf_version());
    else if (settings->list_techniques)
        lsf_help_techniques(text);
    else if (settings->list_names)
        lsf_help_sandbox_names(text);
    else if (settings->list_options)
        lsf_help_pass_options(text);
    else
        return false;
    return true;
}

int lsf_tool_begin(lsf_settings *settings, lsf_command_bit command, int argc, char **argv)
{
    lsf_error error;
    bool good = lsf_settings_parse(settings, command, argc, argv, &error);
    lsf_report_start(settings->quiet     ? LSF_VERBOSITY_QUIET
                     : settings->verbose ? LSF_VERBOSITY_VERBOSE
                                         : LSF_VERBOSITY_NORMAL);
    if (!good)
        return lsf_report_error(&error);
    lsf_string text = {0};
    int status = LSF_GO_ON;
    if (add_answer(&text, settings))
        status = lsf_file_write("-", text.text, text.length, &error) ? 0 : lsf_report_error(&error);
    else if (settings->json_path && !lsf_file_can_write(settings->json_path, &error))
        status = lsf_report_error(&error);
    free(text.text);
    return status;
}

void lsf_tool_begin_json(lsf_json *json, const lsf_settings *settings)
{
    lsf_json_begin(json, NULL, '{');
    lsf_json_string(json, "lightsheaf", lsf_version());
    lsf_json_string(json, "command", settings->command->name);
}

bool lsf_tool_print(const lsf_settings *settings, uint32_t index, char *text, lsf_error *error)
{
    bool good = text || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    if (good && !settings->quiet && !lsf_settings_print_json(settings))
        good = (index == 0 || lsf_file_write("-", "\n", 1, error)) &&
               lsf_file_write("-", text, strlen(text), error);
    free(text);
    return good;
}
