/* Measuring a picture against a reference. */
#ifndef LIGHTSHEAF_COMPARE_H
#define LIGHTSHEAF_COMPARE_H

#include <lightsheaf/error.h>
#include <lightsheaf/image.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

typedef struct lsf_compare_params {
    /* Second independent half of the reference: squared errors become mean((x - a)(x - b)), free of
     * the reference's noise; NULL: none. */
    const lsf_image *reference_b;
    const lsf_image *mask; /* pixels whose first channel is > 0.5 are left out; NULL: none */
    float relmse_epsilon;  /* added to the squared reference; NAN: 0.01 * mean(reference)^2 */
    float exposure;        /* EV before tone mapping, for SSIM, PSNR and FLIP */
    lsf_tone_curve curve;  /* likewise; LSF_TONE_CURVE_NONE for pictures made for display */
    bool flip; /* FLIP and HDR-FLIP, too: about 70 ms for each exposure of 512 x 512 pixels */
} lsf_compare_params;

#define LSF_COMPARE_PARAMS_DEFAULTS                                                                \
    .reference_b = NULL, .mask = NULL, .relmse_epsilon = 0.0f / 0.0f, .exposure = 0.0f,            \
    .curve = LSF_TONE_CURVE_NEUTRAL, .flip = false

typedef struct lsf_compare_result {
    uint64_t pixels;                                /* compared */
    uint64_t non_finite_test, non_finite_reference; /* pixels with a NaN or Inf, left out */
    double mean_test[3], mean_reference[3];         /* R, G, B */
    double bias[3];                                 /* mean(x - r) / mean(r) per channel */
    double rmse;                                    /* over linear R, G, B together */
    double rmse_relative;                           /* rmse / mean(r) over all channels */
    double relmse;                                  /* mean((x - r)^2 / (r^2 + epsilon)) */
    double relmse_epsilon;                          /* the epsilon that was used */
    double ssim;     /* of tone-mapped luminance, 11 x 11 Gaussian window, sigma 1.5 */
    double psnr;     /* dB, of tone-mapped R, G, B */
    double flip;     /* mean over pixels, of tone-mapped R, G, B; NAN when not asked for */
    double flip_hdr; /* mean over pixels, of radiance over all exposures; NAN likewise */
    float flip_start, flip_stop; /* EV, the outermost exposures of flip_hdr */
    uint32_t flip_exposures;     /* their count */
    bool noise_corrected;        /* reference_b was given */
} lsf_compare_result;

/* Both images need R, G, B and the same size; otherwise LSF_ERROR_FILE. Against two halves, rmse
 * is free of their noise, and relmse nearly so (it divides by the halves' mean, and may be
 * negative); means, bias, SSIM, PSNR and FLIP are against the halves' mean. When no finite pixel
 * is left the measures are NAN. */
bool lsf_compare(const lsf_image *test, const lsf_image *reference,
                 const lsf_compare_params *params, lsf_compare_result *result, lsf_error *error);

/* The absolute difference as a picture: R, G, B = |x - r| * gain. The caller destroys it. */
lsf_image *lsf_compare_difference(const lsf_image *test, const lsf_image *reference, float gain,
                                  lsf_error *error);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
