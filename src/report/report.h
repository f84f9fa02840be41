/* The report of `lightsheaf measure`: one HTML file that needs nothing else. */
#ifndef LSF_REPORT_REPORT_H
#define LSF_REPORT_REPORT_H

#include "base/base.h"

typedef struct lsf_report_picture {
    char id[32];      /* "reference", "point-0" */
    const char *path; /* of a file that lsf_image_load reads */
} lsf_report_picture;

/* What pictures may take of the file; those that come after are left out. */
#define LSF_REPORT_PICTURE_BYTES ((size_t)48 << 20)

/* Writes the page with a JSON text and pictures, the more important ones first. "-" is standard
 * output. */
bool lsf_report_write(const char *path, const char *json, const lsf_report_picture *pictures,
                      uint32_t count, lsf_error *error);

#endif
