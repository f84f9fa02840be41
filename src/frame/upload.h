/* Data of several kilobytes that the host writes anew in each iteration. It is written to mapped
 * memory, of which a part is used again once the GPU has copied it, so that it cannot reach draws
 * of an earlier iteration, whatever a driver does with glNamedBufferSubData (docs/gpu.md). */
#ifndef LSF_FRAME_UPLOAD_H
#define LSF_FRAME_UPLOAD_H

#include "frame/resources.h"

/* Uploads by which the GPU may be behind before the host waits. */
#define LSF_UPLOAD_PARTS 3

typedef struct lsf_upload {
    GLuint staging, buffer; /* `buffer` is what shaders read */
    unsigned char *mapped;
    uint64_t bytes; /* of a part */
    GLsync copied[LSF_UPLOAD_PARTS];
    uint32_t part;
} lsf_upload;

/* Lists both buffers, under a name of the pass. */
void lsf_upload_plan(lsf_plan *plan, const char *name, uint64_t bytes, const char *why);
bool lsf_upload_create(lsf_upload *upload, lsf_context *context, const lsf_plan *plan,
                       const char *name, lsf_error *error);
/* Memory for all of the data, write only, until lsf_upload_end. */
void *lsf_upload_begin(lsf_upload *upload);
/* Commands from here on see the data in `buffer`. */
void lsf_upload_end(lsf_upload *upload);
void lsf_upload_destroy(lsf_upload *upload, lsf_context *context);

#endif
