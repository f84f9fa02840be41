/* How every subcommand begins: options and log. */
#ifndef LSF_TOOLS_BEGIN_H
#define LSF_TOOLS_BEGIN_H

#include "tools/json.h"
#include "tools/options.h"

enum { LSF_GO_ON = -1 };

/* Parses the command line, takes over the log, and answers --help, --version and the lists.
 * LSF_GO_ON, or the exit status to end with. Finish `settings` in either case. */
int lsf_tool_begin(lsf_settings *settings, lsf_command_bit command, int argc, char **argv);

/* Begins an object with the members that all commands' JSON has. */
void lsf_tool_begin_json(lsf_json *json, const lsf_settings *settings);

/* Prints a malloc'ed text, which it frees, unless JSON takes its place or all is to be quiet; an
 * empty line stands before all but that of index 0. NULL: there was no memory for it. */
bool lsf_tool_print(const lsf_settings *settings, uint32_t index, char *text, lsf_error *error);

#endif
