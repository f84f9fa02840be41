/* Images: float pixels with named channels, and image files. */
#ifndef LIGHTSHEAF_IMAGE_H
#define LIGHTSHEAF_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

#define LSF_CHANNEL_NAME_SIZE 64

/* Linear Rec.709 radiance [W/(m^2 sr)] in R, G, B; further layers are named as OpenEXR does:
 * "albedo.R", "normal.X", "depth.Z". A channel A is the share of the pixel that surfaces cover;
 * R, G and B are multiplied by it. Rows run from the top; channels are interleaved:
 * pixels[(y * width + x) * channel_count + c]. */
typedef struct lsf_image {
    uint32_t width, height;
    uint32_t channel_count;
    char (*channel_names)[LSF_CHANNEL_NAME_SIZE];
    float *pixels;
} lsf_image;

/* Makes a zeroed image. `channel_names` has `channel_count` entries. NULL on overflow or lack of
 * memory. The caller destroys it. */
lsf_image *lsf_image_create(uint32_t width, uint32_t height, uint32_t channel_count,
                            const char *const *channel_names, lsf_error *error);
void lsf_image_destroy(lsf_image *image); /* NULL allowed */

/* Index of the named channel, or -1. */
int lsf_image_channel(const lsf_image *image, const char *name);

/* Reads PNG, JPEG, WebP, HDR or EXR, recognised by magic bytes and validated before anything is
 * allocated. 8- and 16-bit files are decoded from sRGB to linear, and grey ones get equal R, G
 * and B; alpha is not converted. All channels of an EXR are kept. LSF_ERROR_FILE on failure. */
lsf_image *lsf_image_load(const char *path, lsf_error *error);

typedef enum lsf_image_format {
    LSF_IMAGE_FORMAT_AUTO, /* by the path's extension */
    LSF_IMAGE_FORMAT_EXR,  /* float32, all channels, lossless */
    LSF_IMAGE_FORMAT_HDR,  /* R, G, B as RGBE */
    LSF_IMAGE_FORMAT_PNG,  /* R, G, B tone-mapped to 8-bit sRGB, see tonemap.h; with a channel A
                            * also alpha, not premultiplied */
} lsf_image_format;

/* Curves from exposed radiance to display values; tonemap.h has the formulas. */
typedef enum lsf_tone_curve {
    LSF_TONE_CURVE_NEUTRAL, /* Khronos PBR Neutral: keeps base colours, compresses highlights */
    LSF_TONE_CURVE_NONE,    /* sRGB, cut off at 1 */
    LSF_TONE_CURVE_ACES,    /* film-like, with contrast: ACES for sRGB */
    LSF_TONE_CURVE_AGX,     /* film-like, bright colours fade to white */
} lsf_tone_curve;

/* Metadata of a picture file: an EXR's attribute of type string, a PNG's tEXt. */
typedef struct lsf_image_text {
    const char *key, *value;
} lsf_image_text;

typedef struct lsf_image_save_params {
    lsf_image_format format;
    float exposure; /* EV: radiance is multiplied by 2^exposure before tone mapping; PNG only */
    lsf_tone_curve curve;        /* PNG only */
    const lsf_image_text *texts; /* EXR and PNG only */
    uint32_t text_count;
} lsf_image_save_params;

#define LSF_IMAGE_SAVE_PARAMS_DEFAULTS                                                             \
    .format = LSF_IMAGE_FORMAT_AUTO, .exposure = 0.0f, .curve = LSF_TONE_CURVE_NEUTRAL,            \
    .texts = NULL, .text_count = 0

/* The exposure [EV] that brings the log-average luminance of R, G and B to middle grey, 0.18
 * (Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002). Pixels are
 * weighted by their channel A, if there is one. Black pixels, which no exposure changes, do not
 * count. Luminance that would be displayed as black if the others' arithmetic mean were middle grey
 * counts as the darkest that is not. 0 for a black picture. */
float lsf_image_auto_exposure(const lsf_image *image);

/* Writes to a temporary file and renames it, so that a failure or an interrupt neither leaves a
 * torn file nor damages an existing one. Path "-" is standard output (format must be given; AUTO
 * means EXR). `params` NULL means the defaults. */
bool lsf_image_save(const lsf_image *image, const char *path, const lsf_image_save_params *params,
                    lsf_error *error);

/* Whether a picture of this size could be saved there: checks format and size, and loads the
 * module that writes it. Call this before a long rendering. */
bool lsf_image_can_save(uint32_t width, uint32_t height, const char *path,
                        const lsf_image_save_params *params, lsf_error *error);

/* Writes 8-bit sRGB pixels as PNG: `width` * `height` * 3 bytes, rows from the top, as from
 * lsf_renderer_read_rgb8. Of `params` only the texts are used; NULL means none. Written to a
 * temporary file and renamed; path "-" is standard output. */
bool lsf_image_save_rgb8(const uint8_t *rgb, uint32_t width, uint32_t height, const char *path,
                         const lsf_image_save_params *params, lsf_error *error);

/* R, G, B of the image as its .png shows them: `width` * `height` * 3 bytes of sRGB, rows from
 * the top. LSF_ERROR_FILE where it has no R, G and B. */
bool lsf_image_to_rgb8(const lsf_image *image, float exposure, lsf_tone_curve curve, uint8_t *rgb,
                       lsf_error *error);

/* Whether the file exists and begins like a picture that lsf_image_load reads. */
bool lsf_image_recognise(const char *path);

/* Describes the file's header: format, size, channels and texts; as text or JSON. The pixels are
 * not decoded. malloc'ed; NULL with LSF_ERROR_FILE. */
char *lsf_image_describe(const char *path, bool json, lsf_error *error);

/* Removes the temporary file that lsf_image_save is writing at this moment, in any thread.
 * Async-signal-safe: for the handler of a signal that ends the process. */
void lsf_image_save_abort(void);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
