/* Emissive triangles as lights: a triangle is drawn by its power, a point on it by area, and for
 * a double-sided one a side. Unlit materials are not among them. */
#ifndef LSF_SCENE_EMITTERS_H
#define LSF_SCENE_EMITTERS_H

#include "math/distribution.h"
#include "scene/state.h"

typedef struct lsf_emitters {
    const lsf_scene *scene;
    const lsf_state *state;
    uint64_t count;
    uint32_t *instance, *triangle; /* of each */
    float *mean;                   /* luminance of its emission over its area */
    float *weight;                 /* sides * area * mean */
    lsf_distribution power;        /* by these */
} lsf_emitters;

/* A point on one side of an emissive triangle, in normalised space. */
typedef struct lsf_emitter_sample {
    float position[3], normal[3]; /* unit, the way it shines */
    float radiance[3];
    float density;  /* with which it was drawn, by area of sides */
    uint32_t sides; /* emitting sides, 1 or 2, with equal probability */
    /* The density that the point would have if points were drawn by their own luminance rather
     * than their triangle's mean, which is known where the point is seen. Both are equal unless
     * a texture varies. */
    float weight_density;
} lsf_emitter_sample;

/* Lists the triangles where `state` places them; both must outlive the list. False without
 * memory. */
bool lsf_emitters_init(lsf_emitters *emitters, const lsf_scene *scene, const lsf_state *state);
/* Follows the state: areas, and where materials were edited everything. Allocates nothing while
 * the same triangles emit. False without memory. */
bool lsf_emitters_update(lsf_emitters *emitters, bool materials_edited);
void lsf_emitters_finish(lsf_emitters *emitters);

/* Radiant power, up to the factor of lsf_light_power. */
float lsf_emitters_power(const lsf_emitters *emitters);

/* The factor from a point's luminance to `weight_density`. 0 when nothing emits. */
float lsf_emitters_weight(const lsf_emitters *emitters);

/* Draws a point by u, uniform in [0, 1). Not to be called when the power is 0. Radiance is 0
 * where a mask cuts the point out, and with the probability that a blended surface is not hit. */
lsf_emitter_sample lsf_emitters_sample(const lsf_emitters *emitters, const double u[2]);

#endif
