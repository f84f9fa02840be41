/* Skins and morph targets, against closed forms. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define GLTF_SCRIPT "gltf_deform_files.py"
#include "gltf_cases.h"
#include "load_gltf.h"
#include "scene/state.h"
#include "scene/tessellate.h"

#include <math.h>

#define HALF 0.70710678f

static void update(lsf_state *state, const lsf_scene *scene, double time)
{
    lsf_error error = {0};
    const lsf_view_params view = {.time = time, .fov_y = NAN, .aspect = 1.0f};
    if (!lsf_state_update(state, scene, &view, &error))
        fail_msg("%s", error.message);
}

/* Where an instance shows a vertex of its primitive, in scene units, and its normal there. */
static void assert_vertex(const lsf_scene *scene, const lsf_state *state, uint32_t instance,
                          uint32_t vertex, const float position[3], const float normal[3])
{
    const lsf_instance_state *placed = &state->instances[instance];
    size_t at = scene->primitives[placed->primitive].first_vertex + vertex;
    const float *p = state->pose.vertices.position + 3 * at;
    const float *n = state->pose.vertices.normal + 3 * at;
    float turned[3], length = 0.0f;
    for (int row = 0; row < 3; row++) {
        const float *m = placed->transform + 4 * row, *t = placed->normal_transform + 3 * row;
        double shown = (double)(m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3]);
        shown = shown / state->scale + state->center[row];
        if (!(fabs(shown - (double)position[row]) < 1e-5))
            fail_msg("vertex %u, coordinate %d: %g instead of %g", vertex, row, shown,
                     (double)position[row]);
        turned[row] = t[0] * n[0] + t[1] * n[1] + t[2] * n[2];
        length += turned[row] * turned[row];
    }
    for (int row = 0; row < 3; row++)
        if (!(fabsf(turned[row] / sqrtf(length) - normal[row]) < 1e-5f))
            fail_msg("vertex %u, normal %d: %g instead of %g", vertex, row,
                     (double)(turned[row] / sqrtf(length)), (double)normal[row]);
}

/* Joint 1 has turned by a quarter about x: what it holds lies along z. Halfway between joints the
 * mean of both matrices has turned by an eighth, and shrunk. */
