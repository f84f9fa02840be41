/* The reference of a measurement: two independent halves that are kept in a file, and grow. */
#ifndef LSF_SWEEP_REFERENCE_H
#define LSF_SWEEP_REFERENCE_H

#include <lightsheaf/reference.h>

typedef struct lsf_kept_reference {
    uint32_t width, height;
    uint32_t rounds;      /* of tracing, each with a seed of its own */
    uint64_t samples[2];  /* a pixel, of each half */
    double seconds;       /* that tracing them took */
    bool traced;          /* something was, since it was loaded */
    lsf_image *halves[2]; /* R, G, B; NULL: nothing was traced yet */
} lsf_kept_reference;

void lsf_kept_reference_finish(lsf_kept_reference *kept);

/* Traces as many samples of each half and takes them into the means. `params` decide on the view;
 * their samples and seed are not looked at. Nothing changes unless both halves were finished. */
bool lsf_kept_reference_trace(lsf_kept_reference *kept, const lsf_scene *scene,
                              const lsf_render_params *params, uint32_t samples, lsf_error *error);

/* Reads a file that lsf_kept_reference_save wrote. LSF_ERROR_FILE when it is of another size or
 * damaged; `kept` is then as before. */
bool lsf_kept_reference_load(lsf_kept_reference *kept, const char *path, lsf_error *error);
bool lsf_kept_reference_save(const lsf_kept_reference *kept, const char *path, lsf_error *error);

/* 32 hexadecimal digits of all that a reference depends on: the scene's content hash, what was
 * chosen of the scene, the view, and the version of the library. False without memory. */
bool lsf_reference_key(const char *content_hash, const lsf_scene_params *scene,
                       const lsf_render_params *params, uint32_t bounces, char key[33]);

#endif
