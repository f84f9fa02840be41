#include "tools/report.h"

#include "base/base.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <xxhash.h>

/* The log may be called from any thread, while another one draws a bar. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static lsf_verbosity verbosity = LSF_VERBOSITY_NORMAL;
static bool bar_is_drawn;
static const char *subject;

static void clear_bar(void)
{
    if (bar_is_drawn)
        fputs("\r\033[K", stderr);
    bar_is_drawn = false;
}

/* Hashes of warnings, in the order in which they came; the oldest are forgotten. */
static uint64_t printed[256];
static size_t printed_count;
static bool once;

static bool was_printed(lsf_log_level level, const char *message)
{
    if (!once || level != LSF_LOG_WARNING)
        return false;
    uint64_t hash = XXH3_64bits(message, strlen(message));
    for (size_t i = 0; i < printed_count && i < LSF_COUNT(printed); i++)
        if (printed[i] == hash)
            return true;
    printed[printed_count++ % LSF_COUNT(printed)] = hash;
    return false;
}

static void log_message(lsf_log_level level, const char *message, void *user)
{
    (void)user;
    static const char *const titles[] = {
        [LSF_LOG_DEBUG] = "debug: ",
        [LSF_LOG_INFO] = "",
        [LSF_LOG_WARNING] = "warning: ",
        [LSF_LOG_ERROR] = "error: ",
    };
    lsf_log_level least = verbosity == LSF_VERBOSITY_QUIET    ? LSF_LOG_ERROR
                          : verbosity == LSF_VERBOSITY_NORMAL ? LSF_LOG_WARNING
                                                              : LSF_LOG_DEBUG;
    if (level < least)
        return;
    pthread_mutex_lock(&lock);
    if (was_printed(level, message)) {
        pthread_mutex_unlock(&lock);
        return;
    }
    clear_bar();
    bool named = !subject || strstr(message, subject);
    fprintf(stderr, "lightsheaf: %s%s%s%s\n", titles[level], named ? "" : subject,
            named ? "" : ": ", message);
    pthread_mutex_unlock(&lock);
}

void lsf_report_start(lsf_verbosity level)
{
    verbosity = level;
    lsf_log_set_handler(log_message, NULL);
}

void lsf_report_once(void)
{
    once = true;
}

void lsf_report_about(const char *path)
{
    subject = path;
}

int lsf_report_error(const lsf_error *error)
{
    log_message(LSF_LOG_ERROR, error->message, NULL);
    return (int)error->code;
}

void lsf_report_line(const char *format, ...)
{
    if (verbosity == LSF_VERBOSITY_QUIET)
        return;
    va_list arguments;
    va_start(arguments, format);
    pthread_mutex_lock(&lock);
    clear_bar();
    fputs("lightsheaf: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    pthread_mutex_unlock(&lock);
    va_end(arguments);
}

static void format_duration(char *text, size_t size, double seconds)
{
    if (seconds < 9.95)
        snprintf(text, size, "%.1f s", seconds);
    else if (seconds < 99.5)
        snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 5970)
        snprintf(text, size, "%.0f min", seconds / 60);
    else
        snprintf(text, size, "%.1f h", seconds / 3600);
}

void lsf_progress_bar_start(lsf_progress_bar *bar, const char *label, uint32_t total,
                            double time_limit)
{
    *bar = (lsf_progress_bar){.label = label, .time_limit = time_limit, .start = lsf_now()};
    lsf_progress_bar_draw(bar, 0, total);
}

void lsf_progress_bar_draw(lsf_progress_bar *bar, uint32_t done, uint32_t total)
{
    enum { WIDTH = 30 };
    if (verbosity == LSF_VERBOSITY_QUIET || !isatty(STDERR_FILENO))
        return;
    double now = lsf_now();
    if (now - bar->drawn < 0.1) /* seconds between two pictures of the bar */
        return;
    bar->drawn = now;

    double elapsed = now - bar->start;
    double by_count = total ? (double)done / (double)total : 1;
    double by_time = isfinite(bar->time_limit) ? elapsed / bar->time_limit : 0;
    double fraction = fmin(fmax(by_count, by_time), 1);
    char left[32] = "", count[32];
    if (fraction > 0.001) {
        char duration[24];
        format_duration(duration, sizeof duration, elapsed * (1 - fraction) / fraction);
        snprintf(left, sizeof left, ", %s left", duration);
    }
    if (total == UINT32_MAX)
        snprintf(count, sizeof count, "%u", done);
    else
        snprintf(count, sizeof count, "%u/%u", done, total);
    char filled[WIDTH + 1];
    for (int i = 0; i < WIDTH; i++)
        filled[i] = i < (int)(fraction * WIDTH) ? '#' : '.';
    filled[WIDTH] = '\0';

    pthread_mutex_lock(&lock);
    fprintf(stderr, "\r%s [%s] %3.0f%%  %s samples%s\033[K", bar->label, filled, 100 * fraction,
            count, left);
    bar_is_drawn = true;
    pthread_mutex_unlock(&lock);
}

void lsf_progress_bar_clear(void)
{
    pthread_mutex_lock(&lock);
    clear_bar();
    pthread_mutex_unlock(&lock);
}
