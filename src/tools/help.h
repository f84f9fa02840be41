/* --help, --list-options and --list-techniques as text. */
#ifndef LSF_TOOLS_HELP_H
#define LSF_TOOLS_HELP_H

#include "base/base.h"
#include "tools/options.h"

/* The commands, and where to find more. */
void lsf_help_overview(lsf_string *text);

/* One command: usage, purpose, options by group. */
void lsf_help_command(lsf_string *text, const lsf_command *command);

/* "-o, --output OUT" */
void lsf_help_option_title(lsf_string *text, const lsf_command_option *option);

void lsf_help_pass_options(lsf_string *text);
void lsf_help_techniques(lsf_string *text);
/* The names that a sandbox shader may use. */
void lsf_help_sandbox_names(lsf_string *text);

#endif
