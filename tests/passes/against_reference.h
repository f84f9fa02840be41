/* GL pictures against the path tracer's, each as two independent halves, so that errors can be told
 * from the noise of either. */
#ifndef LSF_TESTS_PASSES_AGAINST_REFERENCE_H
#define LSF_TESTS_PASSES_AGAINST_REFERENCE_H

#include "render_gl.h"

typedef struct against_reference {
    lsf_image *gl[2];        /* of different seeds */
    lsf_image *reference[2]; /* both halves */
} against_reference;

/* Renders `scene` by the technique and the bounces that `params` ask for and by the path tracer,
 * with the picture, albedo and normal. `params->samples` is that of each half; a quarter of it
 * under LSF_TEST_QUICK. With LSF_TEST_PICTURES set, `name`.gl.png, .reference.png and
 * .difference.png (times 10) go into that folder. */
against_reference against_reference_render(const char *name, const lsf_scene *scene,
                                           const lsf_render_params *params);
void against_reference_destroy(against_reference *pictures);

/* Asserts on the three channels that begin with `channel`: the means agree within
 * `bias_allowed` of the mean, and the root of the mean squared error, both noises taken out, is at
 * most `error_allowed` of it; both but for
 * what few samples leave uncertain. Pixels with a
 * value above `limit`, and those beside them, are left out: a highlight narrower than any pixel's
 * samples is noise alone. */
void against_reference_check(const char *name, const against_reference *pictures,
                             const char *channel, double limit, double bias_allowed,
                             double error_allowed);

#endif
