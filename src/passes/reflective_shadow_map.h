/* The surfaces that punctual lights reach, which virtual point lights are drawn from. See
 * reflective_shadow_map.md. */
#ifndef LSF_PASSES_REFLECTIVE_SHADOW_MAP_H
#define LSF_PASSES_REFLECTIVE_SHADOW_MAP_H

#include "frame/light_projection.h"
#include "frame/light_walls.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef enum lsf_reflective_shadow_map_pdf {
    LSF_REFLECTIVE_SHADOW_MAP_PDF_AUTO,     /* adaptive of directional lights, for few VPLs */
    LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM,  /* by the light's emission */
    LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE, /* by what the surface reflects to visible points */
} lsf_reflective_shadow_map_pdf;

typedef struct lsf_reflective_shadow_map_params {
    int32_t resolution; /* texels along a face's side; 0: cube_resolution for maps of six faces,
                         * LSF_REFLECTIVE_SHADOW_MAP_RESOLUTION for those of one */
    int32_t cube_resolution; /* chosen by the number of iterations */
    int32_t pdf;             /* lsf_reflective_shadow_map_pdf */
} lsf_reflective_shadow_map_params;

enum { LSF_REFLECTIVE_SHADOW_MAP_RESOLUTION = 256, LSF_REFLECTIVE_SHADOW_MAP_LEAST = 16 };

#define LSF_REFLECTIVE_SHADOW_MAP_PARAMS_DEFAULTS .pdf = LSF_REFLECTIVE_SHADOW_MAP_PDF_AUTO

#define LSF_REFLECTIVE_SHADOW_MAP_OPTION_COUNT 2
extern const lsf_option_row
    lsf_reflective_shadow_map_options[LSF_REFLECTIVE_SHADOW_MAP_OPTION_COUNT];

/* The uses of the maps. */
typedef struct lsf_reflective_shadow_map_use {
    bool sky;      /* environment directions have maps, too */
    bool few_vpls; /* so few are drawn that each should light visible points */
} lsf_reflective_shadow_map_use;

/* Valid until the next run. 2D arrays with a layer for each face. */
typedef struct lsf_reflective_shadow_map_outputs {
    lsf_shadow shadow;     /* as shadow_map's */
    lsf_surface_maps seen; /* by the light, normals towards it; depth is the shadow's */
    GLuint importance;     /* R32F; see lib/emission_pdf.glsl. 0: the light's emission is uniform */
    GLuint sums;           /* buffer of floats: running sums of importance along each row, then over
                            * the rows; with adaptive emission */
    struct lsf_light_data light;
} lsf_reflective_shadow_map_outputs;

/* One set of textures for maps of the same shape, which lights use in turn. */
typedef struct lsf_reflective_shadow_map_target {
    GLuint depth, gradient, surface, specular_params, importance, tint;
    GLuint framebuffers[6], tint_framebuffers[6];
    uint32_t faces, resolution;
} lsf_reflective_shadow_map_target;

typedef struct lsf_reflective_shadow_map {
    lsf_context *context;
    lsf_reflective_shadow_map_outputs outputs;
    lsf_reflective_shadow_map_target targets[LSF_LIGHT_PROJECTION_KINDS];
    GLuint program, rows_program, scan_program;
    lsf_light_walls walls;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *timer, *pdf_timer; /* pdf_timer: NULL without adaptive emission */
} lsf_reflective_shadow_map;

/* Lists the pass, with adaptive emission also "reflective_shadow_map_pdf", and the textures of the
 * kinds of map that the lights in `state` need, and what the use does. */
void lsf_reflective_shadow_map_plan(lsf_plan *plan, const lsf_reflective_shadow_map_params *params,
                                    const lsf_state *state,
                                    const lsf_reflective_shadow_map_use *use);
bool lsf_reflective_shadow_map_create(lsf_reflective_shadow_map *pass, lsf_context *context,
                                      const lsf_plan *plan, lsf_error *error);
/* Draws the map of iteration->lights[light_index], rotated and moved at random for this
 * iteration. `viewed`: visible points, which adaptive emission is to light; NULL: any. */
void lsf_reflective_shadow_map_run(lsf_reflective_shadow_map *pass, const lsf_iteration *iteration,
                                   uint32_t light_index, const lsf_surface_maps *viewed);
void lsf_reflective_shadow_map_destroy(lsf_reflective_shadow_map *pass);

#endif
