/* A triangle in the space of the scene, in double precision: the product of even the smallest
 * edges has a direction there. */
#ifndef LSF_SCENE_PLACED_TRIANGLE_H
#define LSF_SCENE_PLACED_TRIANGLE_H

#include "scene/state.h"

typedef struct lsf_placed_triangle {
    double corners[3][3]; /* normalised space */
    double normal[3];     /* unit, on its front; 0 for a triangle without area */
    double area;
} lsf_placed_triangle;

/* `triangle` is a number within the instance's primitive. */
lsf_placed_triangle lsf_place_triangle(const lsf_scene *scene, const lsf_state *state,
                                       uint32_t instance, uint32_t triangle);

/* The point with these barycentrics. */
void lsf_placed_triangle_point(const lsf_placed_triangle *triangle, const float weights[3],
                               float position[3]);

#endif
