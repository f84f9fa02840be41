/* How brightly a scene's emissive surfaces light what the camera sees. */
#ifndef LSF_SCENE_EMITTED_LIGHT_H
#define LSF_SCENE_EMITTED_LIGHT_H

#include "scene/seen.h"

/* The luminance that half of what the camera sees would have or exceed if it were white and
 * reflected the emitters' direct light alone, with nothing in the way: the median over the seen
 * points x of
 *
 *   1/pi integral over emitters y of L_e(y) cos_x cos_y / r^2
 *
 * The median, for a lamp that lights its own shade alone has a large mean; of what is seen, for a
 * thing that glows lights its own inside. 0 when nothing emits or nothing is seen; negative
 * without memory. */
float lsf_emitted_light(const lsf_scene *scene, const lsf_state *state, const lsf_seen *seen);

#endif
