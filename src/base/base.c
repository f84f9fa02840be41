#include "base/base.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void *lsf_alloc(uint64_t count, uint64_t size)
{
    uint64_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > PTRDIFF_MAX)
        return NULL;
    return calloc(bytes ? bytes : 1, 1);
}

bool lsf_grow(void **array, uint64_t *capacity, uint64_t needed, uint64_t size)
{
    if (needed <= *capacity)
        return true;
    uint64_t grown = *capacity + *capacity / 2 < needed ? needed : *capacity + *capacity / 2;
    uint64_t bytes;
    if (__builtin_mul_overflow(grown, size, &bytes) || bytes > PTRDIFF_MAX)
        return false;
    void *moved = realloc(*array, bytes ? bytes : 1);
    if (!moved)
        return false;
    *array = moved;
    *capacity = grown;
    return true;
}

char *lsf_format_arguments(const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    int length = lsf_format_plain(NULL, 0, format, arguments);
    char *text = length < 0 ? NULL : malloc((size_t)length + 1);
    if (text)
        lsf_format_plain(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

char *lsf_format(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = lsf_format_arguments(format, arguments);
    va_end(arguments);
    return text;
}

static double seconds_of(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double lsf_now(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

double lsf_thread_seconds(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}
