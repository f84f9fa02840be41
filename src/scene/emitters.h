/* Emissive triangles as lights: one is drawn by its power, a point on it by area, and of a
 * double-sided one a side. Unlit materials are not among them. */
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
    uint32_t sides; /* that shine, 1 or 2: either alike */
    /* What `density` would be if points were drawn by their own luminance rather than their
     * triangle's mean: known to whoever sees the point. They are one unless a texture varies. */
    float weight_density;
} lsf_emitter_sample;

/* Lists the triangles as `state` places them; both must outlive the list. False without memory. */
bool lsf_emitters_init(lsf_emitters *emitters, const lsf_scene *scene, const lsf_state *state);
/* Follows the state to what it has become: areas, and where materials were edited all. Allocates
 * nothing while the same triangles emit. False without memory. */
bool lsf_emitters_update(lsf_emitters *emitters, bool materials_edited);
void lsf_emitters_finish(lsf_emitters *emitters);

/* Radiant power, as lsf_light_power states that of lights. */
float lsf_emitters_power(const lsf_emitters *emitters);

/* `weight_density` of a point by its luminance: this times it. 0 when nothing emits. */
float lsf_emitters_weight(const lsf_emitters *emitters);

/* u: uniform in [0, 1). Not to be called when the power is 0. Radiance is 0 where a mask cuts the
 * point out, and as often as a blended surface is not there. */
lsf_emitter_sample lsf_emitters_sample(const lsf_emitters *emitters, const double u[2]);

#endif
