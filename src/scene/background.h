/* What a picture shows where there is no surface. */
#ifndef LSF_SCENE_BACKGROUND_H
#define LSF_SCENE_BACKGROUND_H

#include <lightsheaf/renderer.h>

typedef struct lsf_seen_background {
    bool environment; /* the environment is shown; else `radiance` */
    float radiance[3];
    bool coverage; /* the share of each pixel that surfaces cover is asked for, as channel A */
} lsf_seen_background;

lsf_seen_background lsf_background_resolve(const lsf_scene *scene, const lsf_render_params *params);

#endif
