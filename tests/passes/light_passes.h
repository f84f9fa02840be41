/* The passes that follow light from its source, run by hand on scenes made by hand; and rays by
 * brute force to hold them against. All in normalised space. */
#ifndef LSF_TESTS_PASSES_LIGHT_PASSES_H
#define LSF_TESTS_PASSES_LIGHT_PASSES_H

#include "../gl/shader_folder.h"
#include "passes/reflective_shadow_map.h"
#include "passes/vpl.h"
#include "render_gl.h"

typedef struct light_case {
    const char *name;
    lsf_light_type type;
    lsf_float3 position, direction;
    float inner, outer; /* half angles of a spot */
} light_case;

#define LIGHT_CASES 5
extern const light_case light_cases[LIGHT_CASES];

/* A room with a dark box and a slanted board in it; under the sun without walls, around a point
 * light with a sphere whose triangles take a few texels of a map each. The last two triangles are
 * the board's; everything else is closed. */
lsf_scene *light_case_scene(const light_case *c);

typedef struct light_passes {
    shader_folder folder;
    lsf_context *context;
    const lsf_scene *scene;
    lsf_state state;
    lsf_plan plan;
    lsf_scene_gpu scene_gpu;
    lsf_iteration iteration;
    lsf_reflective_shadow_map rsm;
    lsf_vpl vpl;
    /* Positions and surfaces of a probe, which asks a shader for a number at each of them. */
    GLuint probe_points, probe_results;
    uint32_t triangle_count;
    lsf_float3 *corners; /* of the scene's triangles */
} light_passes;

/* `finish_gl_scene` comes first. `pdf`: lsf_reflective_shadow_map_pdf. */
void light_passes_init(light_passes *p, const lsf_scene *scene, int32_t rsm_resolution, int32_t pdf,
                       int32_t vpl_count);
void light_passes_finish(light_passes *p);

/* The reflective shadow map of a light, then all VPLs from it. */
void light_passes_run(light_passes *p, uint32_t iteration, uint32_t light);
/* All VPLs; free it. */
struct lsf_vpl_data *light_passes_vpls(light_passes *p);

/* From scene to normalised space. */
lsf_float3 light_passes_point(const light_passes *p, lsf_float3 scene_space);

/* Evaluates `expression`, GLSL of type float over `vec3 position, normal`, at each point. `library`
 * is included; what it reads must be bound. */
void light_passes_probe(light_passes *p, const char *library, const char *switches,
                        const char *expression, const float (*points)[8], uint32_t count,
                        float *results);

/* Distance along the unit direction to the nearest triangle past `start`; INFINITY for none.
 * `normal` (NULL allowed) receives that of its plane. */
double light_passes_trace(const light_passes *p, lsf_float3 origin, lsf_float3 direction,
                          double start, lsf_float3 *normal);

/* Largest distance of a point that is found from the reflective shadow map from its surface, at a
 * distance from the light: what gl_test_raster_step makes of it. */
float light_passes_raster_error(const light_passes *p, lsf_float3 normal, double distance);

/* Two numbers in [0, 1) of a sequence of the test's own. */
void light_passes_random(uint64_t index, uint64_t dimension, float point[2]);

#endif
