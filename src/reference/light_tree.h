/* A tree of many lights, from which lights are drawn in proportion to their estimated
 * contribution at a point.
 *
 * A. Conty Estevez and C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree
 * Splitting", Proc. ACM Comput. Graph. Interact. Tech. 1(2), 2018. Each node has bounds of the
 * positions, directions and intensity of its lights. The descent is drawn by these, and the same
 * values give the probability of any light. */
#ifndef LSF_REFERENCE_LIGHT_TREE_H
#define LSF_REFERENCE_LIGHT_TREE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vector.h"

/* A light, or a group of them. Radiance falls off with the cosine of the angle to the axis less
 * `spread`, up to the angle `emission`. */
typedef struct lsf_light_bounds {
    float low[3], high[3];
    float axis[3]; /* unit */
    float cos_spread, cos_emission;
    float intensity; /* luminance, at most that along the axis [W/sr] */
    float range;     /* distance beyond which no light arrives; INFINITY: unbounded */
    bool two_sided;  /* emits along -axis, too */
} lsf_light_bounds;

typedef struct lsf_light_node lsf_light_node;

typedef struct lsf_light_tree {
    lsf_light_node *nodes; /* NULL: there are no lights */
    uint32_t *leaves;      /* node of each light; LSF_NO_LEAF: it emits nothing */
    uint32_t light_count;
} lsf_light_tree;

#define LSF_NO_LEAF UINT32_MAX

/* Radians by which rounding may widen or narrow a cone. */
#define LSF_LIGHT_ROUNDING 1e-5f

/* False when memory is exhausted; nothing is left to finish then. */
bool lsf_light_tree_init(lsf_light_tree *tree, const lsf_light_bounds *lights, uint32_t count);
void lsf_light_tree_finish(lsf_light_tree *tree);

/* The point at which light arrives. */
typedef struct lsf_light_receiver {
    lsf_float3 position;
    lsf_float3 normal; /* unit; 0: light from all directions counts equally */
    bool both_sides;   /* light from behind counts, too */
} lsf_light_receiver;

typedef struct lsf_light_choice {
    uint32_t light;
    float probability;
    /* Uniform in [0, 1), for a position on a light that is drawn alone: the rest of the random
     * number that chose it, and that number's partner, so that positions are spread as evenly as
     * choices. */
    double u[2];
} lsf_light_choice;

/* Random numbers for the choice of lights: each group has its own, uniform over the samples and
 * spread evenly over those of a seed. */
typedef struct lsf_light_numbers {
    uint32_t seed, sample;
} lsf_light_numbers;

/* Draws at most `most` lights, one from each of as many groups: more of them where more light
 * comes from, and each light by itself if there are no more than that. Returns their number,
 * which is smaller where groups can send nothing. The sum of f(light) / probability over the
 * drawn lights estimates the sum over all lights that can light the receiver. */
uint32_t lsf_light_tree_draw(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                             uint32_t most, lsf_light_numbers numbers, lsf_light_choice *choices);

/* Probability with which lsf_light_tree_draw draws this light; above 0 if it can send any light. */
float lsf_light_tree_probability(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                                 uint32_t most, uint32_t light);

#endif
