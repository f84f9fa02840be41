/* How far the bounds of a scene that moves may extend. */
#ifndef LSF_SCENE_REACH_H
#define LSF_SCENE_REACH_H

#include "scene/state.h"

/* Sets the reach of a state whose bounds are set: these and the boxes of all instances at the
 * moments of the animations, rounded outwards by up to LSF_REACH_STEP, so that objects which a
 * program moves seldom leave it. Where nothing moves it equals the bounds. It depends on scene
 * and time alone. False without memory. */
bool lsf_state_update_reach(lsf_state *state, const lsf_scene *scene);

/* Normalised units. */
#define LSF_REACH_STEP 0.0625f

#endif