static void assert_bent(const char *name, float side)
{
    lsf_scene *scene = load(name);
    lsf_state state = {0};
    const float up[3] = {0, 0, 1}, between[3] = {0, -HALF, HALF}, down[3] = {0, -1, 0};
    update(&state, scene, 0.0);
    assert_vertex(scene, &state, 0, 0, (float[]){-0.5f * side, 0, 0}, up);
    assert_vertex(scene, &state, 0, 3, (float[]){0.5f * side, 1, 0}, up);
    assert_vertex(scene, &state, 0, 5, (float[]){0.5f * side, 2, 0}, up);
    update(&state, scene, 1.0);
    assert_vertex(scene, &state, 0, 0, (float[]){-0.5f * side, 0, 0}, up);
    assert_vertex(scene, &state, 0, 3, (float[]){0.5f * side, 1, 0}, between);
    assert_vertex(scene, &state, 0, 5, (float[]){0.5f * side, 1, 1}, down);
    assert_true(state.instances[0].mirrored == (side < 0.0f));
    const lsf_instance_state *placed = &state.instances[0];
    assert_true(fabs((double)placed->bounds_max[2] / state.scale + state.center[2] - 1.0) < 1e-5);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

static void test_strip_is_bent(void **unused)
{
    (void)unused;
    assert_bent("strip.gltf", 1.0f);
    assert_bent("strip_scaled.gltf", 1.0f);
    assert_bent("strip_mirrored.gltf", -1.0f);
}

static void test_bytes_weigh_as_floats(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip_bytes.gltf");
    lsf_state state = {0};
    update(&state, scene, 1.0);
    assert_vertex(scene, &state, 0, 4, (float[]){-0.5f, 1, 1}, (float[]){0, -1, 0});
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

/* The upper part is bent about its joint's own origin, and moved up with it. */
static void test_without_inverse_bind_matrices(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip_unbound.gltf");
    lsf_state state = {0};
    update(&state, scene, 1.0);
    assert_vertex(scene, &state, 0, 5, (float[]){0.5f, 1, 2}, (float[]){0, -1, 0});
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

/* Without normals of its own, each triangle has that of where it comes to lie. */
static void test_flat_normals_follow(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip_flat.gltf");
    lsf_state state = {0};
    update(&state, scene, 1.0);
    assert_vertex(scene, &state, 0, 6, (float[]){-0.5f, 1, 0}, (float[]){0, -1, 0});
    assert_vertex(scene, &state, 0, 0, (float[]){-0.5f, 0, 0}, (float[]){0, 0, 1});
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

/* A node with the skin, and one without: each has vertices of its own. */
static void test_a_mesh_with_and_without_skin(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip_twice.gltf");
    lsf_state state = {0};
    assert_int_equal(scene->vertices.count, 12);
    update(&state, scene, 1.0);
    assert_vertex(scene, &state, 0, 5, (float[]){0.5f, 1, 1}, (float[]){0, -1, 0});
    assert_vertex(scene, &state, 1, 5, (float[]){7.5f, 2, 0}, (float[]){0, 0, 1});
    bool moves[2];
    assert_true(lsf_scene_moving_instances(scene, moves));
    assert_true(moves[0] && !moves[1]);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

static void test_targets_add_up(void **unused)
{
    (void)unused;
    const float slanted[3] = {HALF, 0, HALF};
    lsf_scene *scene = load("morph_still.gltf");
    lsf_state state = {0};
    update(&state, scene, 0.0);
    assert_false(scene->requirements.moving);
    assert_vertex(scene, &state, 0, 0, (float[]){1, 0, 0}, slanted);
    assert_vertex(scene, &state, 0, 2, (float[]){2, 1, 0.25f}, slanted);
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);

    scene = load("morph_node.gltf");
    state = (lsf_state){0};
    update(&state, scene, 0.0);
    assert_vertex(scene, &state, 0, 2, (float[]){1, 1, 1}, (float[]){0, 0, 1});
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

static void test_weights_are_animated(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("morph.gltf");
    lsf_state state = {0};
    assert_true(scene->requirements.moving && scene->requirements.morphed);
    update(&state, scene, 0.0);
    assert_vertex(scene, &state, 0, 2, (float[]){1, 1, 0}, (float[]){0, 0, 1});
    update(&state, scene, 0.5);
    assert_vertex(scene, &state, 0, 2, (float[]){2, 1, 0}, (float[]){HALF, 0, HALF});
    update(&state, scene, 9.0);
    assert_vertex(scene, &state, 0, 2, (float[]){3, 1, 0}, (float[]){1, 0, 0});
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

/* What is framed, and what voxels reach, is where the vertices come to be. */
static void test_reach_holds_all_poses(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip.gltf");
    lsf_state state = {0};
    update(&state, scene, 0.0);
    assert_true((double)state.reach_max[2] / state.scale + state.center[2] >= 1.0);
    assert_true((double)state.bounds_max[2] / state.scale + state.center[2] < 1e-6);
    assert_true(fabs(state.center[0]) < 1e-9); /* the node of the mesh places nothing */
    lsf_state_finish(&state);
    lsf_scene_destroy(scene);
}

/* Deformed triangles are not divided, and bend as before. */
static void test_tessellated_scenes_bend(void **unused)
{
    (void)unused;
    lsf_scene *scene = load("strip_twice.gltf");
    lsf_error error = {0};
    lsf_scene *fine = lsf_scene_tessellate(scene, 2, 1.0f, &error);
    assert_non_null(fine);
    lsf_state state = {0};
    update(&state, fine, 1.0);
    assert_int_equal(fine->requirements.triangles, 4 + 4 * 4);
    assert_vertex(fine, &state, 0, 5, (float[]){0.5f, 1, 1}, (float[]){0, -1, 0});
    lsf_state_finish(&state);
    lsf_scene_tessellated_destroy(fine);
    lsf_scene_destroy(scene);
}

int main(void)
{
    static size_t cases_min = 30;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_cases, &cases_min),
        cmocka_unit_test(test_strip_is_bent),
        cmocka_unit_test(test_bytes_weigh_as_floats),
        cmocka_unit_test(test_without_inverse_bind_matrices),
        cmocka_unit_test(test_flat_normals_follow),
        cmocka_unit_test(test_a_mesh_with_and_without_skin),
        cmocka_unit_test(test_targets_add_up),
        cmocka_unit_test(test_weights_are_animated),
        cmocka_unit_test(test_reach_holds_all_poses),
        cmocka_unit_test(test_tessellated_scenes_bend),
    };
    return cmocka_run_group_tests_name("gltf deform", tests, make_gltf_folder, remove_gltf_folder);
}
