/* Log: one process-wide handler that receives every message of the library. */
#ifndef LIGHTSHEAF_LOG_H
#define LIGHTSHEAF_LOG_H

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef enum lsf_log_level {
    LSF_LOG_DEBUG,
    LSF_LOG_INFO,
    LSF_LOG_WARNING,
    LSF_LOG_ERROR,
} lsf_log_level;

/* `message` has no trailing newline and is valid during the call only. The handler may be called
 * from any thread of the library. */
typedef void (*lsf_log_handler)(lsf_log_level level, const char *message, void *user);

/* Replaces the handler; NULL restores the default, which writes warnings and errors to stderr.
 * Call before other threads use the library. */
void lsf_log_set_handler(lsf_log_handler handler, void *user);

void lsf_log(lsf_log_level level, const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 2, 3)))
#endif
    ;

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
