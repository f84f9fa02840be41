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
