/* Values of options that are left to the scene, the picture's size and the time. */
#ifndef LSF_TECHNIQUES_DEFAULTS_H
#define LSF_TECHNIQUES_DEFAULTS_H

#include "techniques/setup.h"

/* Whether the environment, and no lamp, lights what the camera sees from outside. */
bool lsf_stands_in_the_open(const lsf_setup *setup);
/* Whether all pixels should take the same samples. */
bool lsf_shares_samples(const lsf_setup *setup);
/* Whether the picture has more pixels than one iteration can do in the time limit. */
bool lsf_hurries(const lsf_setup *setup);
/* Voxels along the scene's longest side, where voxel.resolution leaves them to the time limit. */
uint32_t lsf_default_voxels(const lsf_setup *setup);
/* Sets the texels of ray-bundles and of reflective shadow maps from the number of iterations, where
 * bundle.resolution and rsm.resolution leave them to it. */
void lsf_default_maps(lsf_setup *setup);
/* Sets the options of sample points that were left out. */
void lsf_default_points(lsf_setup *setup);
/* Sets light_tree.samples and voxel_path.max_samples, if they were left out, to as many as fit into
 * the time limit; after lsf_default_points. */
void lsf_default_point_samples(lsf_setup *setup);
/* Leaves light_filter.steps those that fit into the picture: their neighbours are at most a
 * sixteenth of it apart. Two remove what repeats every 4 pixels, and points of a grid of 2^n pixels
 * need n + 1. */
void lsf_default_filter_steps(lsf_setup *setup);
/* Sample points along a pixel's side, gbuffer.side or its default. */
uint32_t lsf_default_pixel_side(const lsf_setup *setup, const lsf_technique *technique);

#endif
