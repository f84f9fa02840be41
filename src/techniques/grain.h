/* Checks whether a map or a grid over all of the scene is fine enough for what the picture
 * shows. */
#ifndef LSF_TECHNIQUES_GRAIN_H
#define LSF_TECHNIQUES_GRAIN_H

#include "frame/iteration.h"

/* Cells across the picture's shorter side, at half of all visible points' depth, below which light
 * that bounces is off by 5 % and more: measured in docs/voxels.md, "Limitations". */
#define LSF_GRAIN_CELLS 16.0f

/* Warns, once the depth of the first picture is there (the G-buffer's), when the plan's grain is
 * too coarse. */
void lsf_grain_check(const lsf_iteration *iteration, GLuint depth);

#endif
