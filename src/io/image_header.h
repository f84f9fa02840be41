/* What an image file says about itself, read by our own bounds-checked parsers: nothing that a
 * decoding library allocates is sized by numbers that were not checked here first. */
#ifndef LSF_IO_IMAGE_HEADER_H
#define LSF_IO_IMAGE_HEADER_H

#include "base/base.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lsf_image_file {
    LSF_IMAGE_FILE_PNG,
    LSF_IMAGE_FILE_JPEG,
    LSF_IMAGE_FILE_HDR,
    LSF_IMAGE_FILE_EXR,
    LSF_IMAGE_FILE_WEBP,
} lsf_image_file;

typedef struct lsf_image_header {
    lsf_image_file file;
    uint32_t width, height;
    uint32_t channels;      /* once decoded: palettes and colour keys count as RGB and alpha */
    lsf_texel_type type;    /* once decoded: half is F32 */
    uint64_t working_bytes; /* what decoding takes beside the pixels and a copy of the file */
} lsf_image_header;

/* Recognises the file by its magic bytes and checks it: known features only, a size within
 * LSF_IMAGE_MAX_SIZE and LSF_IMAGE_MAX_BYTES, no more memory for decoding it than `byte_limit`, no
 * more pixels than so many bytes can hold, not cut short as far as the container tells. `name` is
 * for messages. */
bool lsf_image_header_read(lsf_image_header *header, const void *bytes, size_t length,
                           uint64_t byte_limit, const char *name, lsf_error *error);

/* The parts of lsf_image_header_read for one kind of file. `pixels_max` is the largest number of
 * pixels that a file of this compression and length can hold. */
bool lsf_png_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                         uint64_t *pixels_max, const char *name, lsf_error *error);
bool lsf_jpeg_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                          uint64_t *pixels_max, const char *name, lsf_error *error);
bool lsf_exr_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                         uint64_t *pixels_max, const char *name, lsf_error *error);
bool lsf_webp_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                          uint64_t *pixels_max, const char *name, lsf_error *error);

/* A text in a file that lsf_image_header_read let pass: an EXR's attribute of type string, a PNG's
 * tEXt. The key ends with a NUL, the value after `length` bytes. */
typedef struct lsf_header_text {
    const char *key, *value;
    size_t length;
} lsf_header_text;

/* The next one from *at on, which is 0 at first; false when there is none any more. */
bool lsf_png_next_text(const uint8_t *bytes, size_t length, size_t *at, lsf_header_text *text);
bool lsf_exr_next_text(const uint8_t *bytes, size_t *at, lsf_header_text *text);

/* The name of the next channel, likewise; there are as many as the header says. */
const char *lsf_exr_next_channel(const uint8_t *bytes, size_t *at);

/* Takes out of a file that lsf_image_header_read accepted what no pixel needs: comments,
 * thumbnails, Exif, IPTC, XMP, colour profiles. Decoding libraries parse these with less care
 * than pixels. Returns the length that is left. */
size_t lsf_png_without_metadata(uint8_t *bytes, size_t length);
size_t lsf_jpeg_without_metadata(uint8_t *bytes, size_t length);
size_t lsf_webp_without_metadata(uint8_t *bytes, size_t length);

#ifdef __cplusplus
}
#endif
#endif
