/* Closest hits of many rays at once are those of rays traced one by one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../scene/build_scene.h"
#include "math/sampling.h"
#include "reference/geometry.h"
#include "reference/module.h"

enum { RAYS = 3001 }; /* no multiple of any packet */

/* A sphere between a floor and a lid with holes. */
static lsf_scene *holed_scene(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_sphere(scene, 2, false);
    build_quad(scene, lsf_f3(-2, -2, 2), lsf_f3(2, -2, 2), lsf_f3(2, -2, -2), lsf_f3(-2, -2, -2));
    static const uint8_t texels[16] = {255, 255, 255, 255, 255, 255, 255, 0,
                                       255, 255, 255, 0,   255, 255, 255, 255};
    lsf_material *lid = build_material(scene, 1, 1, 1);
    lid->alpha_mode = LSF_ALPHA_MASK;
    lid->base_color_texture.texture = build_texture(scene, 2, 2, 4, texels, false);
    build_quad(scene, lsf_f3(-2, 2, 2), lsf_f3(-2, 2, -2), lsf_f3(2, 2, -2), lsf_f3(2, 2, 2));
    scene->vertices.uv0 = calloc(scene->vertices.count, 8);
    for (uint64_t i = 0; i < scene->vertices.count; i++) {
        scene->vertices.uv0[2 * i] = scene->vertices.position[3 * i] * 0.25f + 0.5f;
        scene->vertices.uv0[2 * i + 1] = scene->vertices.position[3 * i + 2] * 0.25f + 0.5f;
    }
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    return scene;
}

static void hits_are_those_of_single_rays(void **unused)
{
    (void)unused;
    const float near = 0x1p-14f;
    lsf_error error = {0};
    lsf_scene *scene = holed_scene();
    lsf_state state = {0};
    lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    assert_true(lsf_state_update(&state, scene, &view, &error));
    lsf_reference_geometry geometry;
    assert_true(
        lsf_reference_geometry_init(&geometry, scene, &state, LSF_REFERENCE_USE_PICTURE, &error));
    lsf_reference_ray *rays = calloc(RAYS, sizeof *rays);
    float *distances = calloc(RAYS, sizeof *distances);
    for (uint32_t i = 0; i < RAYS; i++) {
        float u[2], v[2];
        lsf_sobol_2d(i, 1, u);
        lsf_sobol_2d(i, 2, v);
        lsf_float3 direction = lsf_f3_normalize(lsf_f3(u[0] - 0.5f, u[1] - 0.5f, v[0] - 0.5f));
        lsf_f3_store(rays[i].direction, direction);
        lsf_f3_store(rays[i].origin, lsf_f3(v[1] - 0.5f, 0.7f, u[0] - 0.5f));
    }
    lsf_reference_tracer *tracer = lsf_reference_module_rays.create(scene, &state, &error);
    assert_non_null(tracer);
    double seconds = -1.0;
    uint32_t missed = 0;
    assert_true(
        lsf_reference_module_rays.trace(tracer, rays, RAYS, near, distances, &seconds, &error));
    assert_true(seconds >= 0.0);
    for (uint32_t i = 0; i < RAYS; i++) {
        lsf_reference_hit hit = {.distance = INFINITY};
        lsf_reference_trace(&geometry, lsf_f3_load(rays[i].origin), lsf_f3_load(rays[i].direction),
                            near, INFINITY, (lsf_reference_chance){0, 0}, &hit);
        missed += isinf(hit.distance) != 0;
        /* Trees of other shapes round other corners: a ray at an edge may go either way. */
        if (isinf(hit.distance) || isinf(distances[i]))
            assert_true(hit.distance == distances[i]);
        else
            assert_true(fabsf(hit.distance - distances[i]) <= 1e-4f);
    }
    assert_in_range(missed, RAYS / 5, 4 * RAYS / 5);
    assert_non_null(strstr(lsf_reference_module_rays.kernel(tracer), "rtcIntersect"));
    lsf_reference_module_rays.destroy(tracer);
    lsf_reference_module_rays.destroy(NULL);
    lsf_reference_geometry_finish(&geometry);
    lsf_state_finish(&state);
    free(rays);
    free(distances);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(hits_are_those_of_single_rays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
