#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>

static void write_to_stderr(lsf_log_level level, const char *message, void *user)
{
    (void)user;
    if (level >= LSF_LOG_WARNING)
        fprintf(stderr, "lightsheaf: %s: %s\n", level == LSF_LOG_ERROR ? "error" : "warning",
                message);
}

static lsf_log_handler current_handler = write_to_stderr;
static void *current_user;

void lsf_log_set_handler(lsf_log_handler handler, void *user)
{
    current_handler = handler ? handler : write_to_stderr;
    current_user = user;
}

void lsf_log(lsf_log_level level, const char *format, ...)
{
    char message[4096];
    va_list arguments;
    va_start(arguments, format);
    lsf_format_plain(message, sizeof message, format, arguments);
    va_end(arguments);
    current_handler(level, message, current_user);
}
