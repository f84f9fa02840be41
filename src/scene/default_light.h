/* Light for a scene that would be dark without it: a soft sky and a key light, and in closed rooms
 * a lamp. */
#ifndef LSF_SCENE_DEFAULT_LIGHT_H
#define LSF_SCENE_DEFAULT_LIGHT_H

#include "scene/scene.h"

/* Emitters whose light alone would leave half of what the first camera shows, were it white, below
 * this luminance do not count as lighting the scene (lsf_emitted_light). Radiance 1 is displayed as
 * white. It is a quarter of the middle grey: a picture that is keyed so low is the darkest that
 * photographic practice calls exposed on purpose (Reinhard et al., "Photographic Tone Reproduction
 * for Digital Images", 2002, section 3.1: keys of 0.18 for a normal and 0.045 for the lowest
 * subject). */
#define LSF_LIT_LUMINANCE_MIN 0.045f

/* Adds light as `mode` says, with a note that says why, and recomputes the requirements, which
 * have to be there, as the camera has. LSF_ERROR_FILE without memory. */
bool lsf_default_light_add(lsf_scene *scene, lsf_default_light mode, lsf_error *error);

#endif
