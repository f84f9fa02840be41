/* How every subcommand begins: options, log, and the scene. */
#ifndef LSF_TOOLS_BEGIN_H
#define LSF_TOOLS_BEGIN_H

#include "tools/options.h"

enum { LSF_GO_ON = -1 };

/* Parses the command line, takes over the log, and answers --help, --version and the lists.
 * LSF_GO_ON, or the exit status to end with. Finish `settings` in either case. */
int lsf_tool_begin(lsf_settings *settings, lsf_command_bit command, int argc, char **argv);

/* The operand, or the scene that comes with Lightsheaf. malloc'ed; NULL: LSF_ERROR_USAGE. */
char *lsf_tool_scene_path(const lsf_settings *settings, lsf_error *error);

/* Loads that scene; its path is malloc'ed into *path in either case. NULL on failure. */
lsf_scene *lsf_tool_load_scene(const lsf_settings *settings, char **path, double *seconds,
                               lsf_error *error);

/* Writes a malloc'ed text, which it frees, to a file, or to standard output by "-"; NULL: there was
 * no memory for it. */
bool lsf_tool_print(const char *path, char *text, lsf_error *error);

#endif
