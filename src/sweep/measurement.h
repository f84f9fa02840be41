/* The results of `lightsheaf measure`: pictures of several configurations, sample counts and
 * seeds, each with its time, memory and error, and the values derived from them. */
#ifndef LSF_SWEEP_MEASUREMENT_H
#define LSF_SWEEP_MEASUREMENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { LSF_SWEEP_MAX_SEEDS = 32, LSF_SWEEP_MAX_OPTIONS = 16, LSF_SWEEP_MAX_PASSES = 64 };

/* Clock of milliseconds: wall clock, GPU timestamps, or CPU time of this process on all cores,
 * which other programs disturb less. */
typedef enum lsf_clock { LSF_CLOCK_WALL, LSF_CLOCK_GPU, LSF_CLOCK_PROCESSOR } lsf_clock;

const char *lsf_clock_name(lsf_clock clock); /* "wall" */

/* With its 95 % confidence interval. NAN: unknown. */
typedef struct lsf_estimate {
    double value, low, high;
} lsf_estimate;

typedef struct lsf_quartiles {
    double lower, median, upper;
} lsf_quartiles;

/* Squared errors of a picture x against two independent halves a and b of a reference, as means
 * over pixels and channels with a weight each: 1 for MSE, 1 / (r^2 + epsilon) for relMSE. Seeds
 * s and t of a point give products[s][t] = mean(w (x_s - a)(x_t - b)), made symmetric: the
 * squared error of a seed on the diagonal, and off it the squared bias, because both noises
 * cancel there. */
typedef struct lsf_squared_error {
    double products[LSF_SWEEP_MAX_SEEDS][LSF_SWEEP_MAX_SEEDS];
    double reference_deviation; /* standard deviation of all of them due to the reference's noise */
    /* What follows. */
    lsf_estimate error; /* over seeds */
    lsf_estimate squared_bias;
    double variance; /* mean over pixels of the variance over seeds: error less squared bias */
} lsf_squared_error;

/* One picture of a point. */
typedef struct lsf_measured_seed {
    uint64_t seed;
    double milliseconds; /* of a frame, from its beginning to its finished picture */
    double bias[3];      /* mean(x - r) / mean(r), R, G, B */
    double ssim, psnr, flip, flip_hdr;
    uint64_t non_finite; /* pixels, left out of all figures */
} lsf_measured_seed;

/* Consecutive frames, of a moving camera and of one that stands still. All errors are weighted
 * as in relMSE. */
typedef struct lsf_measured_path {
    uint32_t frames; /* 0: none were measured */
    bool temporal;   /* light was kept from frame to frame */
    lsf_quartiles milliseconds;
    lsf_estimate relmse;     /* mean over frames */
    lsf_estimate difference; /* squared error of the change from frame to frame */
    lsf_estimate flicker;    /* squared change from frame to frame of a still picture */
    double motion;           /* squared change of the reference from frame to frame */
} lsf_measured_path;

/* Time of a pass in the frame of the first seed. */
typedef struct lsf_measured_pass {
    char name[48];
    uint64_t runs;
    double milliseconds; /* mean per iteration */
} lsf_measured_pass;

/* A configuration at one number of samples. */
typedef struct lsf_measured_point {
    uint32_t configuration;
    uint32_t samples; /* iterations of a frame */
    uint32_t seed_count;
    lsf_measured_seed seeds[LSF_SWEEP_MAX_SEEDS];
    uint32_t pass_count;
    lsf_measured_pass passes[LSF_SWEEP_MAX_PASSES];
    uint64_t gl_bytes, gl_bytes_peak; /* while its frames were made */
    lsf_squared_error mse, relmse;
    lsf_measured_path path;
    char *picture, *preview; /* files of the first seed: linear radiance, and tone-mapped; NULL */
    /* What follows. */
    lsf_quartiles milliseconds;
    lsf_estimate rmse, bias[3], ssim, psnr, flip, flip_hdr;
    bool front;       /* no other point has less relMSE in as little time */
    double ssim_gain; /* in per cent for each millisecond more than the point of the lowest SSIM;
                       * NAN where it takes no more */
} lsf_measured_point;

