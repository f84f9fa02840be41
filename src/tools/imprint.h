/* The description of a picture in its header: how it was made, and how to make it again. */
#ifndef LSF_TOOLS_IMPRINT_H
#define LSF_TOOLS_IMPRINT_H

#include "base/base.h"
#include "tools/options.h"

/* Adds a space and the word, within single quotes where a shell would take it for more than one. */
void lsf_imprint_add_word(lsf_string *text, const char *word);

/* Adds an option as one would type it, to be read by a shell; nothing where it leaves the picture
 * as it is. `value` NULL: none. */
void lsf_imprint_add_option(lsf_string *options, const lsf_command_option *option,
                            const char *value);

typedef struct lsf_imprint {
    lsf_image_text texts[8];
    uint32_t text_count;
    char *command; /* the shell command without its --output */
    char seed[24], bounces[16], samples[16];
} lsf_imprint;

/* `weights`: file of the denoiser's; NULL: none. Finish it either way. */
bool lsf_imprint_make(lsf_imprint *imprint, const lsf_settings *settings, const char *scene_path,
                      const char *technique, uint32_t bounces, uint32_t samples,
                      const char *weights, lsf_error *error);
void lsf_imprint_finish(lsf_imprint *imprint);

#endif
