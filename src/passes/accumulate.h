/* Running means over iterations, one for each layer of the result. See accumulate.md. */
#ifndef LSF_PASSES_ACCUMULATE_H
#define LSF_PASSES_ACCUMULATE_H

#include "frame/iteration.h"
#include "scene/layer.h"

typedef enum lsf_accumulate_source {
    LSF_ACCUMULATE_COLOR,  /* any float texture as it is */
    LSF_ACCUMULATE_ALBEDO, /* base colour of the G-buffer's surface */
    LSF_ACCUMULATE_NORMAL, /* its shading normal */
    LSF_ACCUMULATE_DEPTH,  /* of the first iteration, in scene units */
    LSF_ACCUMULATE_SOURCES,
} lsf_accumulate_source;

typedef struct lsf_accumulate {
    lsf_context *context;
    uint32_t layer_count;
    lsf_accumulate_source sources[LSF_LAYER_COUNT];
    GLuint means[LSF_LAYER_COUNT]; /* outputs: RGBA32F */
    GLuint programs[LSF_ACCUMULATE_SOURCES];
    GLuint framebuffer; /* without attachments */
    lsf_timer *timer;
} lsf_accumulate;

/* Lists the pass and a mean for each of the names: "picture", "albedo", "depth", ... */
void lsf_accumulate_plan(lsf_plan *plan, uint32_t layer_count, const char *const *layer_names);
bool lsf_accumulate_create(lsf_accumulate *pass, lsf_context *context, const lsf_plan *plan,
                           uint32_t layer_count, const char *const *layer_names, lsf_error *error);
/* Adds one texture a layer to the means (0: nothing); `depth` is the G-buffer's. `gate`, unless 0,
 * begins with a DrawArraysIndirectCommand of 3 vertices, or of none when nothing is to be added. */
void lsf_accumulate_run(lsf_accumulate *pass, const lsf_iteration *iteration,
                        const GLuint *textures, GLuint depth, GLuint gate);
void lsf_accumulate_destroy(lsf_accumulate *pass);

#endif
