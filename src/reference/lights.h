/* All that shines. Lights that are somewhere (points, spots, emissive triangles) are drawn from a
 * tree by what they do at a point; those that are nowhere (directional lights, the environment) are
 * few, and each other's only alternative: what hides the sun does not hide the lamp. */
#ifndef LSF_REFERENCE_LIGHTS_H
#define LSF_REFERENCE_LIGHTS_H

#include "math/distribution.h"
#include "reference/emitters.h"
#include "reference/light_tree.h"
#include "scene/sky.h"

/* So many point and spot lights are each asked at every vertex, and as many far ones. Of more, so
 * many are drawn at what the camera sees, and further on. Of emissive triangles, which rays find as
 * well, a vertex asks one. */
#define LSF_LIGHTS_MOST 8u
#define LSF_LIGHTS_LATER 2u

typedef struct lsf_reference_lights {
    const lsf_reference_geometry *geometry;
    lsf_reference_emitters emitters;
    lsf_light_tree glow;  /* of the emitters */
    lsf_light_tree bulbs; /* of point and spot lights, by their number in the state */
    lsf_light_tree lit; /* of the surfaces about each of them; of a few, their powers are enough */
    lsf_distribution powers;
    lsf_sky sky;
    float sky_irradiance[3][2]; /* on surfaces that face -x, x, -y, y, -z, z; 0: not drawn */
    bool sky_drawn;
    uint32_t *far; /* numbers of directional lights that shine */
    uint32_t far_count;
} lsf_reference_lights;

bool lsf_reference_lights_init(lsf_reference_lights *lights, const lsf_reference_geometry *geometry,
                               lsf_error *error);
void lsf_reference_lights_finish(lsf_reference_lights *lights);

/* Whether a direction that leaves a surface may meet something that shines. */
bool lsf_reference_lights_are_met(const lsf_reference_lights *lights);

/* Draws among what is far away, as lsf_light_tree_draw does: `far_count` stands for the
 * environment. Directional lights that do not reach the receiver may be among them. */
uint32_t lsf_far_lights_draw(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                             uint32_t most, double u, lsf_light_choice *choices);
/* The probability with which the environment is drawn. */
float lsf_sky_probability(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                          uint32_t most);

/* Draws a point or spot light by what the surfaces about it may send to a place. */
bool lsf_lit_draw(const lsf_reference_lights *lights, lsf_float3 position,
                  lsf_light_numbers numbers, lsf_light_choice *choice);
float lsf_lit_probability(const lsf_reference_lights *lights, lsf_float3 position, uint32_t light);

#endif
