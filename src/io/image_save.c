#include "io/image_module.h"
#include "io/io.h"
#include "shared/tonemap.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

_Static_assert((int)LSF_TONE_CURVE_NEUTRAL == LSF_CURVE_NEUTRAL &&
                   (int)LSF_TONE_CURVE_NONE == LSF_CURVE_NONE &&
                   (int)LSF_TONE_CURVE_ACES == LSF_CURVE_ACES &&
                   (int)LSF_TONE_CURVE_AGX == LSF_CURVE_AGX,
               "shaders number tone curves as the interface does");

static const char *shown_path(const char *path)
{
    return strcmp(path, "-") == 0 ? "standard output" : path;
}

static const lsf_image_module *get_module(const char *path, lsf_error *error)
{
    lsf_error cause;
    const lsf_image_module *module = lsf_image_module_get(&cause);
    if (!module)
        lsf_error_set(error, cause.code, "%s: cannot write: %s", shown_path(path), cause.message);
    return module;
}

static bool encode_and_write(const lsf_encode_request *request, const char *path, lsf_error *error)
{
    const lsf_image_module *module = get_module(path, error);
    void *bytes;
    size_t length;
    if (!module || !module->encode(request, &bytes, &length, shown_path(path), error))
        return false;
    bool written = lsf_file_write(path, bytes, length, error);
    free(bytes);
    return written;
}

static bool check_size(uint32_t width, uint32_t height, const char *path, lsf_error *error)
{
    if (width > 0 && height > 0 && width <= LSF_IMAGE_MAX_SIZE && height <= LSF_IMAGE_MAX_SIZE)
        return true;
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: an image of %u x %u pixels cannot be written; give 1 to %u a side",
                         shown_path(path), width, height, LSF_IMAGE_MAX_SIZE);
}

static bool find_format(lsf_image_format *format, const char *path, lsf_error *error)
{
    static const struct {
        const char *ending;
        lsf_image_format format;
    } endings[] = {{".exr", LSF_IMAGE_FORMAT_EXR},
                   {".hdr", LSF_IMAGE_FORMAT_HDR},
                   {".png", LSF_IMAGE_FORMAT_PNG}};
    if (*format != LSF_IMAGE_FORMAT_AUTO)
        return true;
    if (strcmp(path, "-") == 0) {
        *format = LSF_IMAGE_FORMAT_EXR;
        return true;
    }
    size_t length = strlen(path);
    for (size_t i = 0; i < LSF_COUNT(endings); i++)
        if (length > 4 && strcasecmp(path + length - 4, endings[i].ending) == 0) {
            *format = endings[i].format;
            return true;
        }
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: no image format goes with that ending; name it .exr, .hdr or .png",
                         path);
}

/* RGBE holds 8 bits of mantissa below a common exponent, and most writers cut the rest off, which
 * darkens a picture by a fifth of a percent. Rounding to what the format holds beforehand keeps
 * the mean. */
static void round_to_rgbe(float rgb[3])
{
    /* 255/256 * 2^127, the largest value of the format. */
    const float largest = 255.0f * 0x1p119f;
    for (int c = 0; c < 3; c++)
        rgb[c] = rgb[c] > 0.0f ? fminf(rgb[c], largest) : 0.0f; /* NaN too */
    float peak = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    int exponent;
    if (frexpf(peak, &exponent) >= 255.5f / 256.0f)
        exponent++; /* the peak rounds up to the next power of two */
    for (int c = 0; c < 3; c++)
        rgb[c] = ldexpf(rintf(ldexpf(rgb[c], 8 - exponent)), exponent - 8);
}

