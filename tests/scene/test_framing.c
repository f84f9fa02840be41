/* The camera that frames a scene shows all of it, and no more than it has to. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "scene/hierarchy.h"
#include "scene/state.h"

#include "build_scene.h"

/* In the axes of the default camera of loaded files; any unit axes would do. */
static void turn_camera(lsf_scene *scene)
{
    const double back[3] = {0.48, 0.36, 0.8}, length = hypot(0.48, 0.8);
    const double right[3] = {0.8 / length, 0, -0.48 / length};
    lsf_camera *camera = &scene->cameras[0];
    camera->frames_scene = true;
    for (int c = 0; c < 3; c++) {
        int next = (c + 1) % 3, last = (c + 2) % 3;
        camera->matrix[c] = right[c];
        camera->matrix[4 + c] = back[next] * right[last] - back[last] * right[next];
        camera->matrix[8 + c] = back[c];
    }
}

static lsf_float3 camera_position(const lsf_camera_state *camera)
{
    return lsf_f3_mad(lsf_f3_load(camera->start), lsf_f3_load(camera->forward),
                      -camera->start_depth);
}

/* Widest x and y of the scene's vertices in the picture, where -1 and 1 are its borders, at `time`
 * as seen by the camera of a picture of that aspect. */
static void extent(const lsf_scene *scene, float aspect, double time, double low[2], double high[2])
{
    lsf_state state = {0};
    lsf_view_params view = {.time = time, .fov_y = NAN, .aspect = aspect};
    assert_true(lsf_state_update(&state, scene, &view, NULL));
    const lsf_camera_state *camera = &state.camera;
    low[0] = low[1] = INFINITY;
    high[0] = high[1] = -INFINITY;
    for (uint32_t i = 0; i < state.instance_count; i++) {
        const lsf_instance_state *instance = &state.instances[i];
        const lsf_primitive *primitive = &scene->primitives[instance->primitive];
        const float *m = instance->transform;
        for (uint32_t j = 0; j < primitive->index_count; j++) {
            const float *p =
                scene->vertices.position + 3 * scene->indices[primitive->first_index + j];
            lsf_float3 at = lsf_f3(m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
                                   m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
                                   m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]);
            lsf_float3 to = lsf_f3_sub(at, camera_position(camera));
            float depth = lsf_f3_dot(to, lsf_f3_load(camera->forward));
            assert_true(depth > camera->near_plane + camera->start_depth);
            for (int axis = 0; axis < 2; axis++) {
                lsf_float3 edge = lsf_f3_load(axis ? camera->forward_dy : camera->forward_dx);
                double x = (double)(lsf_f3_dot(to, edge) / lsf_f3_dot(edge, edge) / depth);
                low[axis] = fmin(low[axis], x);
                high[axis] = fmax(high[axis], x);
            }
        }
    }
    lsf_state_finish(&state);
}

/* Fills 95 % of the width or of the height, is centred in both, and leaves nothing out. */
static void assert_fills(const lsf_scene *scene, float aspect)
{
    double low[2], high[2], largest = 0;
    extent(scene, aspect, 0, low, high);
    for (int axis = 0; axis < 2; axis++)
        largest = fmax(largest, fmax(-low[axis], high[axis]));
    assert_true(fabs(largest - 0.95) < 1e-4);
    /* Where it decides, both borders are met alike. */
    assert_true(fabs(high[0] + low[0]) < 1e-4 || fabs(high[1] + low[1]) < 1e-4);
}

static void test_any_shape_in_any_aspect(void **state)
{
    (void)state;
    const lsf_float3 sizes[] = {
        {1, 1, 1}, {10, 0.1f, 1}, {0.1f, 8, 0.1f}, {0.01f, 1, 30}, {3, 3, 0}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        lsf_float3 at = lsf_f3(100, -7, 3), half = sizes[i];
        lsf_scene *scene = build_scene();
        turn_camera(scene);
        build_material(scene, 1, 1, 1);
        build_box(scene, lsf_f3_sub(at, half), lsf_f3_add(at, half), false);
        finish_scene(scene);
        for (float aspect = 0.2f; aspect < 6; aspect *= 1.7f)
            assert_fills(scene, aspect);
        destroy_scene(scene);
    }
    /* A sphere is not framed as its box is. */
    lsf_scene *scene = build_scene();
    turn_camera(scene);
    build_material(scene, 1, 1, 1);
    build_sphere(scene, 3, false);
    finish_scene(scene);
    assert_fills(scene, 1);
    assert_fills(scene, 0.5f);
    destroy_scene(scene);
}

/* Three keys of a translation: out to the right and back. */
static void test_all_of_an_animation(void **state)
{
    (void)state;
    static const float times[] = {1, 2, 3}, values[] = {0, 0, 0, 5, 1, 0, 0, 0, 0};
    lsf_scene *scene = build_scene();
    turn_camera(scene);
    build_material(scene, 1, 1, 1);
    lsf_node *node = build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), false);
    finish_scene(scene);
    lsf_animation_channel *channel = calloc(1, sizeof *channel);
    *channel = (lsf_animation_channel){
        .node = (uint32_t)(node - scene->nodes),
        .path = LSF_PATH_TRANSLATION,
        .curve = {.interpolation = LSF_LINEAR,
                  .key_count = 3,
                  .width = 3,
                  .times = malloc(sizeof times),
                  .values = malloc(sizeof values)},
    };
    for (int i = 0; i < 3; i++)
        channel->curve.times[i] = times[i];
    for (int i = 0; i < 9; i++)
        channel->curve.values[i] = values[i];
    scene->channels = channel;
    scene->channel_count = 1;
    node->has_matrix = false;
    node->rotation[3] = 1;
    for (int c = 0; c < 3; c++)
        node->scale[c] = 1;

    double least[2] = {0, 0}, most[2] = {0, 0};
    for (double time = 0; time < 4; time += 0.125) {
        double low[2], high[2];
        extent(scene, 1.5f, time, low, high);
        for (int axis = 0; axis < 2; axis++) {
            least[axis] = fmin(least[axis], low[axis]);
            most[axis] = fmax(most[axis], high[axis]);
        }
    }
    double largest = fmax(fmax(-least[0], most[0]), fmax(-least[1], most[1]));
    assert_true(fabs(largest - 0.95) < 1e-4);
    destroy_scene(scene);
}

static void test_nothing_to_frame(void **state)
{
    (void)state;
    lsf_scene *scene = build_scene();
    turn_camera(scene);
    finish_scene(scene);
    lsf_state now = {0};
    lsf_view_params view = {.fov_y = NAN, .aspect = 1};
    assert_true(lsf_state_update(&now, scene, &view, NULL));
    float distance = lsf_f3_length(camera_position(&now.camera));
    assert_true(isfinite(distance) && distance > 1);
    lsf_state_finish(&now);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_any_shape_in_any_aspect),
        cmocka_unit_test(test_all_of_an_animation),
        cmocka_unit_test(test_nothing_to_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
