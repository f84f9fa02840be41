#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>

bool lsf_error_set(lsf_error *error, lsf_error_code code, const char *format, ...)
{
    if (error) {
        error->code = code;
        va_list arguments;
        va_start(arguments, format);
        lsf_format_plain(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return false;
}

bool lsf_given(const void *argument, const char *name, lsf_error *error)
{
    return argument || lsf_error_set(error, LSF_ERROR_USAGE,
                                     "%s is NULL and must not be; the call that was to make it may "
                                     "have failed",
                                     name);
}
