/* Presets: options in a file, one a line as name=value, or the name alone of those that take none;
 * lines that begin with # are comments. */
#ifndef LSF_TOOLS_PRESET_H
#define LSF_TOOLS_PRESET_H

#include "tools/options.h"

enum { LSF_PRESET_FILE = -1 };

/* Which of the names that the option --preset knows, from 0 on, or LSF_PRESET_FILE. */
int lsf_preset_number(const lsf_command_option *option, const char *text);

/* Sets what the file says. Options of the picture, its camera, its scene and its tones may stand
 * there, which the command takes. LSF_ERROR_FILE or LSF_ERROR_USAGE name file and line. */
bool lsf_preset_read(lsf_settings *settings, const char *path, lsf_error *error);
/* The same of a view, which may also name its scene, as file=PATH. */
bool lsf_view_read(lsf_settings *settings, const char *path, lsf_error *error);

#endif
