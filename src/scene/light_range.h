/* How bright and how dim light may be, so that sums, products and squares of distances stay within
 * floats. */
#ifndef LSF_SCENE_LIGHT_RANGE_H
#define LSF_SCENE_LIGHT_RANGE_H

#include "scene/scene.h"

/* Bounds of radiance [W/(m^2 sr)], irradiance of directional lights [W/m^2], and intensity
 * [W/sr] of others in normalised units (state.h). 1e24 / LSF_LIGHT_DISTANCE2_MIN is 1e36, and a
 * float holds 3.4e38; 1e-24 leaves as much below. */
#define LSF_LIGHT_BRIGHTEST 1e24
#define LSF_LIGHT_DIMMEST 1e-24

/* Sets emission and environment that are dimmer to 0, with a note; brighter light is
 * LSF_ERROR_FILE. Call it before the requirements are computed. */
bool lsf_bound_radiance(lsf_scene *scene, lsf_error *error);
/* The same for lights that nodes carry; call it afterwards, for it uses the scene's size. */
bool lsf_bound_lights(lsf_scene *scene, lsf_error *error);

#endif
