/* Declarations that the commands about a user's shader share. */
#ifndef LSF_TOOLS_SANDBOX_H
#define LSF_TOOLS_SANDBOX_H

#include "tools/options.h"

/* The shader that the command line names. */
const char *lsf_sandbox_shader(const lsf_settings *settings);
/* What the library's calls take; the result borrows from `settings`. */
lsf_sandbox_params lsf_settings_sandbox_params(const lsf_settings *settings);

#endif
