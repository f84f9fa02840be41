/* Guides of filters of light, which keep them on one surface: normals, depths and their slopes,
 * and the width of lobes, made once a picture from the means of light_mean. See light_guide.md. */
#ifndef LSF_PASSES_LIGHT_GUIDE_H
#define LSF_PASSES_LIGHT_GUIDE_H

#include "frame/iteration.h"
#include "frame/maps.h"

typedef struct lsf_light_guide_inputs {
    GLuint mean;                            /* lsf_light_mean.guide */
    GLuint diffuse_factor, specular_factor; /* as lsf_light_mean_part; specular 0 where there is no
                                             * such light */
    float kernel; /* solid angle that glossy lobes were spread over, for want of samples [sr] */
} lsf_light_guide_inputs;

typedef struct lsf_light_guide {
    lsf_context *context;
    lsf_guide_maps maps; /* output */
    GLuint framebuffer, program;
    lsf_timer *timer;
} lsf_light_guide;

void lsf_light_guide_plan(lsf_plan *plan);
bool lsf_light_guide_create(lsf_light_guide *pass, lsf_context *context, const lsf_plan *plan,
                            lsf_error *error);
/* Makes the guides from means of so many iterations. */
void lsf_light_guide_run(lsf_light_guide *pass, const lsf_plan *plan, uint32_t iterations,
                         const lsf_light_guide_inputs *inputs);
void lsf_light_guide_destroy(lsf_light_guide *pass);

#endif
