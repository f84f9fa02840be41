/* Virtual point lights, drawn from a reflective shadow map, and their shadow maps. See vpl.md. */
#ifndef LSF_PASSES_VPL_H
#define LSF_PASSES_VPL_H

#include "plan/iteration.h"
#include "plan/option.h"
#include "shared/vpl_data.h"

typedef struct lsf_vpl_params {
    int32_t count;             /* an iteration; 0: none */
    int32_t shadow_resolution; /* texels along the side of a VPL's map */
} lsf_vpl_params;

#define LSF_VPL_PARAMS_DEFAULTS .count = 1, .shadow_resolution = 256

#define LSF_VPL_OPTION_COUNT 2
extern const lsf_option_row lsf_vpl_options[LSF_VPL_OPTION_COUNT];

/* A light's reflective shadow map. */
typedef struct lsf_vpl_inputs {
    GLuint depth, surface, gloss; /* gloss 0 where the scene does not require it */
    GLuint light_buffer;
    GLuint importance, sums; /* with adaptive emission */
} lsf_vpl_inputs;

typedef struct lsf_vpl_outputs {
    GLuint vpls;       /* struct lsf_vpl_data each */
    GLuint maps;       /* struct lsf_light_data each, 512 bytes apart */
    GLuint shadow_map; /* R32UI, lib/hemisphere.glsl; of the VPL in turn */
} lsf_vpl_outputs;

typedef struct lsf_vpl {
    lsf_context *context;
    lsf_vpl_outputs outputs;
    uint32_t count, shadow_resolution;
    GLuint random;         /* what the host draws for each VPL */
    GLuint large, command; /* triangles that the pipeline draws, and the command that draws them */
    GLuint framebuffer, vertex_array; /* without attachments, without attributes */
    GLuint draw_program, small_program, large_program, map_program;
    bool masked;
    uint64_t counts[LSF_DRAW_COUNTS];
    lsf_timer *draw_timer, *map_timer;
} lsf_vpl;

/* Lists passes "vpl_draw" and "vpl_shadow_map" for params->count VPLs, which must not be 0; the
 * reflective shadow map is planned first. */
void lsf_vpl_plan(lsf_plan *plan, const lsf_vpl_params *params);
bool lsf_vpl_create(lsf_vpl *pass, lsf_context *context, const lsf_plan *plan,
                    const lsf_vpl_params *params, lsf_error *error);
/* Draws VPLs `first` to `first + count - 1` of the iteration from one light, which was picked for
 * each of them with probability `light_probability`. */
void lsf_vpl_draw(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t first, uint32_t count,
                  float light_probability, const lsf_vpl_inputs *inputs);
/* Draws the map of one of them. */
void lsf_vpl_shadow_map(lsf_vpl *pass, const lsf_iteration *iteration, uint32_t index);
/* Binds all VPLs to LSF_BINDING_VPL, and the map drawn last, that of VPL `index`, for
 * lib/shadow.glsl with LSF_SHADOW_HEMISPHERE. */
void lsf_vpl_bind(const lsf_vpl *pass, uint32_t index);
void lsf_vpl_destroy(lsf_vpl *pass);

#endif
