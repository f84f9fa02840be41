/* Mipmaps of colours that their alpha weighs. What a blended texel adds is alpha times its colour,
 * so that the colour of a footprint is sum(alpha colour) / sum(alpha). The plain mean mixes in what
 * transparent texels hold, often black, and darkens leaves and hair the more the smaller they are
 * in the picture. */
#ifndef LSF_FRAME_ALPHA_MIPMAPS_H
#define LSF_FRAME_ALPHA_MIPMAPS_H

#include <stdint.h>

/* Makes the levels from 1 on of linear RGBA `texels`, alpha not multiplied in: one behind the
 * other, each of half the size of the one before, rounded down, and at least 1. Where a level is
 * transparent, it has the colour of the level after it, so that samplers do not blend towards
 * black. The caller frees them; NULL without memory. */
float *lsf_alpha_mipmaps_create(const float *texels, uint32_t width, uint32_t height);

#endif