/* error(N) = floor + noise N^-exponent, N samples. */
typedef struct lsf_error_fit {
    uint32_t points; /* number of points it is fitted to; below 3 there is no fit, and all is NAN */
    lsf_estimate floor, noise, exponent;
} lsf_error_fit;

/* A technique with options, at any number of samples. */
typedef struct lsf_configuration {
    char *technique;
    uint32_t option_count;
    char *options[LSF_SWEEP_MAX_OPTIONS]; /* "vpl.count=4" */
    lsf_error_fit mse, relmse;
    char *command; /* that renders it, without the samples; NULL: unknown */
    char *failure; /* why it has no point; NULL: it has */
} lsf_configuration;

/* Time at which a configuration reaches a relMSE. */
typedef struct lsf_time_to_error {
    uint32_t configuration;
    double relmse;
    double samples, milliseconds; /* NAN: never, because its floor is higher */
    bool extrapolated;            /* beyond the measured points, by the fit */
} lsf_time_to_error;

typedef struct lsf_measured_reference {
    uint64_t samples[2];                 /* a pixel, of each half */
    double seconds;                      /* spent on tracing them, now or earlier */
    bool cached;                         /* no part of it was traced now */
    char key[33];                        /* of scene and options, in hexadecimal */
    double mean[3];                      /* R, G, B */
    double rmse;                         /* standard deviation of the halves' mean */
    char *picture, *preview, *halves[2]; /* files, or NULL */
} lsf_measured_reference;

/* The request, and the settings that meet it best. */
typedef struct lsf_answer {
    bool given;
    double budget_ms; /* NAN: not asked for */
    double relmse;    /* the same */
    bool met;         /* a measured point meets it */
    uint32_t configuration, samples;
    lsf_estimate error; /* relMSE */
    double milliseconds;
    double confidence; /* within a time: probability that no other candidate is better by 10 %;
                        * to an error: that its own error is no larger. NAN: unknown, as in half
                        * a search */
    uint32_t candidates, finalists;
    char *command; /* that renders it */
} lsf_answer;

typedef struct lsf_measurement {
    char *scene, *command;
    char scene_hash[33]; /* of the files' content */
    char key[33];        /* of everything that its points depend on */
    uint32_t width, height, bounces;
    bool raw, interrupted;
    lsf_clock clock;
    double relmse_epsilon;
    float exposure; /* EV, of SSIM and previews */
    double seconds; /* of the whole measurement */
    lsf_measured_reference reference;
    uint32_t configuration_count, point_count;
    uint64_t configuration_capacity, point_capacity;
    lsf_configuration *configurations;
    lsf_measured_point *points;
    uint32_t time_count;
    lsf_time_to_error *times;
    lsf_answer answer;
} lsf_measurement;

void lsf_measurement_finish(lsf_measurement *measurement);

/* The point of a configuration at a number of samples; NULL: none. */
lsf_measured_point *lsf_measurement_find(const lsf_measurement *measurement, uint32_t configuration,
                                         uint32_t samples);
/* The point with the most samples, and that with the most below another's; NULL: none. */
const lsf_measured_point *lsf_measurement_last(const lsf_measurement *measurement,
                                               uint32_t configuration);
const lsf_measured_point *lsf_measurement_before(const lsf_measurement *measurement,
                                                 const lsf_measured_point *point);
void lsf_measurement_drop_point(lsf_measurement *measurement, lsf_measured_point *point);
/* Appends a zeroed element; NULL when memory is exhausted. */
lsf_measured_point *lsf_measurement_add_point(lsf_measurement *measurement);
/* Adds a copy of technique and options, or finds the existing one; -1 when memory is exhausted. */
int64_t lsf_measurement_add_configuration(lsf_measurement *measurement, const char *technique,
                                          const char *const *options, uint32_t option_count);

/* Computes the values that derive from the pictures of a point alone. */
void lsf_measured_point_derive(lsf_measured_point *point);
/* Computes all derived values. False when memory is exhausted. */
bool lsf_measurement_derive(lsf_measurement *measurement);

#endif
