/* Light of punctual lights at a vertex: by next-event estimation, and by paths that begin at
 * lights.
 *
 * A surface close to a light has unbounded radiance, and a path that finds it by chance is a
 * firefly. Therefore a path also begins at a light, by its intensity, and the first surface
 * point y that it hits is joined to the vertex x: its density, p(y) = P(light) p(w) |cos| / d^2,
 * grows with the radiance of y. It is combined with the directions that x draws by multiple
 * importance sampling; both strategies find the same paths x, y, light (Veach 1997, chapter 10,
 * with light paths of one segment). */
#ifndef LSF_REFERENCE_PUNCTUAL_H
#define LSF_REFERENCE_PUNCTUAL_H

#include "reference/walk.h"

/* Luminance of the power, by which lights are chosen for paths. 0 for directional ones: of the
 * rays through the scene's whole bounding sphere, hardly one would reach a visible surface. */
float lsf_punctual_power(const lsf_light_state *light);

/* Adds the direct light of a light that is sampled with this probability. It passes clear walls
 * straight, and ends at every other surface, as in shadow maps. */
void lsf_add_punctual(lsf_walk *walk, uint32_t light, float asked);

/* The first surface point in a direction drawn by the light's intensity. */
bool lsf_punctual_begin(const lsf_reference_geometry *geometry, const lsf_light_state *light,
                        const float u[2], lsf_reference_chance chance, lsf_reference_hit *hit);

/* Adds light of a point or spot light that reaches the vertex through one other surface: the
 * share of paths that begin at the light. */
void lsf_add_joined(lsf_walk *walk);
/* Whether lsf_add_joined can add anything here. */
bool lsf_may_join(const lsf_walk *walk);

#endif
