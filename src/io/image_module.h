/* The C interface of the module lightsheaf-openimageio. OpenImageIO brings hundreds of libraries
 * and a good part of a second of start-up, so it is loaded when the first picture is read or
 * written, never before. */
#ifndef LSF_IO_IMAGE_MODULE_H
#define LSF_IO_IMAGE_MODULE_H

#include "io/image_header.h"
#include <lightsheaf/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_decoded_image {
    uint32_t width, height, channels;
    lsf_texel_type type;
    void *texels;                         /* malloc'ed, rows from the top, tightly packed */
    char (*names)[LSF_CHANNEL_NAME_SIZE]; /* malloc'ed */
} lsf_decoded_image;

/* Pixels ready for a file: PNG takes U8 in R, G, B or R, G, B and
 * alpha, which is not multiplied into them; HDR F32 in R, G, B; EXR F32 in any channels. */
typedef struct lsf_encode_request {
    lsf_image_file file;
    uint32_t width, height, channels;
    const char (*names)[LSF_CHANNEL_NAME_SIZE]; /* EXR only */
    const void *texels;
    const lsf_image_text *texts; /* PNG and EXR only */
    uint32_t text_count;
} lsf_encode_request;

typedef struct lsf_image_module {
    /* `header` was read from these bytes. `name` is for messages. */
    bool (*decode)(lsf_decoded_image *decoded, const lsf_image_header *header, const void *bytes,
                   size_t length, const char *name, lsf_error *error);
    /* A malloc'ed file. */
    bool (*encode)(const lsf_encode_request *request, void **bytes, size_t *length,
                   const char *name, lsf_error *error);
} lsf_image_module;

/* The module lightsheaf-webp: WebP alone, decoded alone. */
typedef struct lsf_webp_module {
    bool (*decode)(lsf_decoded_image *decoded, const lsf_image_header *header, const void *bytes,
                   size_t length, const char *name, lsf_error *error);
} lsf_webp_module;

/* Load the module on the first call; safe from any thread. NULL with LSF_ERROR_FILE when it is
 * not installed. */
const lsf_image_module *lsf_image_module_get(lsf_error *error);
const lsf_webp_module *lsf_webp_module_get(lsf_error *error);

#ifdef __cplusplus
}
#endif
#endif
