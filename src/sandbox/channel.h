/* The texture that a pass reads as iChannel0 to 3. */
#ifndef LSF_SANDBOX_CHANNEL_H
#define LSF_SANDBOX_CHANNEL_H

#include "sandbox/text.h"

typedef enum lsf_sandbox_source {
    LSF_SOURCE_NONE, /* black */
    LSF_SOURCE_BUFFER,
    LSF_SOURCE_PREVIOUS,
    LSF_SOURCE_KEYBOARD,
    LSF_SOURCE_NOISE,
    LSF_SOURCE_FILE,
    LSF_SOURCE_CUBE,
} lsf_sandbox_source;

typedef struct lsf_sandbox_channel {
    lsf_sandbox_source source;
    uint32_t buffer; /* 0 to 3 */
    GLenum wrap, filter, shrink;
    bool mipmap, flip;
    char *path;              /* a file's path; NULL: it is no file */
    lsf_sandbox_stamp stamp; /* of the file */
    GLuint texture;          /* owned, for noise, files and cubes */
    uint32_t width, height;
    struct lsf_sandbox_channel *from; /* the channel that the texture is borrowed from */
    bool lent;
} lsf_sandbox_channel;

/* Reads the channel's description, with paths relative to `folder`. The message of
 * LSF_ERROR_USAGE begins with `location`. */
bool lsf_sandbox_channel_parse(lsf_sandbox_channel *channel, const char *source, const char *folder,
                               const char *location, lsf_error *error);
/* Makes its texture; borrows that of a channel in `before` with the same description. */
bool lsf_sandbox_channel_load(lsf_sandbox_channel *channel, lsf_context *context,
                              lsf_sandbox_channel *before, uint32_t before_count,
                              const char *location, lsf_error *error);
/* Takes over the ownership of a borrowed texture. */
void lsf_sandbox_channel_keep(lsf_sandbox_channel *channel);
void lsf_sandbox_channel_finish(lsf_sandbox_channel *channel, lsf_context *context);
/* Sets wrapping and filtering of a texture that it reads. */
void lsf_sandbox_channel_set_filter(const lsf_sandbox_channel *channel, GLuint texture);

#endif
