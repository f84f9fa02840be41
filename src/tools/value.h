/* How an option's text becomes a value. */
#ifndef LSF_TOOLS_VALUE_H
#define LSF_TOOLS_VALUE_H

#include "tools/options.h"

/* Stores what `text` says at the option's place; of flags nothing is read. LSF_ERROR_USAGE names
 * option, value and range. */
bool lsf_settings_set(lsf_settings *settings, const lsf_command_option *option, const char *text,
                      lsf_error *error);

/* False without memory. */
bool lsf_list_append(lsf_list_setting *list, const char *item);

#endif
