/* Structural similarity: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error
 * visibility to structural similarity", IEEE TIP 13(4), 2004; 11 x 11 Gaussian window of standard
 * deviation 1.5, K1 = 0.01, K2 = 0.03, dynamic range 1. */
#ifndef LSF_MEASURE_SSIM_H
#define LSF_MEASURE_SSIM_H

#include "base/base.h"

/* Mean over the compared pixels (`compared[i]` nonzero) whose window lies within the picture; in
 * a picture smaller than the window, over all of them. Pixels that are not compared weigh nothing
 * in the windows of their neighbours. NAN when memory is short or no pixel is left. */
double lsf_ssim(const float *x, const float *y, const uint8_t *compared, uint32_t width,
                uint32_t height);

#endif
