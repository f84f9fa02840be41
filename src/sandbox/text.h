/* The text of a sandbox's shader: its files, their passes, and what these name. It makes no call of
 * OpenGL. */
#ifndef LSF_SANDBOX_TEXT_H
#define LSF_SANDBOX_TEXT_H

#include "gl/gl.h"
#include "sandbox/names.h"

/* Passes, in the order in which a frame runs them. */
enum {
    LSF_SANDBOX_BUFFER_A,
    LSF_SANDBOX_IMAGE = 4,
    LSF_SANDBOX_PASSES,
};

#define LSF_SANDBOX_CHANNELS 4
#define LSF_SANDBOX_NAMES 96 /* at least as many as the table has */

typedef struct lsf_sandbox_location {
    char *path; /* NULL: nowhere */
    uint32_t line;
} lsf_sandbox_location;

/* The description of a channel, as it was written. */
typedef struct lsf_sandbox_channel_text {
    char *source; /* "wood.png wrap=clamp"; NULL: there is none */
    lsf_sandbox_location location;
} lsf_sandbox_channel_text;

typedef struct lsf_sandbox_pass_text {
    lsf_shader_part part; /* its text and the strings that it points to are owned; text NULL:
                           * there is none */
    bool compute;
    bool main_image; /* it has mainImage, and main is to be made for it */
    bool main;
    bool mentions[LSF_SANDBOX_NAMES];                  /* which rows of the table it names */
    bool declares[LSF_SANDBOX_NAMES];                  /* ... and declares itself */
    lsf_sandbox_location locations[LSF_SANDBOX_NAMES]; /* where it names them first; also those in
                                                        * the common part */
    uint32_t needs;
    lsf_sandbox_channel_text channels[LSF_SANDBOX_CHANNELS];
    bool feeds_back; /* some pass reads its own picture of a frame before */
} lsf_sandbox_pass_text;

/* A uniform that the shader declares itself. */
typedef struct lsf_sandbox_own {
    char *name;
    bool slider; /* it has a range */
    float minimum, maximum;
} lsf_sandbox_own;

/* Tells one file from another of its name: time of change, inode, length. */
typedef struct lsf_sandbox_stamp {
    int64_t seconds, nanoseconds, number, bytes; /* all -1: there is none */
} lsf_sandbox_stamp;

lsf_sandbox_stamp lsf_sandbox_stamp_of(const char *path); /* NULL: of none */

/* A file that was read, and its stamp at that time. */
typedef struct lsf_sandbox_file {
    char *path;
    lsf_sandbox_stamp stamp;
} lsf_sandbox_file;

typedef struct lsf_sandbox_text {
    char *folder;
    lsf_shader_part common; /* as a pass's */
    lsf_sandbox_pass_text passes[LSF_SANDBOX_PASSES];
    uint32_t needs; /* of all passes */
    bool radiance, jitter, bundle_given;
    bool keyboard; /* some channel reads it */
    uint32_t light;
    float bundle[3];
    lsf_sandbox_location light_location;
    char **defines; /* "pass.key=value" */
    uint64_t define_count, define_capacity;
    lsf_sandbox_own *uniforms;
    uint64_t uniform_count, uniform_capacity;
    lsf_sandbox_file *files;
    uint64_t file_count, file_capacity;
} lsf_sandbox_text;

/* Reads the shader and what lies beside it. Of a text that cannot be used LSF_ERROR_RENDER or
 * LSF_ERROR_FILE names path and line, and what was read so far has to be finished as well: its
 * files tell when to try again. */
bool lsf_sandbox_text_read(lsf_sandbox_text *text, const char *shader_dir, const char *path,
                           const char *content, lsf_error *error);
void lsf_sandbox_text_finish(lsf_sandbox_text *text);

/* Whether one of the files has changed since it was read. */
bool lsf_sandbox_text_changed(const lsf_sandbox_text *text);
/* Notes another file that the result depends on. */
bool lsf_sandbox_text_watch(lsf_sandbox_text *text, const char *path);

/* "a" to "d", "image". */
const char *lsf_sandbox_pass_name(uint32_t pass);

#endif
