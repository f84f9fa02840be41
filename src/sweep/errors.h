/* Squared errors of several pictures of a point, against two halves of a reference. */
#ifndef LSF_SWEEP_ERRORS_H
#define LSF_SWEEP_ERRORS_H

#include <lightsheaf/image.h>

#include "sweep/measurement.h"

/* The reference of the errors. Three floats a pixel. */
typedef struct lsf_reference_halves {
    uint32_t width, height;
    const float *halves[2];
    double epsilon; /* of relMSE: 0.01 of the squared mean */
    double mean[3];
    double rmse; /* standard deviation of the halves' mean */
} lsf_reference_halves;

/* Computes epsilon, mean and rmse. */
void lsf_reference_halves_derive(lsf_reference_halves *reference);

/* Fills in the products of both errors, and their deviation due to the reference. `pictures`
 * have R, G, B as their first channels. Pixels that are not finite in a picture or a half are
 * left out everywhere. */
void lsf_errors_measure(const lsf_reference_halves *reference, const lsf_image *const *pictures,
                        uint32_t count, lsf_squared_error *mse, lsf_squared_error *relmse);

#endif