static bool save_hdr(const float *rgb, uint32_t width, uint32_t height, const char *path,
                     lsf_error *error)
{
    uint64_t count = (uint64_t)width * height, changed = 0;
    float *rounded = lsf_alloc(count, 3 * sizeof *rounded);
    if (!rounded)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", shown_path(path));
    memcpy(rounded, rgb, count * 3 * sizeof *rounded);
    for (uint64_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++)
            changed += !(rounded[3 * i + (uint64_t)c] >= 0.0f &&
                         rounded[3 * i + (uint64_t)c] <= 255.0f * 0x1p119f);
        round_to_rgbe(rounded + 3 * i);
    }
    if (changed)
        lsf_log(LSF_LOG_WARNING,
                "%s: %" PRIu64 " negative or non-finite values do not fit in HDR and were "
                "clamped; EXR keeps them",
                shown_path(path), changed);
    lsf_encode_request request = {.file = LSF_IMAGE_FILE_HDR,
                                  .width = width,
                                  .height = height,
                                  .channels = 3,
                                  .texels = rounded};
    bool saved = encode_and_write(&request, path, error);
    free(rounded);
    return saved;
}

/* Tone mapping is of light, not of pixels: a pixel that surfaces cover in part shows their light,
 * divided by that part. */
static void encode_pixel(const float *rgb, float alpha, float scale, lsf_tone_curve curve,
                         uint8_t *codes)
{
    float exposed[3];
    for (int c = 0; c < 3; c++)
        exposed[c] = lsf_tonemap_expose(alpha > 0.0f ? rgb[c] / alpha : 0.0f, scale);
    for (int c = 0; c < 3; c++) {
        float code = lsf_tonemap_code((int)curve, c, exposed[0], exposed[1], exposed[2]);
        codes[c] = (uint8_t)(code * 255.0f + 0.5f);
    }
}

bool lsf_image_to_rgb8(const lsf_image *image, float exposure, lsf_tone_curve curve, uint8_t *rgb,
                       lsf_error *error)
{
    if (!lsf_given(image, "image", error) || !lsf_given(rgb, "rgb", error))
        return false;
    const int channels[3] = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                             lsf_image_channel(image, "B")};
    if (channels[0] < 0 || channels[1] < 0 || channels[2] < 0)
        return lsf_error_set(error, LSF_ERROR_FILE, "the image lacks R, G or B");
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height; i++) {
        const float *pixel = image->pixels + i * image->channel_count;
        const float light[3] = {pixel[channels[0]], pixel[channels[1]], pixel[channels[2]]};
        encode_pixel(light, 1.0f, exp2f(exposure), curve, rgb + 3 * i);
    }
    return true;
}

/* `alpha`: one for each pixel, or NULL. */
static bool save_png(const float *rgb, const float *alpha, uint32_t width, uint32_t height,
                     const lsf_image_save_params *params, const char *path, lsf_error *error)
{
    uint64_t count = (uint64_t)width * height;
    uint32_t channels = alpha ? 4 : 3;
    uint8_t *codes = lsf_alloc(count, channels);
    if (!codes)
        return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", shown_path(path));
    float scale = exp2f(params->exposure);
    for (uint64_t i = 0; i < count; i++) {
        float a = alpha ? fminf(fmaxf(alpha[i], 0.0f), 1.0f) : 1.0f; /* NaN becomes 0 */
        encode_pixel(rgb + 3 * i, a, scale, params->curve, codes + channels * i);
        if (alpha)
            codes[channels * i + 3] = (uint8_t)(a * 255.0f + 0.5f);
    }
    lsf_encode_request request = {.file = LSF_IMAGE_FILE_PNG,
                                  .width = width,
                                  .height = height,
                                  .channels = channels,
                                  .texels = codes,
                                  .texts = params->texts,
                                  .text_count = params->text_count};
    bool saved = encode_and_write(&request, path, error);
    free(codes);
    return saved;
}

static const lsf_image_save_params defaults = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};

bool lsf_image_save_rgb8(const uint8_t *rgb, uint32_t width, uint32_t height, const char *path,
                         const lsf_image_save_params *params, lsf_error *error)
{
    if (!lsf_given(rgb, "rgb", error) || !lsf_given(path, "path", error))
        return false;
    if (!params)
        params = &defaults;
    lsf_encode_request request = {.file = LSF_IMAGE_FILE_PNG,
                                  .width = width,
                                  .height = height,
                                  .channels = 3,
                                  .texels = rgb,
                                  .texts = params->texts,
                                  .text_count = params->text_count};
    return check_size(width, height, path, error) && encode_and_write(&request, path, error);
}

