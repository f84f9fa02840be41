/* Light of punctual lights at a vertex, found there and by paths that lights begin.
 *
 * A surface close to a light is bright without bound, and a path that comes upon it by chance is a
 * firefly. So a path is begun at a light too, by its intensity, and the first surface y that it
 * meets is joined to the vertex x: its density there, p(y) = P(light) p(w) |cos| / d^2, is as large
 * as y is bright. With the directions that x draws it is combined by multiple importance sampling;
 * both ways find the same paths x, y, light (Veach 1997, chapter 10, with light paths of one
 * segment). */
#ifndef LSF_REFERENCE_PUNCTUAL_H
#define LSF_REFERENCE_PUNCTUAL_H

#include "reference/walk.h"

/* Luminance of the power with which a light begins paths. 0 of directional ones: of the many rays
 * through the scene's whole bounding sphere, hardly one would meet what is seen. */
float lsf_punctual_power(const lsf_light_state *light);

/* Adds what a light sends straight to the vertex, where it is asked with this probability. Its
 * light passes clear walls straight on, and ends at every other surface, as in shadow maps. */
void lsf_add_punctual(lsf_walk *walk, uint32_t light, float asked);

/* The first surface on a way that the light draws by its intensity. */
bool lsf_punctual_begin(const lsf_reference_geometry *geometry, const lsf_light_state *light,
                        const float u[2], lsf_reference_chance chance, lsf_reference_hit *hit);

/* Adds what reaches the vertex from a point on or spot light by way of one other surface: the share
 * of paths that the light begins. */
void lsf_add_joined(lsf_walk *walk);
/* Whether lsf_add_joined can add anything here. */
bool lsf_may_join(const lsf_walk *walk);

#endif
