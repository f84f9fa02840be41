#include "report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lightsheaf/image.h>

#include "report/page.h"

static void add_text(lsf_string *page, const char *text)
{
    lsf_string_add_bytes(page, text, strlen(text));
}

/* Within a script element: "<" stands in JSON's strings alone, where it may be written as an
 * escape; so no text of the data can end the element. */
static void add_data(lsf_string *page, const char *json)
{
    add_text(page, "<script type=\"application/json\" id=\"data\">\n");
    for (const char *rest = json; *rest;) {
        size_t length = strcspn(rest, "<");
        lsf_string_add_bytes(page, rest, length);
        rest += length;
        if (*rest) {
            add_text(page, "\\u003c");
            rest++;
        }
    }
    add_text(page, "</script>\n");
}

/* A pixel as mantissas and an exponent (G. Ward, "Real Pixels", Graphics Gems II, 1991). What is no
 * radiance is black. */
static void pack(const float rgb[3], unsigned char rgbe[4])
{
    float values[3], largest = 0.0f;
    for (int c = 0; c < 3; c++) {
        values[c] = rgb[c] > 0.0f && isfinite(rgb[c]) ? fminf(rgb[c], 0x1p126f) : 0.0f;
        largest = fmaxf(largest, values[c]);
    }
    memset(rgbe, 0, 4);
    if (largest < 0x1p-120f)
        return;
    int exponent;
    frexpf(largest, &exponent);
    for (int c = 0; c < 3; c++)
        rgbe[c] = (unsigned char)ldexpf(values[c], 8 - exponent);
    rgbe[3] = (unsigned char)(exponent + 128);
}

/* RFC 4648, section 4. */
static void add_base64(lsf_string *page, const unsigned char *bytes, size_t length)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < length; i += 3) {
        size_t rest = length - i;
        unsigned word = (unsigned)bytes[i] << 16 | (rest > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                        (rest > 2 ? bytes[i + 2] : 0);
        char out[4] = {digits[word >> 18], digits[word >> 12 & 63], digits[word >> 6 & 63],
                       digits[word & 63]};
        memset(out + 1 + (rest < 3 ? rest : 3), '=', rest < 3 ? 3 - rest : 0);
        lsf_string_add_bytes(page, out, 4);
    }
}

static bool add_picture(lsf_string *page, const lsf_report_picture *picture, lsf_error *error)
{
    lsf_image *image = lsf_image_load(picture->path, error);
    if (!image)
        return false;
    static const char *const names[] = {"R", "G", "B"};
    int channels[3];
    size_t pixels = (size_t)image->width * image->height;
    unsigned char *packed = lsf_alloc(pixels, 4);
    bool good = packed || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (int c = 0; good && c < 3; c++) {
        channels[c] = lsf_image_channel(image, names[c]);
        good = channels[c] >= 0 || lsf_error_set(error, LSF_ERROR_FILE, "%s has no channel %s",
                                                 picture->path, names[c]);
    }
    if (good) {
        for (size_t i = 0; i < pixels; i++) {
            const float *pixel = image->pixels + i * image->channel_count;
            pack((float[]){pixel[channels[0]], pixel[channels[1]], pixel[channels[2]]},
                 packed + 4 * i);
        }
        lsf_string_add(page,
                       "<script type=\"text/plain\" id=\"picture-%s\" data-width=\"%u\" "
                       "data-height=\"%u\">",
                       picture->id, image->width, image->height);
        add_base64(page, packed, 4 * pixels);
        add_text(page, "</script>\n");
    }
    free(packed);
    lsf_image_destroy(image);
    return good;
}

bool lsf_report_write(const char *path, const char *json, const lsf_report_picture *pictures,
                      uint32_t count, lsf_error *error)
{
    lsf_string page = {0};
    lsf_string_add_bytes(&page, (const char *)lsf_report_head, lsf_report_head_length);
    add_data(&page, json);
    bool good = true;
    for (uint32_t i = 0; good && i < count && page.length < LSF_REPORT_PICTURE_BYTES; i++)
        good = add_picture(&page, &pictures[i], error);
    lsf_string_add_bytes(&page, (const char *)lsf_report_tail, lsf_report_tail_length);
    if (good && page.failed)
        good = lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && lsf_file_write(path, page.text, page.length, error);
    free(page.text);
    return good;
}
