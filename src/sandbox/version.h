/* A sandbox's shader as it was read once: its text, programs and channels, and the parts of the
 * engine that it names. */
#ifndef LSF_SANDBOX_VERSION_H
#define LSF_SANDBOX_VERSION_H

#include "sandbox/channel.h"
#include "sandbox/engine.h"

typedef struct lsf_sandbox_stage {
    lsf_sandbox_setup setup;
    lsf_sandbox_engine engine;
} lsf_sandbox_stage;

typedef struct lsf_sandbox_pass {
    GLuint program;                     /* 0: there is no such pass */
    GLint locations[LSF_SANDBOX_NAMES]; /* of the table's uniforms; -1: it has none */
    lsf_sandbox_channel channels[LSF_SANDBOX_CHANNELS];
    GLint groups[3]; /* invocations of a work group */
} lsf_sandbox_pass;

typedef struct lsf_sandbox_version {
    lsf_sandbox_text text;
    lsf_sandbox_stage *stage; /* NULL: another version has taken it over */
    lsf_sandbox_pass passes[LSF_SANDBOX_PASSES];
} lsf_sandbox_version;

/* The channels of all passes, by the text and by the caller; notes which pass feeds back. */
bool lsf_sandbox_channels_parse(lsf_sandbox_text *text, const lsf_sandbox_params *params,
                                lsf_sandbox_channel channels[][LSF_SANDBOX_CHANNELS],
                                lsf_error *error);

/* Reads and compiles, and makes what is named; `before` (NULL: none) lends what has not changed.
 * On failure the files that were read are left in `version->text`. */
bool lsf_sandbox_version_make(lsf_sandbox_version *version, lsf_context *context,
                              const lsf_scene *scene, const lsf_sandbox_params *params,
                              lsf_sandbox_version *before, lsf_error *error);
/* Takes over what `before` has lent. */
void lsf_sandbox_version_keep(lsf_sandbox_version *version, lsf_sandbox_version *before);
void lsf_sandbox_version_finish(lsf_sandbox_version *version, lsf_context *context);

/* The program of a pass. 0 on failure: LSF_ERROR_RENDER. */
bool lsf_sandbox_pass_build(lsf_sandbox_pass *pass, lsf_context *context,
                            const lsf_sandbox_text *text, uint32_t index, const lsf_plan *plan,
                            lsf_error *error);

#endif
