/* The reference of a measurement: two independent halves that are stored in a file and extended
 * on demand. */
#ifndef LSF_SWEEP_REFERENCE_H
#define LSF_SWEEP_REFERENCE_H

#include <lightsheaf/reference.h>

typedef struct lsf_kept_reference {
    uint32_t width, height;
    uint32_t rounds;      /* of tracing, each with its own seed */
    uint64_t samples[2];  /* a pixel, of each half */
    double seconds;       /* spent on tracing them */
    bool traced;          /* some samples were traced since it was loaded */
    lsf_image *halves[2]; /* R, G, B; NULL: not traced yet */
} lsf_kept_reference;

void lsf_kept_reference_finish(lsf_kept_reference *kept);

/* Traces the same number of samples for each half and merges them into the means. `params` give
 * the view; their samples and seed are ignored. Nothing changes unless both halves were
 * finished. */
bool lsf_kept_reference_trace(lsf_kept_reference *kept, const lsf_scene *scene,
                              const lsf_render_params *params, uint32_t samples, lsf_error *error);

/* Reads a file that lsf_kept_reference_save wrote. LSF_ERROR_FILE when it has another size or is
 * damaged; `kept` is then unchanged. */
bool lsf_kept_reference_load(lsf_kept_reference *kept, const char *path, lsf_error *error);
bool lsf_kept_reference_save(const lsf_kept_reference *kept, const char *path, lsf_error *error);

/* 32 hexadecimal digits of all that a reference depends on: the scene's content hash, the
 * options that select parts of the scene, the view, and the version of the library. False when
 * memory is exhausted. */
bool lsf_reference_key(const char *content_hash, const lsf_scene_params *scene,
                       const lsf_render_params *params, uint32_t bounces, char key[33]);

#endif
