/* Virtual point lights, drawn from a reflective shadow map or on emissive surfaces, and their
 * shadow maps. See vpl.md. */
#ifndef LSF_PASSES_VPL_H
#define LSF_PASSES_VPL_H

#include "frame/light_projection.h"
#include "frame/maps.h"
#include "plan/option.h"
#include "scene/emitters.h"
#include "shared/vpl_data.h"

typedef struct lsf_vpl_params {
    int32_t count; /* an iteration, of punctual lights and as many on emitters; 0: none */
    int32_t shadow_resolution; /* texels along the side of a VPL's map */
} lsf_vpl_params;

#define LSF_VPL_PARAMS_DEFAULTS .count = 1, .shadow_resolution = 256

#define LSF_VPL_OPTION_COUNT 2
extern const lsf_option_row lsf_vpl_options[LSF_VPL_OPTION_COUNT];

/* The origins of VPLs. */
typedef struct lsf_vpl_use {
    bool lights;   /* reflective shadow maps of punctual lights */
    bool emitters; /* emissive surfaces */
} lsf_vpl_use;

/* A light's reflective shadow map. */
typedef struct lsf_vpl_inputs {
    const lsf_shadow *shadow;
    const lsf_surface_maps *seen; /* by the light */
    GLuint importance, sums;      /* with adaptive emission */
} lsf_vpl_inputs;

typedef struct lsf_vpl_outputs {
    GLuint vpls;  /* struct lsf_vpl_data each: those of lights, then those on emitters */
    GLuint fetch; /* buffer texture of the same, RGBA32F */
    GLuint maps;  /* struct lsf_light_data each, 512 bytes apart */
    GLuint shadow_map,
        emitter_map; /* R32UI, lib/hemisphere.glsl; of the VPL of each kind in turn */
    GLuint shadow_tint,
        emitter_tint; /* RGB10_A2 or RGBA32F, of light that passes what transmits; or 0 */
} lsf_vpl_outputs;

typedef struct lsf_vpl {
    lsf_context *context;
    lsf_vpl_outputs outputs;
    uint32_t count;         /* of each kind */
    uint32_t first_emitter; /* the first VPL that lies on an emitter */
    uint32_t shadow_resolution;
    GLuint random;         /* what the host draws for each VPL */
    GLuint large, command; /* triangles that the pipeline draws, and the command that draws them */
    GLuint framebuffer, vertex_array; /* without attachments, without attributes */
    GLuint draw_program, emitter_program, small_program, large_program, map_program;
    GLuint straight_program, tint_program; /* for transmitting surfaces; 0: there are none */
    GLuint tint_framebuffers[2];           /* of shadow_tint and emitter_tint */
    bool masked;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *draw_timer, *emitter_timer, *map_timer; /* the first two: NULL when not in use */
} lsf_vpl;

/* Lists passes "vpl_draw", "vpl_emitter" and "vpl_shadow_map" for params->count VPLs of each kind,
 * which must not be 0; the reflective shadow map is planned first. */
void lsf_vpl_plan(lsf_plan *plan, const lsf_vpl_params *params, const lsf_vpl_use *use);
bool lsf_vpl_create(lsf_vpl *pass, lsf_context *context, const lsf_plan *plan,
                    const lsf_vpl_params *params, lsf_error *error);
/* Draws VPLs `first` to `first + count - 1` of the iteration from one light, which was picked for
 * each of them with probability `light_probability`. */
void lsf_vpl_draw(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t first, uint32_t count,
                  float light_probability, const lsf_vpl_inputs *inputs);
/* Places VPL `index` of the iteration, from first_emitter on, on an emissive surface. */
void lsf_vpl_emit(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index,
                  const lsf_emitter_sample *sample);
/* Draws the shadow map of one of them. */
void lsf_vpl_shadow_map(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index);
/* VPL `index` as a light with its map, if that is the last one drawn of its kind; for
 * lib/shadow.glsl with LSF_SHADOW_HEMISPHERE. */
lsf_shadow lsf_vpl_shadow(const lsf_vpl *pass, uint32_t index);
void lsf_vpl_destroy(lsf_vpl *pass);

#endif
