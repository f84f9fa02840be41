/* Numbers as a command line takes them: the whole text, finite, in range, whatever the locale. */
#ifndef LSF_TOOLS_NUMBER_H
#define LSF_TOOLS_NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Decimal digits only. False when it is no such number or above `maximum`. */
bool lsf_parse_integer(const char *text, uint64_t maximum, uint64_t *value);

/* Decimal, with optional sign, fraction and exponent; no blanks, hexadecimal, inf or nan. */
bool lsf_parse_number(const char *text, double minimum, double maximum, double *value);

/* Exactly `count` numbers separated by commas. */
bool lsf_parse_numbers(const char *text, double minimum, double maximum, size_t count,
                       float *values);

/* The candidate nearest to `text` by edits (insert, delete, replace, swap), or NULL when none is
 * near enough to be what was meant. `next` returns the candidates in turn and NULL at the end. */
const char *lsf_nearest(const char *text, const char *(*next)(size_t index, void *user),
                        void *user);

#endif
