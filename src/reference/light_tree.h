/* Many lights in a tree, from which those are drawn that do most at a point.
 *
 * A. Conty Estevez and C. Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting",
 * Proc. ACM Comput. Graph. Interact. Tech. 1(2), 2018. Each node knows where its lights are, which
 * way they shine and how strongly; by that the way down is drawn, and the same numbers give the
 * probability of any light again. */
#ifndef LSF_REFERENCE_LIGHT_TREE_H
#define LSF_REFERENCE_LIGHT_TREE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vector.h"

/* A light, or a group of them. They shine by the cosine of what is left of the angle to their axis
 * when `spread` is taken away, as far as `emission`. */
typedef struct lsf_light_bounds {
    float low[3], high[3];
    float axis[3]; /* unit */
    float cos_spread, cos_emission;
    float intensity; /* luminance, at most that along the axis [W/sr] */
    float range;     /* nothing arrives farther off; INFINITY: there is no such bound */
    bool two_sided;  /* they shine along -axis, too */
} lsf_light_bounds;

typedef struct lsf_light_node lsf_light_node;

typedef struct lsf_light_tree {
    lsf_light_node *nodes; /* NULL: no light shines */
    uint32_t *leaves;      /* node of each light; LSF_NO_LEAF: it does not shine */
    uint32_t light_count;
} lsf_light_tree;

#define LSF_NO_LEAF UINT32_MAX

/* Radians that rounding may turn a cone's border by. */
#define LSF_LIGHT_ROUNDING 1e-5f

/* False without memory; nothing is left to finish then. */
bool lsf_light_tree_init(lsf_light_tree *tree, const lsf_light_bounds *lights, uint32_t count);
void lsf_light_tree_finish(lsf_light_tree *tree);

/* Where light is to arrive. */
typedef struct lsf_light_receiver {
    lsf_float3 position;
    lsf_float3 normal; /* unit; 0: light from everywhere counts alike */
    bool both_sides;   /* light from behind counts, too */
} lsf_light_receiver;

typedef struct lsf_light_choice {
    uint32_t light;
    float probability;
    /* Uniform in [0, 1), for a place on a light that is drawn alone: what is left of the number
     * that chose it, and that number's partner, so that places are spread as evenly as choices are.
     */
    double u[2];
} lsf_light_choice;

/* What lights are drawn by: each group by numbers of its own, which are uniform over the samples,
 * and spread evenly over those of a seed. */
typedef struct lsf_light_numbers {
    uint32_t seed, sample;
} lsf_light_numbers;

/* Draws at most `most` lights, one from each of as many groups: more of them where more light comes
 * from, and each light by itself where that is enough. Gives how many; fewer where groups can send
 * nothing. The sum of f(light) / probability over what is drawn estimates the sum over all lights
 * that can light the receiver. */
uint32_t lsf_light_tree_draw(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                             uint32_t most, lsf_light_numbers numbers, lsf_light_choice *choices);

/* The probability with which lsf_light_tree_draw draws this light; above 0 if it can send any. */
float lsf_light_tree_probability(const lsf_light_tree *tree, const lsf_light_receiver *receiver,
                                 uint32_t most, uint32_t light);

#endif
