/* Convolution with small kernels, along rows and along columns; beyond a picture's border its
 * outermost pixel goes on. */
#ifndef LSF_MEASURE_CONVOLVE_H
#define LSF_MEASURE_CONVOLVE_H

#include "base/base.h"

enum { LSF_KERNEL_RADIUS = 16 };

typedef struct lsf_kernel {
    int radius;    /* at most LSF_KERNEL_RADIUS */
    bool balanced; /* the weights sum to zero: what is even comes to zero, to the last bit */
    float weights[2 * LSF_KERNEL_RADIUS + 1];
} lsf_kernel;

typedef struct lsf_plane_size {
    uint32_t width, height;
} lsf_plane_size;

/* `out` and `in` are different planes; `padded` is a row of width + 2 * LSF_KERNEL_RADIUS. */
void lsf_convolve_rows(lsf_plane_size size, const lsf_kernel *kernel, const float *in, float *out,
                       float *padded);

/* What it finds is added to `out` when `add` is set. */
void lsf_convolve_columns(lsf_plane_size size, const lsf_kernel *kernel, const float *in,
                          float *out, bool add);

#endif
