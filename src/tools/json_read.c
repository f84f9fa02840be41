#include "tools/json_read.h"

#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 64 };

typedef struct reader {
    lsf_json_document *document;
    char *at; /* strings are decoded in place: they only get shorter */
    const char *end;
    const char *fault; /* what is wrong at `at` */
} reader;

static bool fail(reader *r, const char *fault)
{
    r->fault = fault;
    return false;
}

static void skip_space(reader *r)
{
    while (r->at < r->end && strchr(" \t\r\n", *r->at))
        r->at++;
}

static bool take(reader *r, const char *word)
{
    size_t length = strlen(word);
    if ((size_t)(r->end - r->at) < length || memcmp(r->at, word, length) != 0)
        return false;
    r->at += length;
    return true;
}

/* --- strings --- */

static bool read_unit(reader *r, uint32_t *unit)
{
    *unit = 0;
    for (int i = 0; i < 4; i++, r->at++) {
        const char *digits = "0123456789abcdef", *digit;
        if (r->at >= r->end || !*r->at || !(digit = strchr(digits, *r->at | 0x20)))
            return fail(r, "four hexadecimal digits are missing after \\u");
        *unit = *unit * 16 + (uint32_t)(digit - digits);
    }
    return true;
}

static char *put_utf8(char *to, uint32_t code)
{
    if (code < 0x80) {
        *to++ = (char)code;
    } else if (code < 0x800) {
        *to++ = (char)(0xc0 | code >> 6);
        *to++ = (char)(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    } else {
        *to++ = (char)(0xf0 | code >> 18);
        *to++ = (char)(0x80 | (code >> 12 & 0x3f));
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
        *to++ = (char)(0x80 | (code & 0x3f));
    }
    return to;
}

static bool read_escape(reader *r, char **to)
{
    static const char plain[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    uint32_t code, low;
    if (r->at >= r->end)
        return fail(r, "the text ends in a string");
    char letter = *r->at++;
    const char *found = letter ? strchr(plain, letter) : NULL;
    if (found) {
        *(*to)++ = meant[found - plain];
        return true;
    }
    if (letter != 'u')
        return fail(r, "no such escape");
    if (!read_unit(r, &code))
        return false;
    if (code >= 0xd800 && code < 0xdc00) { /* the first half of a surrogate pair */
        if (!take(r, "\\u") || !read_unit(r, &low) || low < 0xdc00 || low > 0xdfff)
            return fail(r, "half a surrogate pair");
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
    }
    if (code == 0)
        return fail(r, "a NUL in a string");
    *to = put_utf8(*to, code);
    return true;
}

static bool read_string(reader *r, const char **text)
{
    if (!take(r, "\""))
        return fail(r, "a string is missing");
    char *to = r->at;
    *text = to;
    while (r->at < r->end && *r->at != '"') {
        if ((unsigned char)*r->at < 0x20)
            return fail(r, "a control character in a string");
        if (*r->at != '\\') {
            *to++ = *r->at++;
            continue;
        }
        r->at++;
        if (!read_escape(r, &to))
            return false;
    }
    if (r->at >= r->end)
        return fail(r, "the text ends in a string");
    r->at++;
    *to = '\0'; /* the closing quote's place, or before it */
    return true;
}

/* --- values --- */

static uint32_t add_value(reader *r)
{
    lsf_json_document *d = r->document;
    void *values = d->values;
    if (!lsf_grow(&values, &d->capacity, (uint64_t)d->count + 1, sizeof *d->values)) {
        fail(r, "no memory left");
        return UINT32_MAX;
    }
    d->values = values;
    d->values[d->count] = (lsf_json_value){.number = NAN};
    return d->count++;
}

static bool read_number(reader *r, lsf_json_value *value)
{
    char *end;
    size_t length = strspn(r->at, "+-.0123456789eE");
    if (length == 0 || *r->at == '+' || *r->at == '.')
        return fail(r, "no value");
    value->kind = LSF_JSON_NUMBER;
    value->number = lsf_read_number(r->at, &end);
    if (end != r->at + length)
        return fail(r, "no number");
    r->at = end;
    return true;
}

static bool read_value(reader *r, uint32_t index, uint32_t depth);

/* The content between brackets. */
static bool read_children(reader *r, uint32_t index, uint32_t depth, char close)
{
    bool object = close == '}';
    uint32_t last = 0;
    r->document->values[index].kind = object ? LSF_JSON_OBJECT : LSF_JSON_ARRAY;
    r->at++;
    skip_space(r);
    if (r->at < r->end && *r->at == close) {
        r->at++;
        return true;
    }
    if (depth == DEEPEST)
        return fail(r, "brackets too deep");
    do {
        const char *name = NULL;
        skip_space(r);
        if (object && !read_string(r, &name))
            return false;
        skip_space(r);
        if (object && !take(r, ":"))
            return fail(r, "a colon is missing");
        uint32_t child = add_value(r);
        if (child == UINT32_MAX || !read_value(r, child, depth + 1))
            return false;
        r->document->values[child].name = name;
        if (last)
            r->document->values[last].next = child;
        else
            r->document->values[index].children = child;
        last = child;
        skip_space(r);
    } while (take(r, ","));
    if (r->at >= r->end || *r->at != close)
        return fail(r, "a comma or a bracket is missing");
    r->at++;
    return true;
}

static bool read_value(reader *r, uint32_t index, uint32_t depth)
{
    skip_space(r);
    lsf_json_value *value = &r->document->values[index];
    if (r->at >= r->end)
        return fail(r, "the text ends too early");
    if (*r->at == '{' || *r->at == '[')
        return read_children(r, index, depth, *r->at == '{' ? '}' : ']');
    if (*r->at == '"') {
        value->kind = LSF_JSON_STRING;
        return read_string(r, &value->text);
    }
    bool is_true = take(r, "true");
    if (is_true || take(r, "false")) {
        value->kind = LSF_JSON_BOOL;
        value->number = is_true;
        return true;
    }
    return take(r, "null") || read_number(r, value);
}

static uint32_t line_of(const char *text, size_t offset)
{
    uint32_t line = 1;
    for (size_t i = 0; i < offset; i++)
        line += text[i] == '\n';
    return line;
}

bool lsf_json_parse(lsf_json_document *document, const char *text, size_t length, const char *path,
                    lsf_error *error)
{
    *document = (lsf_json_document){.text = lsf_alloc((uint64_t)length + 1, 1)};
    if (!document->text)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", path);
    memcpy(document->text, text, length);
    reader r = {.document = document, .at = document->text, .end = document->text + length};
    uint32_t root = add_value(&r);
    bool good = root != UINT32_MAX && read_value(&r, root, 0);
    skip_space(&r);
    if (good && r.at != r.end)
        good = fail(&r, "something stands behind the end");
    return good || lsf_error_set(error, LSF_ERROR_FILE, "%s: line %u: %s", path,
                                 line_of(text, (size_t)(r.at - document->text)), r.fault);
}

void lsf_json_document_finish(lsf_json_document *document)
{
    free(document->text);
    free(document->values);
    *document = (lsf_json_document){0};
}

/* --- queries --- */

const lsf_json_value *lsf_json_first(const lsf_json_document *document, const lsf_json_value *value)
{
    return value && value->children ? &document->values[value->children] : NULL;
}

const lsf_json_value *lsf_json_next(const lsf_json_document *document, const lsf_json_value *value)
{
    return value && value->next ? &document->values[value->next] : NULL;
}

const lsf_json_value *lsf_json_find(const lsf_json_document *document, const lsf_json_value *object,
                                    const char *name)
{
    if (!object || object->kind != LSF_JSON_OBJECT)
        return NULL;
    for (const lsf_json_value *v = lsf_json_first(document, object); v;
         v = lsf_json_next(document, v))
        if (strcmp(v->name, name) == 0)
            return v;
    return NULL;
}

double lsf_json_find_number(const lsf_json_document *document, const lsf_json_value *object,
                            const char *name)
{
    const lsf_json_value *value = lsf_json_find(document, object, name);
    return value ? value->number : NAN;
}

const char *lsf_json_find_string(const lsf_json_document *document, const lsf_json_value *object,
                                 const char *name)
{
    const lsf_json_value *value = lsf_json_find(document, object, name);
    return value && value->kind == LSF_JSON_STRING ? value->text : NULL;
}
