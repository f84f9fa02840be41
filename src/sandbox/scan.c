#include "sandbox/scan.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

/* The line that is scanned, and the state after those before it. */
typedef struct scanner {
    lsf_sandbox_text *text;
    lsf_sandbox_pass_text *pass;
    lsf_error *error;
    const char *path;
    uint32_t line;
    bool in_comment;  /* of the kind that spans lines */
    bool after_void;  /* the word before was that: what follows is a function */
    char uniform[64]; /* that the line declares, or "" */
    bool code;        /* the line holds more than a comment */
    bool range;       /* a slider's, of a line above that is a comment alone */
    float minimum, maximum;
} scanner;

static bool out_of_memory(const scanner *s)
{
    return lsf_error_set(s->error, LSF_ERROR_RENDER, "out of memory while reading a shader");
}

static bool refuse(const scanner *s, const char *name, const char *use)
{
    return lsf_error_set(s->error, LSF_ERROR_RENDER, "%s:%u: %s: write %s", s->path, s->line, name,
                         use);
}

static bool set_location(const scanner *s, lsf_sandbox_location *location)
{
    free(location->path);
    *location = (lsf_sandbox_location){strdup(s->path), s->line};
    return location->path || out_of_memory(s);
}

/* --- annotations --- */

static bool read_channel(const scanner *s, const char *rest)
{
    int end = 0;
    unsigned index;
    if (sscanf(rest, " %u %n", &index, &end) != 1 || end == 0 || index >= LSF_SANDBOX_CHANNELS ||
        rest[end] == '\0')
        return refuse(s, "@channel", "// @channel N SOURCE, with N from 0 to 3");
    lsf_sandbox_channel_text *channel = &s->pass->channels[index];
    free(channel->source);
    channel->source = strdup(rest + end);
    return channel->source ? set_location(s, &channel->location) : out_of_memory(s);
}

/* The uniform of the line; a range is known once it was read anywhere. */
static bool add_uniform(const scanner *s, bool range)
{
    lsf_sandbox_text *text = s->text;
    lsf_sandbox_own *own = NULL;
    for (uint64_t i = 0; i < text->uniform_count; i++)
        if (strcmp(text->uniforms[i].name, s->uniform) == 0)
            own = &text->uniforms[i];
    if (!own) {
        void *uniforms = text->uniforms;
        if (!lsf_grow(&uniforms, &text->uniform_capacity, text->uniform_count + 1,
                      sizeof *text->uniforms))
            return out_of_memory(s);
        text->uniforms = uniforms;
        own = &text->uniforms[text->uniform_count];
        *own = (lsf_sandbox_own){.name = strdup(s->uniform)};
        if (!own->name)
            return out_of_memory(s);
        text->uniform_count++;
    }
    if (range) {
        own->slider = true;
        own->minimum = s->minimum;
        own->maximum = s->maximum;
    }
    return true;
}

static bool read_slider(scanner *s, const char *rest)
{
    char *end, *last;
    double low = lsf_read_number(rest, &end), high = lsf_read_number(end, &last);
    if (end == rest || last == end || !(low < high) || !isfinite(low) || !isfinite(high))
        return refuse(s, "@slider", "// @slider MINIMUM MAXIMUM");
    s->minimum = (float)low;
    s->maximum = (float)high;
    s->range = true;
    return true;
}

static bool read_bundle(scanner *s, const char *rest)
{
    float *v = s->text->bundle;
    const char *at = rest;
    for (int i = 0; i < 3; i++) {
        char *end;
        v[i] = (float)lsf_read_number(at, &end);
        if (end == at || !isfinite(v[i]))
            return refuse(s, "@bundle", "// @bundle X Y Z");
        at = end;
    }
    s->text->bundle_given = v[0] != 0.0f || v[1] != 0.0f || v[2] != 0.0f;
    return s->text->bundle_given || refuse(s, "@bundle", "a direction that is not 0");
}

static bool read_light(scanner *s, const char *rest)
{
    unsigned index;
    if (sscanf(rest, " %u", &index) != 1)
        return refuse(s, "@light", "// @light N");
    s->text->light = index;
    return set_location(s, &s->text->light_location);
}

static bool read_output(scanner *s, const char *rest)
{
    char word[16];
    if (sscanf(rest, " %15s", word) != 1 ||
        (strcmp(word, "radiance") != 0 && strcmp(word, "display") != 0))
        return refuse(s, "@output", "// @output radiance, or display");
    s->text->radiance = word[0] == 'r';
    return true;
}

static bool read_define(scanner *s, const char *rest)
{
    lsf_sandbox_text *text = s->text;
    rest += strspn(rest, " \t");
    size_t length = strcspn(rest, " \t");
    if (!memchr(rest, '=', length))
        return refuse(s, "@define", "// @define pass.key=value");
    void *defines = text->defines;
    if (!lsf_grow(&defines, &text->define_capacity, text->define_count + 1, sizeof *text->defines))
        return out_of_memory(s);
    text->defines = defines;
    text->defines[text->define_count] = strndup(rest, length);
    return text->defines[text->define_count++] || out_of_memory(s);
}

