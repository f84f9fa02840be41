/* Where an iteration's ray-bundles go. */
#ifndef LSF_TECHNIQUES_BUNDLE_DIRECTIONS_H
#define LSF_TECHNIQUES_BUNDLE_DIRECTIONS_H

#include "passes/ray_bundle.h"

/* Draws `count` axes, uniform over the sphere; each is used both ways, so that its density is
 * 1 / (2 pi). All bundles of all iterations are one low-discrepancy sequence, unless they are to be
 * `independent` of each other, as paths along several of them need: then each number has its own.
 */
void lsf_bundle_directions_draw(const lsf_iteration *iteration, uint32_t count, bool independent,
                                lsf_ray_bundle_direction *directions);

#endif
