/* Where a picture goes: decided and checked before anything is rendered. */
#ifndef LSF_TOOLS_OUTPUT_H
#define LSF_TOOLS_OUTPUT_H

#include "tools/imprint.h"
#include "tools/options.h"

typedef struct lsf_destination {
    char *output;            /* the path, of a sequence with a place for the frame's number */
    char *path;              /* "-": standard output; of a sequence that of the frame in turn */
    lsf_image_format format; /* never AUTO */
    char *half_paths[2];     /* --halves: OUT_a and OUT_b; else NULL */
    float exposure;          /* EV; NAN: chosen by lsf_destination_expose, or none is used */
    lsf_tone_curve curve;
} lsf_destination;

/* One for each scene of the command line, of which there are `count`. Checks that pictures and JSON
 * can be written where the settings want them. NULL: LSF_ERROR_USAGE or LSF_ERROR_FILE. */
lsf_destination *lsf_destinations_create(const lsf_settings *settings, uint32_t count,
                                         lsf_error *error);
/* Goes over to a frame of a sequence; the exposure is to be chosen again. */
bool lsf_destination_go_to(lsf_destination *destination, const lsf_settings *settings,
                           uint32_t frame, lsf_error *error);
void lsf_destinations_destroy(lsf_destination *destinations, uint32_t count); /* NULL allowed */

/* Where --exposure auto asks for it, chooses the exposure that suits the picture, and says which.
 */
void lsf_destination_expose(lsf_destination *destination, const lsf_image *image);

/* Numbers of pixels in which surfaces are visible. */
typedef struct lsf_brightness {
    uint64_t pixels;
    uint64_t seen;  /* of these, with more than 1 % of white in a channel */
    uint64_t white; /* of these, with so much light in all channels that they look white */
} lsf_brightness;

/* Warns of pictures that look as if something had gone wrong: fewer than one in a hundred pixels
 * are seen, or more than half of these are white, which an exposure mends. */
void lsf_destination_warn(const lsf_destination *destination, const lsf_brightness *brightness);

/* `half` -1: the picture itself, of whose brightness it may warn; 0 and 1: its halves. */
bool lsf_destination_save(const lsf_destination *destination, int half, const lsf_image *image,
                          const lsf_imprint *imprint, lsf_error *error);

#endif
