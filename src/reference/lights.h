/* All light sources. Those at finite distance (points, spots, emissive triangles) are drawn from
 * a tree by their contribution at a point. Those at infinity (directional lights, the
 * environment) are few and form a separate set: occlusion of the sun says nothing about that of
 * a lamp. */
#ifndef LSF_REFERENCE_LIGHTS_H
#define LSF_REFERENCE_LIGHTS_H

#include "math/distribution.h"
#include "reference/emitters.h"
#include "reference/light_tree.h"
#include "scene/sky.h"

/* Up to this number of point and spot lights, and as many lights at infinity, are all sampled at
 * every vertex. Of more, this number is drawn at the visible point, and one at later vertices.
 * Of emissive triangles, which rays find as well, a vertex draws one. */
#define LSF_LIGHTS_MOST 8u
#define LSF_LIGHTS_LATER 2u

typedef struct lsf_reference_lights {
    const lsf_reference_geometry *geometry;
    lsf_reference_emitters emitters;
    lsf_light_tree glow;  /* of the emitters */
    lsf_light_tree bulbs; /* over point and spot lights, by their number in the state */
    lsf_light_tree lit;   /* over the surfaces around each of them; for a few, their powers are
                           * enough */
    lsf_distribution powers;
    lsf_sky sky;
    float sky_irradiance[3][2]; /* on surfaces that face -x, x, -y, y, -z, z; 0: not drawn */
    bool sky_drawn;
    uint32_t *far; /* numbers of the directional lights that emit light */
    uint32_t far_count;
} lsf_reference_lights;

bool lsf_reference_lights_init(lsf_reference_lights *lights, const lsf_reference_geometry *geometry,
                               lsf_error *error);
void lsf_reference_lights_finish(lsf_reference_lights *lights);

/* Whether a direction that leaves a surface may hit a light source. */
bool lsf_reference_lights_are_met(const lsf_reference_lights *lights);

/* Draws among the lights at infinity, as lsf_light_tree_draw does: `far_count` stands for the
 * environment. Directional lights that do not reach the receiver may be among them. */
uint32_t lsf_far_lights_draw(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                             uint32_t most, double u, lsf_light_choice *choices);
/* Probability with which the environment is drawn. */
float lsf_sky_probability(const lsf_reference_lights *lights, const lsf_light_receiver *receiver,
                          uint32_t most);

/* Draws a point or spot light by the light that the surfaces around it may send to a point. */
bool lsf_lit_draw(const lsf_reference_lights *lights, lsf_float3 position,
                  lsf_light_numbers numbers, lsf_light_choice *choice);
float lsf_lit_probability(const lsf_reference_lights *lights, lsf_float3 position, uint32_t light);

#endif
