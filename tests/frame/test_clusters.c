/* Runs of triangles: nothing that reaches into a region is left out, what is far outside is, and
 * every triangle comes at most once. Needs no GL. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../scene/build_scene.h"
#include "frame/clusters.h"
#include "math/sampling.h"

/* A plane through a random point near the origin, n.p + w >= 0 inside. */
static void random_plane(float plane[4], uint64_t index)
{
    lsf_float3 n = lsf_sample_sphere(lsf_random_float(1, index), lsf_random_float(2, index));
    lsf_f3_store(plane, n);
    plane[3] = lsf_random_float(3, index) - 0.5f;
}

static float plane_value(const float plane[4], lsf_float3 p)
{
    return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z + plane[3];
}

static lsf_float3 corner_of(const lsf_scene *scene, const lsf_instance_state *instance,
                            uint32_t index)
{
    const float *v = scene->vertices.position + 3 * (size_t)scene->indices[index];
    const float *m = instance->transform;
    return lsf_f3(m[0] * v[0] + m[1] * v[1] + m[2] * v[2] + m[3],
                  m[4] * v[0] + m[5] * v[1] + m[6] * v[2] + m[7],
                  m[8] * v[0] + m[9] * v[1] + m[10] * v[2] + m[11]);
}

static void runs_hold_what_a_region_holds(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    lsf_node *sphere = build_sphere(scene, 5, false);
    sphere->scale[0] = 0.5;
    sphere->translation[1] = 0.2;
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    lsf_state state = {0};
    lsf_error error = {0};
    const lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    assert_true(lsf_state_update(&state, scene, &view, &error));
    lsf_clusters clusters;
    assert_true(lsf_clusters_init(&clusters, scene));
    const lsf_instance_state *instance = &state.instances[0];
    uint32_t count = scene->primitives[0].index_count;
    uint8_t *drawn = calloc(count / 3, 1);
    assert_non_null(drawn);
    uint64_t drawn_count = 0, inside_count = 0;
    for (uint64_t i = 0; i < 100; i++) {
        lsf_draw_region region = {.plane_count = 3};
        for (uint64_t k = 0; k < region.plane_count; k++)
            random_plane(region.planes[k], 3 * i + k);
        memset(drawn, 0, count / 3);
        lsf_cluster_walk walk = lsf_clusters_walk(&clusters, scene, instance, &region);
        while (lsf_clusters_next(&walk))
            for (uint32_t at = walk.first; at < walk.first + walk.count; at += 3) {
                assert_true(at < count);
                assert_int_equal(drawn[at / 3]++, 0);
                drawn_count++;
            }
        for (uint32_t at = 0; at < count; at++) {
            lsf_float3 p = corner_of(scene, instance, at);
            bool inside = true;
            for (uint32_t k = 0; k < region.plane_count; k++)
                inside = inside && plane_value(region.planes[k], p) >= 0.0f;
            inside_count += inside;
            assert_true(!inside || drawn[at / 3]);
        }
    }
    print_message("%.0f triangles drawn, %.0f inside\n", (double)drawn_count,
                  (double)inside_count / 3.0);
    assert_true(inside_count > 0 && drawn_count < 100 * (uint64_t)count / 3 / 2);
    lsf_cluster_walk all = lsf_clusters_walk(&clusters, scene, instance, NULL);
    assert_true(lsf_clusters_next(&all) && all.first == 0 && all.count == count);
    assert_false(lsf_clusters_next(&all));
    free(drawn);
    lsf_clusters_finish(&clusters);
    lsf_state_finish(&state);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_hold_what_a_region_holds),
    };
    return cmocka_run_group_tests_name("clusters", tests, NULL, NULL);
}
