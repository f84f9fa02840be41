/* Parts of a scene that lie far apart are told apart, and hold every triangle. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "scene/islands.h"

#include "build_scene.h"

static lsf_islands islands_of(lsf_scene *scene, lsf_state *state)
{
    lsf_islands islands;
    lsf_error error = {0};
    *state = (lsf_state){0};
    const lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    finish_scene(scene);
    if (!lsf_state_update(state, scene, &view, &error))
        fail_msg("%s", error.message);
    lsf_islands_find(&islands, scene, state);
    return islands;
}

/* Boxes in a row, with one mesh of all their triangles or one each. */
static void boxes_in_a_row(void **unused)
{
    (void)unused;
    static const struct {
        float spacing;
        int boxes;
        uint32_t islands;
    } rows[] = {{2.0f, 4, 1}, {2.5f, 2, 1}, {50.0f, 2, 2}, {50.0f, 4, 4}, {1e5f, 9, 5}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 1, 1, 1);
        for (int k = 0; k < rows[i].boxes; k++) {
            float x = powf(rows[i].boxes > 4 ? 3.0f : 1.0f, (float)k) * rows[i].spacing * (float)k;
            build_box(scene, lsf_f3(x - 1, x - 1, -1), lsf_f3(x + 1, x + 1, 1), false);
        }
        lsf_state state;
        lsf_islands islands = islands_of(scene, &state);
        assert_int_equal(islands.count, rows[i].islands);
        /* Each box lies in one island, but for those beyond the most there are. */
        for (uint32_t k = 0; k < state.instance_count; k++) {
            const lsf_instance_state *box = &state.instances[k];
            int holders = 0;
            for (uint32_t j = 0; j < islands.count; j++) {
                bool holds = true;
                for (int axis = 0; axis < 3; axis++)
                    holds = holds && islands.bounds[j][axis] <= box->bounds_min[axis] + 1e-7f &&
                            islands.bounds[j][3 + axis] >= box->bounds_max[axis] - 1e-7f;
                holders += holds;
            }
            assert_int_equal(holders, 1);
        }
        lsf_state_finish(&state);
        lsf_scene_destroy(scene);
    }
}

/* A stray triangle of the same mesh is found as one of another; a scene without any has no parts.
 */
static void stray_triangle(void **unused)
{
    (void)unused;
    const lsf_float3 corners[9] = {{0, 0, 0}, {1, 0, 0},     {0, 1, 1},     {1, 1, 0},    {0, 1, 0},
                                   {1, 0, 1}, {0, -1000, 0}, {1, -1000, 0}, {0, -1000, 1}};
    for (uint32_t triangles = 0; triangles <= 3; triangles++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 1, 1, 1);
        if (triangles > 0)
            build_triangles(scene, corners, triangles);
        lsf_state state;
        lsf_islands islands = islands_of(scene, &state);
        assert_int_equal(islands.count, triangles == 3 ? 2 : triangles > 0);
        if (triangles == 3)
            for (int axis = 0; axis < 3; axis++)
                assert_true(islands.bounds[0][3 + axis] - islands.bounds[0][axis] < 0.01f);
        lsf_state_finish(&state);
        lsf_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_in_a_row),
        cmocka_unit_test(stray_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
