#include "tools/number.h"

#include "base/base.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool lsf_parse_integer(const char *text, uint64_t maximum, uint64_t *value)
{
    uint64_t sum = 0;
    if (!*text)
        return false;
    for (; *text; text++) {
        if (*text < '0' || *text > '9' || __builtin_mul_overflow(sum, 10u, &sum) ||
            __builtin_add_overflow(sum, (uint64_t)(*text - '0'), &sum))
            return false;
    }
    *value = sum;
    return sum <= maximum;
}

static const char *skip_digits(const char *text)
{
    while (*text >= '0' && *text <= '9')
        text++;
    return text;
}

/* sign? (digits [. digits?] | . digits) ([eE] sign? digits)? */
static bool is_decimal(const char *text)
{
    text += *text == '-' || *text == '+';
    const char *whole = text;
    text = skip_digits(text);
    bool digits = text > whole;
    if (*text == '.') {
        const char *fraction = ++text;
        text = skip_digits(text);
        digits = digits || text > fraction;
    }
    if (!digits)
        return false;
    if (*text == 'e' || *text == 'E') {
        text++;
        text += *text == '-' || *text == '+';
        const char *exponent = text;
        text = skip_digits(text);
        if (text == exponent)
            return false;
    }
    return *text == '\0';
}

bool lsf_parse_number(const char *text, double minimum, double maximum, double *value)
{
    if (!is_decimal(text))
        return false;
    *value = lsf_read_number(text, NULL);
    return isfinite(*value) && *value >= minimum && *value <= maximum;
}

bool lsf_parse_numbers(const char *text, double minimum, double maximum, size_t count,
                       float *values)
{
    for (size_t i = 0; i < count; i++) {
        char part[64];
        size_t length = strcspn(text, ",");
        if (length >= sizeof part || (text[length] == ',') != (i + 1 < count))
            return false;
        memcpy(part, text, length);
        part[length] = '\0';
        double value;
        if (!lsf_parse_number(part, minimum, maximum, &value))
            return false;
        values[i] = (float)value;
        if (!isfinite(values[i]))
            return false;
        text += length + 1;
    }
    return true;
}

enum { LONGEST = 64 };

/* Damerau's distance, restricted to neighbouring swaps; both no longer than LONGEST. */
static size_t edits_between(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LONGEST + 1];
    for (size_t j = 0; j <= b_length; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            size_t best = above[j - 1] +
                          (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
            if (above[j] + 1 < best)
                best = above[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                two_above[j - 2] + 1 < best)
                best = two_above[j - 2] + 1;
            row[j] = best;
        }
    }
    return rows[a_length % 3][b_length];
}

const char *lsf_nearest(const char *text, const char *(*next)(size_t index, void *user), void *user)
{
    size_t length = strlen(text);
    if (length == 0 || length > LONGEST)
        return NULL;
    const char *nearest = NULL;
    size_t fewest = length / 3 + 2; /* one edit in a short word, a third of a long one */
    for (size_t i = 0;; i++) {
        const char *candidate = next(i, user);
        if (!candidate)
            return nearest;
        size_t candidate_length = strlen(candidate);
        if (candidate_length > LONGEST)
            continue;
        size_t edits = edits_between(text, length, candidate, candidate_length);
        if (edits < fewest && edits < candidate_length) {
            fewest = edits;
            nearest = candidate;
        }
    }
}
