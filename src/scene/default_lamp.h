/* A lamp for a view of a closed room, which no light from outside would reach. */
#ifndef LSF_SCENE_DEFAULT_LAMP_H
#define LSF_SCENE_DEFAULT_LAMP_H

#include "scene/seen.h"

/* The share of its sky, weighted by the cosine, that a point must see to count as lit from
 * outside: as much light as LSF_LIT_LUMINANCE_MIN (default_light.h) asks of emitters, for under an
 * open sky with the key light a white surface has radiance 1. */
#define LSF_OPEN_SKY_MIN 0.045f

/* Places the lamp where most of what the camera sees without enough sky sees it, if that is more
 * than a quarter of all it sees: of sample models that were tried, objects had at most 2 % of such
 * points, and a tent, a cave and two rooms, which were dark, 31 to 67 %. Half of the points that
 * see the lamp get `irradiance` [W/m^2] from it, or more. `present` is false where no lamp is
 * needed, or has no place. */
lsf_default_lamp lsf_default_lamp_place(const lsf_state *state, const lsf_seen *seen,
                                        double irradiance);

#endif
