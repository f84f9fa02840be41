#include "io/image_header.h"

#include <string.h>

/* The layout is that of ITU-T T.81, annex B: markers of 0xff and a code. Most begin a segment that
 * gives its length; entropy-coded data follow that of a scan. */

enum {
    TEM = 0x01,
    SOF0 = 0xc0,
    SOF2 = 0xc2,
    DHT = 0xc4,
    JPG = 0xc8,
    DAC = 0xcc,
    SOF15 = 0xcf,
    RST0 = 0xd0,
    RST7 = 0xd7,
    EOI = 0xd9,
    SOS = 0xda,
    APP0 = 0xe0,
    APP14 = 0xee,
    APP15 = 0xef,
    COM = 0xfe,
};

/* From a marker's 0xff to the end of its segment. */
typedef struct segment {
    uint32_t marker;
    size_t begin, end;
} segment;

static uint32_t read_u16(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 8 | bytes[1];
}

static bool stands_alone(uint32_t marker)
{
    return marker == TEM || (marker >= RST0 && marker <= RST7);
}

/* The next marker with a segment, or the end of the image, from `at` on. False where the file
 * ends before. It skips entropy-coded data, fill bytes and markers that stand alone, as decoders
 * do, so that decoders find no marker that it does not. */
static bool next_segment(segment *found, const uint8_t *bytes, size_t length, size_t at)
{
    while (at + 2 <= length && (bytes[at] != 0xff || bytes[at + 1] == 0x00 ||
                                bytes[at + 1] == 0xff || stands_alone(bytes[at + 1])))
        at++;
    if (at + 2 > length)
        return false;
    *found = (segment){.marker = bytes[at + 1], .begin = at, .end = at + 2};
    if (found->marker == EOI)
        return true;
    if (length - at < 4 || read_u16(bytes + at + 2) < 2 ||
        read_u16(bytes + at + 2) > length - at - 2)
        return false;
    found->end += read_u16(bytes + at + 2);
    return true;
}

static bool damaged(const char *name, const char *what, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: damaged JPEG file: %s; save or copy it again",
                         name, what);
}

/* `frame` points to the marker. */
static bool read_frame(lsf_image_header *header, const uint8_t *frame, size_t size,
                       const char *name, lsf_error *error)
{
    if (frame[1] > SOF2)
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: JPEG of a rare kind (lossless, hierarchical or "
                             "arithmetic-coded); save it as baseline or progressive",
                             name);
    if (size < 10 || header->channels != 0)
        return damaged(name, "bad frame header", error);
    header->height = read_u16(frame + 5);
    header->width = read_u16(frame + 7);
    header->channels = frame[9];
    if (frame[4] != 8 || (header->channels != 1 && header->channels != 3))
        return lsf_error_set(error, LSF_ERROR_FILE,
                             "%s: JPEG with %u components of %u bits (CMYK or 12 bits); "
                             "save it as 8-bit grey or RGB",
                             name, header->channels, frame[4]);
    return true;
}

/* Decoders keep the coefficients of a picture whose scans hold less than everything: two bytes for
 * each, in whole units of at most 4 x 4 blocks. */
static uint64_t coefficient_bytes(const lsf_image_header *header)
{
    uint64_t width = (header->width + 31u) / 32u * 32u;
    uint64_t height = (header->height + 31u) / 32u * 32u;
    return 2 * width * height * header->channels;
}

bool lsf_jpeg_header_read(lsf_image_header *header, const uint8_t *bytes, size_t length,
                          uint64_t *pixels_max, const char *name, lsf_error *error)
{
    /* Each scan of a progressive file visits all blocks; files that are meant to be seen have
     * about ten. */
    enum { SCANS_MAX = 100 };
    uint32_t scans = 0;
    bool progressive = false;
    segment part;
    for (size_t at = 2; next_segment(&part, bytes, length, at); at = part.end) {
        uint32_t marker = part.marker;
        if (marker == EOI) {
            if (header->channels == 0 || scans == 0)
                return damaged(name, "it holds no picture", error);
            header->type = LSF_TEXEL_U8;
            /* Each 8 x 8 block takes at least a bit of Huffman code. */
            *pixels_max = (uint64_t)length * 8 * 64;
            return true;
        }
        if (marker >= SOF0 && marker <= SOF15 && marker != DHT && marker != JPG && marker != DAC &&
            !read_frame(header, bytes + part.begin, part.end - part.begin, name, error))
            return false;
        progressive |= marker == SOF2;
        if (marker == SOS && part.end - part.begin > 4 &&
            (progressive || bytes[part.begin + 4] != header->channels))
            header->working_bytes = coefficient_bytes(header);
        if (marker == SOS && ++scans > SCANS_MAX)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s: JPEG with more than %d scans; save it as baseline", name,
                                 SCANS_MAX);
    }
    return lsf_error_set(error, LSF_ERROR_FILE,
                         "%s: the JPEG file ends too early or is damaged; save or copy it again",
                         name);
}

/* APP0 (JFIF) and APP14 (Adobe) say how colours are coded. */
static bool is_metadata(uint32_t marker)
{
    return (marker > APP0 && marker <= APP15 && marker != APP14) || marker == COM;
}

size_t lsf_jpeg_without_metadata(uint8_t *bytes, size_t length)
{
    size_t kept = 2;
    segment part;
    for (size_t at = 2; next_segment(&part, bytes, length, at); at = part.end) {
        bool keep = !is_metadata(part.marker);
        size_t end = keep ? part.end : part.begin;
        /* A fill byte before a segment that is removed would form a marker with the bytes that
         * follow. */
        while (!keep && end > at && bytes[end - 1] == 0xff)
            end--;
        memmove(bytes + kept, bytes + at, end - at);
        kept += end - at;
        if (part.marker == EOI)
            break;
    }
    return kept;
}
