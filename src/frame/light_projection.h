/* Shadow maps: their shapes and the projections onto them. See shared/light_data.h and
 * lib/light_projection.glsl. */
#ifndef LSF_FRAME_LIGHT_PROJECTION_H
#define LSF_FRAME_LIGHT_PROJECTION_H

#include "frame/iteration.h"
#include "shared/light_data.h"

typedef enum lsf_light_projection_kind {
    LSF_LIGHT_PROJECTION_CUBE,    /* 6 faces: point lights and wide spots */
    LSF_LIGHT_PROJECTION_SPOT,    /* 1 face: narrow spots */
    LSF_LIGHT_PROJECTION_WINDOWS, /* nested windows: directional lights */
    LSF_LIGHT_PROJECTION_KINDS,
} lsf_light_projection_kind;

lsf_light_projection_kind lsf_light_projection_kind_of(const lsf_light_state *light);

/* Whether anything lights surfaces directly: a punctual light, or the environment by directions. */
bool lsf_light_any(const lsf_plan *plan, const lsf_state *state);
/* Which kinds of map the lights need for surfaces that the camera may not see: directions of an
 * environment map need windows; those of a uniform environment light visible points alone. */
void lsf_light_projection_kinds(const lsf_plan *plan, const lsf_state *state,
                                bool needed[LSF_LIGHT_PROJECTION_KINDS]);

/* A light with its shadow map, for lib/shadow.glsl; or several directions of the environment,
 * with a map that has a layer for each. */
typedef struct lsf_shadow {
    GLuint depth;    /* DEPTH_COMPONENT32F; or R32UI with keys of lib/hemisphere.glsl,
                      * lib/sky_map.glsl */
    GLuint gradient; /* RG16F; 0: such maps have none */
    GLuint tint;  /* RGB10_A2 or RGBA32F, tint of light that passes transmitting surfaces; 0: there
                   * are none */
    GLuint light; /* buffer of struct lsf_light_data or lsf_sky_map_data; 0: there is no light */
    GLintptr offset; /* offset of that struct in the buffer */
    GLsizeiptr size;
} lsf_shadow;

void lsf_shadow_bind(const lsf_shadow *shadow);

/* Whether light paths are drawn by what the reflective shadow map shows, which is planned first. */
bool lsf_light_emission_is_adaptive(const lsf_plan *plan);

/* Adds to the pass in turn the switches of lib/light.glsl. */
void lsf_light_switches(lsf_plan *plan);

/* A shadow map to project onto. */
typedef struct lsf_light_projection_layout {
    uint32_t faces;
    bool view;   /* windows of a directional light are nested about what the camera sees; else one
                  * window holds the whole scene */
    bool fitted; /* depths of such windows are limited to what the camera sees, and texels to as
                  * many as it needs; else depths hold the whole scene */
    uint32_t least;      /* smallest number of texels along a side where fitted */
    uint32_t resolution; /* texels along a face's side; the largest number of them where fitted */
    uint32_t purpose;    /* seeds of its random rotation and offset are of lsf_iteration_seed's
                          * purposes from here on, two for each light */
    lsf_light_use use;
} lsf_light_projection_layout;

/* Describes iteration->lights[light_index] and the projection onto its map, which is rotated and
 * moved at random for this iteration. */
void lsf_light_projection_project(struct lsf_light_data *data, const lsf_iteration *iteration,
                                  uint32_t light_index, const lsf_light_projection_layout *layout);

/* The half spaces of a face's four sides. */
void lsf_light_projection_region(const struct lsf_light_data *data, uint32_t face,
                                 lsf_draw_region *region);

#endif
