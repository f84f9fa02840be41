/* Presets: options in a file, one a line as name=value, or the name alone of those that take none;
 * lines that begin with # are comments. */
#ifndef LSF_TOOLS_PRESET_H
#define LSF_TOOLS_PRESET_H

#include "tools/options.h"

/* Sets what the file says. Options of the picture, its camera, its scene and its tones may stand
 * there, which the command takes. LSF_ERROR_FILE or LSF_ERROR_USAGE name file and line. */
bool lsf_preset_read(lsf_settings *settings, const char *path, lsf_error *error);
/* The same of a view, which may also name its scene, as file=PATH. */
bool lsf_view_read(lsf_settings *settings, const char *path, lsf_error *error);

#endif
