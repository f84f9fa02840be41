/* How brightly a scene's emissive surfaces light the scene. */
#ifndef LSF_SCENE_EMITTED_LIGHT_H
#define LSF_SCENE_EMITTED_LIGHT_H

#include "scene/state.h"

/* The luminance that half of the scene's surfaces, by area, would have or exceed if they were white
 * and reflected the emitters' direct light alone, with nothing in the way: the median over points
 * x of
 *
 *   1/pi integral over emitters y of L_e(y) cos_x cos_y / r^2
 *
 * The median, for a lamp that lights its own shade alone has a large mean. 0 when nothing emits;
 * infinity, which stands for "enough", when there is no memory for the estimate or
 * the scene has more triangles than it is made for (2^24). */
float lsf_emitted_light(const lsf_scene *scene, const lsf_state *state);

#endif