/* Reads a word behind "@" in a comment. Words without a meaning here are the user's own. */
static bool read_annotation(scanner *s, const char *comment)
{
    static const struct {
        const char *name;
        bool (*read)(scanner *s, const char *rest);
    } words[] = {{"@slider", read_slider},
                 {"@bundle", read_bundle},
                 {"@light", read_light},
                 {"@output", read_output},
                 {"@define", read_define}};
    size_t length = strcspn(comment, " \t");
    if (length == 8 && strncmp(comment, "@channel", length) == 0)
        return read_channel(s, comment + length);
    if (length == 7 && strncmp(comment, "@jitter", length) == 0)
        s->text->jitter = true;
    for (size_t i = 0; i < LSF_COUNT(words); i++)
        if (length == strlen(words[i].name) && strncmp(comment, words[i].name, length) == 0)
            return words[i].read(s, comment + length);
    return true;
}

/* --- names --- */

static bool note_name(scanner *s, const char *word, size_t length, bool declared)
{
    lsf_sandbox_pass_text *pass = s->pass;
    uint32_t name = lsf_sandbox_find_name(word, length);
    pass->main_image |= s->after_void && length == 9 && memcmp(word, "mainImage", length) == 0;
    pass->main |= s->after_void && length == 4 && memcmp(word, "main", length) == 0;
    s->after_void = length == 4 && memcmp(word, "void", length) == 0;
    if (name == LSF_NONE)
        return true;
    pass->needs |= lsf_sandbox_row_at(name)->needs;
    pass->declares[name] |= declared;
    if (pass->mentions[name])
        return true;
    pass->mentions[name] = true;
    return set_location(s, &pass->locations[name]);
}

static bool is_precision(const char *word, size_t length)
{
    return (length == 5 && strncmp(word, "highp", length) == 0) ||
           (length == 7 && strncmp(word, "mediump", length) == 0) ||
           (length == 4 && strncmp(word, "lowp", length) == 0);
}

/* Looks at the code of a line, and returns its comment, NULL where there is none. */
static const char *scan_code(scanner *s, const char *line, bool *good)
{
    int words = -1; /* since "uniform" */
    const char *at = line;
    while (*at) {
        if (s->in_comment) {
            const char *end = strstr(at, "*/");
            if (!end)
                return NULL;
            s->in_comment = false;
            at = end + 2;
        } else if (at[0] == '/' && at[1] == '*') {
            s->in_comment = true;
            at += 2;
        } else if (at[0] == '/' && at[1] == '/') {
            return at + 2;
        } else if (isalpha((unsigned char)*at) || *at == '_') {
            size_t length = 1;
            while (isalnum((unsigned char)at[length]) || at[length] == '_')
                length++;
            if (words >= 0 && !is_precision(at, length))
                words++;
            bool declares = words == 2;
            if (declares && length < sizeof s->uniform)
                snprintf(s->uniform, sizeof s->uniform, "%.*s", (int)length, at);
            if (length == 7 && strncmp(at, "uniform", length) == 0)
                words = 0;
            *good = *good && note_name(s, at, length, declares);
            s->code = true;
            at += length;
        } else {
            s->code = s->code || !isspace((unsigned char)*at);
            /* The letters within a number are no name. */
            at += isdigit((unsigned char)*at) ? strspn(at, "0123456789abcdefABCDEFxXuU.lL") : 1;
        }
    }
    return NULL;
}

static bool scan_line(scanner *s, const char *line)
{
    bool good = true;
    bool above = s->range;
    s->range = s->code = false;
    s->uniform[0] = '\0';
    const char *comment = scan_code(s, line, &good);
    if (comment)
        comment += strspn(comment, " \t/");
    if (good && comment && *comment == '@')
        good = read_annotation(s, comment);
    if (good && s->uniform[0] && lsf_sandbox_find_name(s->uniform, strlen(s->uniform)) == LSF_NONE)
        good = add_uniform(s, s->range || above);
    if (s->code)
        s->range = false;
    return good;
}

bool lsf_sandbox_scan(lsf_sandbox_text *text, lsf_sandbox_pass_text *pass,
                      const lsf_shader_source *source, lsf_error *error)
{
    scanner s = {.text = text, .pass = pass, .error = error};
    const char *at = source->text.text;
    bool good = true;
    for (uint64_t i = 0; i < source->path_count; i++)
        pass->needs |= lsf_sandbox_needs_of_file(source->paths[i]);
    for (uint64_t i = 0; i < source->line_count && good; i++) {
        size_t length = strcspn(at, "\n");
        if (source->origins[i].foreign) {
            char *line = strndup(at, length);
            s.path = source->paths[source->origins[i].file];
            s.line = source->origins[i].line;
            good = line ? scan_line(&s, line) : out_of_memory(&s);
            free(line);
        }
        at += length + 1;
    }
    return good;
}
