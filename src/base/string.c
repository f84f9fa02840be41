#include "base/base.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void lsf_string_add_bytes(lsf_string *string, const char *bytes, size_t length)
{
    uint64_t capacity = string->capacity;
    void *text = string->text;
    if (string->failed || !lsf_grow(&text, &capacity, (uint64_t)string->length + length + 1, 1)) {
        string->failed = true;
        return;
    }
    string->text = text;
    string->capacity = (size_t)capacity;
    memcpy(string->text + string->length, bytes, length);
    string->length += length;
    string->text[string->length] = '\0';
}

const char *lsf_plural(uint64_t count)
{
    return count == 1 ? "" : "s";
}

static locale_t plain_locale;

static void make_plain_locale(void)
{
    plain_locale = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
}

/* 0 without memory: the locale stays what it is. */
static locale_t get_plain_locale(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, make_plain_locale);
    return plain_locale;
}

double lsf_read_number(const char *text, char **end)
{
    locale_t plain = get_plain_locale();
    return plain ? strtod_l(text, end, plain) : strtod(text, end);
}

int lsf_format_plain(char *buffer, size_t size, const char *format, va_list arguments)
{
    locale_t plain = get_plain_locale();
    locale_t before = plain ? uselocale(plain) : (locale_t)0;
    int length = vsnprintf(buffer, size, format, arguments);
    if (plain)
        uselocale(before);
    return length;
}

void lsf_string_add(lsf_string *string, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = lsf_format_arguments(format, arguments);
    va_end(arguments);
    if (!text) {
        string->failed = true;
        return;
    }
    lsf_string_add_bytes(string, text, strlen(text));
    free(text);
}

int lsf_print(char *buffer, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int length = lsf_format_plain(buffer, size, format, arguments);
    va_end(arguments);
    return length;
}

void lsf_make_printable(char *text)
{
    for (unsigned char *s = (unsigned char *)text; *s; s++) {
        bool second = s[0] == 0xc2 && s[1] >= 0x80 && s[1] < 0xa0; /* U+0080 to U+009F */
        if (*s < 0x20 || *s == 0x7f || second)
            *s = '?';
        if (second)
            *++s = '?';
    }
}

/* Length of the valid UTF-8 sequence at `s`, or 0. */
static size_t utf8_length(const unsigned char *s)
{
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xf0 && s[0] < 0xf5 ? 4 : s[0] >= 0xe0 ? 3 : s[0] >= 0xc2 ? 2 : 0;
    if (s[0] >= 0xf5)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] >= 0xa0) ||
        (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] >= 0x90))
        return 0; /* overlong, surrogate, or beyond U+10FFFF */
    return length;
}

void lsf_string_add_size(lsf_string *string, double bytes)
{
    const char *units[] = {"B", "KiB", "MiB", "GiB"};
    int unit = 0;
    for (; bytes >= 1024.0 && unit < 3; unit++)
        bytes /= 1024.0;
    lsf_string_add(string, unit ? "%.2f %s" : "%.0f %s", bytes, units[unit]);
}

void lsf_string_add_json(lsf_string *string, const char *text)
{
    lsf_string_add_bytes(string, "\"", 1);
    for (const unsigned char *s = (const unsigned char *)text; *s;) {
        size_t length = utf8_length(s);
        if (*s == '"' || *s == '\\') {
            char escaped[2] = {'\\', (char)*s};
            lsf_string_add_bytes(string, escaped, 2);
        } else if (*s < 0x20 || *s == 0x7f) {
            lsf_string_add(string, "\\u%04x", *s);
        } else if (length == 0) {
            lsf_string_add(string, "\\ufffd");
            length = 1;
        } else {
            lsf_string_add_bytes(string, (const char *)s, length);
        }
        s += length ? length : 1;
    }
    lsf_string_add_bytes(string, "\"", 1);
}

void lsf_string_add_json_number(lsf_string *string, double value)
{
    if (!isfinite(value))
        lsf_string_add(string, "null");
    else if (value == floor(value) && fabs(value) < 1e15)
        lsf_string_add(string, "%.0f", value);
    else
        lsf_string_add(string, "%.9g", value);
}
