/* The rays that a bundle answers, as a ray tracer takes them: one from each visible point. */
#ifndef LSF_BENCH_SCREEN_RAYS_H
#define LSF_BENCH_SCREEN_RAYS_H

#include "frame/iteration.h"
#include "reference/module.h"

typedef struct lsf_screen_point {
    float position[3], normal[3]; /* normalised space; the geometric normal */
    uint32_t pixel;
} lsf_screen_point;

typedef struct lsf_screen_rays {
    uint64_t count;
    lsf_screen_point *points; /* tile by tile, so that neighbours follow each other */
    lsf_reference_ray *rays;  /* of the direction aimed at, those along it before those against */
    uint32_t *pixels;         /* of each ray */
} lsf_screen_rays;

/* Reads the visible points back from the G-buffer. Finish it in either case. */
bool lsf_screen_rays_init(lsf_screen_rays *rays, const lsf_iteration *iteration, GLuint depth,
                          GLuint surface, lsf_error *error);
void lsf_screen_rays_aim(lsf_screen_rays *rays, const float direction[3]);
void lsf_screen_rays_finish(lsf_screen_rays *rays);

#endif
