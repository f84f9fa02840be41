/* Ray-bundles: lists that hold every fragment, and searches that find the nearest, whatever the
 * order. */
#include <math.h>

#include "bundle_rig.h"

static const float eye[3] = {0.3f, 0.5f, 2.9f}, target[3] = {0, 0, 0};

static lsf_render_params view_params(uint32_t width, uint32_t height)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = width;
    params.height = height;
    params.camera_position = eye;
    params.camera_target = target;
    params.fov_y = 50.0f;
    return params;
}

/* A box seen from inside: every ray meets its far walls, at a distance in closed form. */
static void box_from_inside(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_box(scene, lsf_f3(-1, -1, -3), lsf_f3(1, 1, 3), true);
    finish_gl_scene(scene);
    const lsf_render_params view = view_params(64, 48);
    const lsf_ray_bundle_params params = {LSF_RAY_BUNDLE_PARAMS_DEFAULTS};
    const lsf_float3 direction = lsf_f3(0.48f, 0.64f, 0.6f);
    bundle_rig rig;
    bundle_rig_run(&rig, scene, &view, &params, direction);
    uint32_t right = 0, seen = 0;
    for (uint32_t y = 0; y < rig.height; y++)
        for (uint32_t x = 0; x < rig.width; x++) {
            lsf_float3 p, n;
            if (!bundle_rig_origin(&rig, x, y, &p, &n))
                continue;
            seen++;
            float sign = lsf_f3_dot(n, direction) > 0.0f ? 1.0f : -1.0f, expected = INFINITY;
            const float at[3] = {p.x, p.y, p.z};
            const float along[3] = {sign * direction.x, sign * direction.y, sign * direction.z};
            const float *high = rig.setup.state.bounds_max, *low = rig.setup.state.bounds_min;
            for (int axis = 0; axis < 3; axis++) {
                float wall = along[axis] > 0.0f ? high[axis] : low[axis];
                float t = (wall - at[axis]) / along[axis];
                expected = t > 1e-4f ? fminf(expected, t) : expected;
            }
            uint32_t node;
            float distance = bundle_rig_distance(&rig, x, y, &node);
            right += fabsf(distance - expected) < 0.01f * expected + 0.01f;
        }
    print_message("%u of %u right, %llu nodes\n", right, seen,
                  (unsigned long long)lsf_ray_bundle_counts(rig.bundle)[LSF_RAY_BUNDLE_NODES]);
    assert_true(seen == rig.width * rig.height && right > 0.97 * seen);
    bundle_rig_finish(&rig);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_from_inside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
