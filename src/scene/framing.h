/* Where a camera stands so that the scene fills its picture. */
#ifndef LSF_SCENE_FRAMING_H
#define LSF_SCENE_FRAMING_H

#include "scene/scene.h"

/* Sets the position in `camera`, a column-major camera-to-scene matrix whose axes are unit vectors,
 * to where all of the scene, at 65 moments from the first to the last key of its animation, lies
 * inside the field of view as far back as need be and no farther; `tangent_x` and `tangent_y` are
 * of half of it, with whatever margin is to be left taken off. An empty scene is framed as the cube
 * of half width 1 about its centre. Returns the distance from the scene's centre along the view, or
 * a negative value without memory. */
double lsf_frame_scene(const lsf_scene *scene, double tangent_x, double tangent_y,
                       double camera[16]);

#endif
