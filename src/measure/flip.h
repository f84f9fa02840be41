/* FLIP: how different two pictures look to a person who flips between them.
 *
 * Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference
 * Evaluator for Alternating Images", Proc. ACM on Computer Graphics and Interactive Techniques
 * 3(2), 2020; for high dynamic range Andersson, Nilsson, Shirley and Akenine-Moller, "Visualizing
 * Errors in Rendered High Dynamic Range Images", Eurographics short papers, 2021. */
#ifndef LSF_MEASURE_FLIP_H
#define LSF_MEASURE_FLIP_H

#include "base/base.h"

/* Of the papers' observer: 3840 pixels on 0.7 m, seen from 0.7 m. */
#define LSF_FLIP_PIXELS_PER_DEGREE 67.0206433f

/* Linear R, G, B of each pixel, from the top row on. */
typedef struct lsf_flip_pair {
    const float *test, *reference;
    uint32_t width, height;
} lsf_flip_pair;

/* `map` gets a value in 0..1 for each pixel: 0 where the pictures look alike. Values of the pair
 * are what a display shows, in 0..1. False when memory is short. */
bool lsf_flip(const lsf_flip_pair *shown, float *map);

typedef struct lsf_flip_exposures {
    float start, stop; /* EV */
    uint32_t count;    /* evenly spaced, both ends included; 0: the reference is black */
} lsf_flip_exposures;

/* The exposures that bring the reference's brightest and median luminance to the shoulder of the
 * ACES curve. Only pixels with `compared[i]` nonzero count. Where half of them are black, the
 * median is of the others. False when memory is short. */
bool lsf_flip_choose_exposures(const lsf_flip_pair *radiance, const uint8_t *compared,
                               lsf_flip_exposures *exposures);

/* The largest of the maps over these exposures, each tone-mapped by the ACES curve. */
bool lsf_flip_hdr(const lsf_flip_pair *radiance, const lsf_flip_exposures *exposures, float *map);

#endif
