/* Checks of what a program sets in a scene; LSF_ERROR_USAGE says what is out of range, and why. */
#ifndef LSF_SCENE_CHECKS_H
#define LSF_SCENE_CHECKS_H

#include "scene/scene.h"

/* Whether a value lies between two bounds; `what` and `index` name its owner in the message. */
bool lsf_check_within(const char *what, uint32_t index, const char *name, float value, double least,
                      double most, lsf_error *error);
/* Whether light is 0 or within the range that floats resolve (light_range.h). `unit`: a
 * normalised unit of it in the scene's units. */
bool lsf_check_bright(const char *what, uint32_t index, const char *name, const float light[3],
                      double unit, lsf_error *error);
/* Light that is too dim to be told from none becomes 0. */
void lsf_store_light(float out[3], const float light[3], double unit);

/* `unit`: of a point or spot light's intensity. */
bool lsf_check_light(uint32_t index, const lsf_light_desc *desc, double unit, lsf_error *error);
/* Takes over values that were checked. `unit` 0: light is kept however dim. */
void lsf_light_set(lsf_light *light, const lsf_light_desc *desc, double unit);
/* Affine and finite. */
bool lsf_check_matrix(uint32_t node, const double matrix[16], lsf_error *error);

/* Whether a scene is there, and not one that is still being built. */
bool lsf_scene_given(const lsf_scene *scene, lsf_error *error);

#endif
