#include "io/image_header.h"
#include "io/io.h"

#include <stdlib.h>
#include <string.h>

/* The text of `lightsheaf info` for a picture. */

typedef struct description {
    const char *path;
    uint8_t *bytes;
    size_t length;
    lsf_image_header header;
} description;

static const char *const formats[] = {[LSF_IMAGE_FILE_PNG] = "png",
                                      [LSF_IMAGE_FILE_JPEG] = "jpeg",
                                      [LSF_IMAGE_FILE_HDR] = "hdr",
                                      [LSF_IMAGE_FILE_EXR] = "exr",
                                      [LSF_IMAGE_FILE_WEBP] = "webp"};

bool lsf_image_recognise(const char *path)
{
    if (!path)
        return false;
    static const struct {
        const char *magic;
        size_t length, at;
    } beginnings[] = {{"\x89PNG\r\n\x1a\n", 8, 0}, {"\xff\xd8\xff", 3, 0},
                      {"#?RADIANCE", 10, 0},       {"#?RGBE", 6, 0},
                      {"\x76\x2f\x31\x01", 4, 0},  {"WEBP", 4, 8}};
    size_t length;
    char *bytes = lsf_file_read_start(path, 12, &length, NULL);
    bool known = false;
    for (size_t i = 0; bytes && i < LSF_COUNT(beginnings); i++)
        known = known ||
                (length >= beginnings[i].at + beginnings[i].length &&
                 memcmp(bytes + beginnings[i].at, beginnings[i].magic, beginnings[i].length) == 0);
    free(bytes);
    return known;
}

/* The name of channel `index`; `at` is kept from one to the next. */
static const char *channel_name(const description *d, uint32_t index, size_t *at)
{
    static const char *const names[] = {"Y", "A", "R", "G", "B", "A"};
    if (d->header.file == LSF_IMAGE_FILE_EXR)
        return lsf_exr_next_channel(d->bytes, at);
    return names[d->header.channels > 2 ? index + 2 : index];
}

static bool next_text(const description *d, size_t *at, lsf_header_text *text)
{
    return d->header.file == LSF_IMAGE_FILE_EXR   ? lsf_exr_next_text(d->bytes, at, text)
           : d->header.file == LSF_IMAGE_FILE_PNG ? lsf_png_next_text(d->bytes, d->length, at, text)
                                                  : false;
}

static void describe_json(const description *d, lsf_string *out)
{
    static const char *const types[] = {"u8", "u16", "f32"};
    lsf_string_add(out, "{\n  \"picture\": ");
    lsf_string_add_json(out, d->path);
    lsf_string_add(out,
                   ",\n  \"format\": \"%s\", \"resolution\": [%u, %u], \"type\": \"%s\",\n"
                   "  \"channels\": [",
                   formats[d->header.file], d->header.width, d->header.height,
                   types[d->header.type]);
    size_t at = 0;
    for (uint32_t c = 0; c < d->header.channels; c++) {
        lsf_string_add(out, c ? ", " : "");
        lsf_string_add_json(out, channel_name(d, c, &at));
    }
    lsf_string_add(out, "],\n  \"texts\": {");
    lsf_header_text text;
    const char *separator = "\n    ";
    for (at = 0; next_text(d, &at, &text); separator = ",\n    ") {
        char *value = lsf_format("%.*s", (int)text.length, text.value);
        lsf_string_add(out, "%s", separator);
        lsf_string_add_json(out, text.key);
        lsf_string_add(out, ": ");
        lsf_string_add_json(out, value ? value : "");
        out->failed |= !value;
        free(value);
    }
    lsf_string_add(out, *separator == ',' ? "\n  }\n}\n" : "}\n}\n");
}

/* Control characters in the file must not reach a terminal. */
static void add_printable(lsf_string *out, const char *text, size_t length)
{
    char *copy = lsf_format("%.*s", (int)length, text);
    if (copy)
        lsf_make_printable(copy);
    lsf_string_add(out, "%s", copy ? copy : "");
    out->failed |= !copy;
    free(copy);
}

static void describe_text(const description *d, lsf_string *out)
{
    static const int bits[] = {8, 16, 32};
    lsf_string_add(out, "%s\n%-24s %s, %u x %u, %d bit\n%-24s", d->path, "picture",
                   formats[d->header.file], d->header.width, d->header.height, bits[d->header.type],
                   "channels");
    size_t at = 0;
    for (uint32_t c = 0; c < d->header.channels; c++) {
        const char *name = channel_name(d, c, &at);
        lsf_string_add(out, " ");
        add_printable(out, name, strlen(name));
    }
    lsf_string_add(out, "\n");
    lsf_header_text text;
    for (at = 0; next_text(d, &at, &text);) {
        size_t start = out->length;
        add_printable(out, text.key, strlen(text.key));
        size_t width = out->length - start;
        lsf_string_add(out, "%*s ", width < 24 ? (int)(24 - width) : 0, "");
        add_printable(out, text.value, text.length);
        lsf_string_add(out, "\n");
    }
}

char *lsf_image_describe(const char *path, bool json, lsf_error *error)
{
    if (!lsf_given(path, "path", error))
        return NULL;
    description d = {.path = path};
    d.bytes = (uint8_t *)lsf_file_read(path, LSF_IMAGE_MAX_BYTES, &d.length, error);
    if (!d.bytes)
        return NULL;
    lsf_string out = {0};
    if (lsf_image_header_read(&d.header, d.bytes, d.length, UINT64_MAX, path, error)) {
        if (json)
            describe_json(&d, &out);
        else
            describe_text(&d, &out);
        if (out.failed) {
            lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", path);
            free(out.text);
            out.text = NULL;
        }
    }
    free(d.bytes);
    return out.text;
}