static float *pack(const lsf_image *image, const int *channels, uint32_t count, const char *path,
                   lsf_error *error)
{
    uint64_t pixels = (uint64_t)image->width * image->height;
    float *packed = lsf_alloc(pixels, count * sizeof *packed);
    if (!packed) {
        lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory", shown_path(path));
        return NULL;
    }
    for (uint64_t i = 0; i < pixels; i++)
        for (uint32_t c = 0; c < count; c++)
            packed[count * i + c] = image->pixels[i * image->channel_count + (uint32_t)channels[c]];
    return packed;
}

/* R, G, B packed; NULL with an error when one is missing. The caller frees. */
static float *pack_rgb(const lsf_image *image, const char *path, lsf_error *error)
{
    int channels[3] = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                       lsf_image_channel(image, "B")};
    if (channels[0] < 0 || channels[1] < 0 || channels[2] < 0) {
        lsf_error_set(error, LSF_ERROR_FILE,
                      "%s: this format needs the channels R, G and B; write EXR instead",
                      shown_path(path));
        return NULL;
    }
    return pack(image, channels, 3, path, error);
}

static bool save_display(const lsf_image *image, const float *rgb,
                         const lsf_image_save_params *params, const char *path, lsf_error *error)
{
    int channel = lsf_image_channel(image, "A");
    float *alpha = channel >= 0 ? pack(image, &channel, 1, path, error) : NULL;
    bool saved = (alpha || channel < 0) &&
                 save_png(rgb, alpha, image->width, image->height, params, path, error);
    free(alpha);
    return saved;
}

/* The depth of the background is infinite by right. */
static void warn_of_lost_pixels(const lsf_image *image, const char *path)
{
    uint64_t count = (uint64_t)image->width * image->height, lost = 0;
    for (uint64_t i = 0; i < count; i++) {
        bool finite = true;
        for (uint32_t c = 0; c < image->channel_count; c++)
            finite = finite && (isfinite(image->pixels[i * image->channel_count + c]) ||
                                strncmp(image->channel_names[c], "depth.", 6) == 0);
        lost += !finite;
    }
    if (lost > 0)
        lsf_log(LSF_LOG_WARNING, "%s: %llu of %llu pixels are not finite", shown_path(path),
                (unsigned long long)lost, (unsigned long long)count);
}

bool lsf_image_can_save(uint32_t width, uint32_t height, const char *path,
                        const lsf_image_save_params *params, lsf_error *error)
{
    if (!lsf_given(path, "path", error))
        return false;
    lsf_image_format format = params ? params->format : defaults.format;
    return find_format(&format, path, error) && check_size(width, height, path, error) &&
           get_module(path, error) != NULL;
}

bool lsf_image_save(const lsf_image *image, const char *path, const lsf_image_save_params *params,
                    lsf_error *error)
{
    if (!lsf_given(image, "image", error) || !lsf_given(path, "path", error))
        return false;
    if (!params)
        params = &defaults;
    lsf_image_format format = params->format;
    if (!find_format(&format, path, error) || !check_size(image->width, image->height, path, error))
        return false;
    warn_of_lost_pixels(image, path);
    if (format == LSF_IMAGE_FORMAT_EXR) {
        lsf_encode_request request = {
            .file = LSF_IMAGE_FILE_EXR,
            .width = image->width,
            .height = image->height,
            .channels = image->channel_count,
            .names = (const char(*)[LSF_CHANNEL_NAME_SIZE])image->channel_names,
            .texels = image->pixels,
            .texts = params->texts,
            .text_count = params->text_count};
        if (image->channel_count == 0)
            return lsf_error_set(error, LSF_ERROR_FILE, "%s: the image has no channels",
                                 shown_path(path));
        return encode_and_write(&request, path, error);
    }
    float *rgb = pack_rgb(image, path, error);
    if (!rgb)
        return false;
    bool saved = format == LSF_IMAGE_FORMAT_HDR
                     ? save_hdr(rgb, image->width, image->height, path, error)
                     : save_display(image, rgb, params, path, error);
    free(rgb);
    return saved;
}

void lsf_image_save_abort(void)
{
    lsf_atomic_file_abort_all();
}
