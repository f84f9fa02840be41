/* Shaders to begin with. */
#ifndef LSF_TOOLS_SANDBOX_NEW_H
#define LSF_TOOLS_SANDBOX_NEW_H

#include <lightsheaf/error.h>

/* Writes one, of the kind that the ending says. LSF_ERROR_FILE where there is a file already. */
bool lsf_sandbox_new(const char *path, lsf_error *error);

#endif
