/* The grid of voxels holds the scene with room for its shift, whatever the scene's shape and the
 * resolution, and is as fine as memory allows. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "base/base.h"
#include "frame/voxel_grid.h"

static lsf_state box(float x, float y, float z)
{
    return (lsf_state){.reach_min = {-x, -y, -z}, .reach_max = {x, y, z}};
}

static void holds_the_scene(void **unused)
{
    (void)unused;
    static const float shapes[][3] = {{1, 1, 1},       {1, 0.3f, 0.1f},       {0.01f, 1, 0.01f},
                                      {0.7f, 0, 0.7f}, {0.51f, 0.51f, 1e-6f}, {1, 1e-3f, 0.999f}};
    const lsf_voxel_grid_use use = {.bytes = 32, .sides = 1};
    for (size_t shape = 0; shape < LSF_COUNT(shapes); shape++)
        for (int32_t resolution = 1; resolution <= 512; resolution++) {
            const float *extent = shapes[shape];
            const lsf_voxel_grid_params params = {.resolution = resolution, .memory = 1e6f};
            const lsf_state state = box(extent[0], extent[1], extent[2]);
            const lsf_voxel_grid grid = lsf_voxel_grid_fit(&params, &state, &use);
            assert_int_equal(grid.resolution, resolution);
            for (int axis = 0; axis < 3; axis++) {
                assert_int_equal(grid.size[axis] % 16, 0);
                /* Half a voxel beyond the shift's half on each side. */
                assert_true(grid.origin[axis] + 0.999f * grid.side <= -extent[axis]);
                float end = grid.origin[axis] + (float)grid.size[axis] * grid.side;
                assert_true(end - 0.999f * grid.side >= extent[axis]);
                assert_true(grid.size[axis] <= (uint32_t)(resolution + 2 + 15));
            }
        }
}

static void halves_resolution_until_it_fits(void **unused)
{
    (void)unused;
    const lsf_state state = box(1, 1, 1);
    const lsf_voxel_grid_params params = {.resolution = 512, .memory = 2048.0f};
    /* 512^3 voxels of 16 bytes are 2048 MiB; with a byte more they are too much. */
    lsf_voxel_grid_use use = {.bytes = 16, .sides = 1};
    assert_int_equal(lsf_voxel_grid_fit(&params, &state, &use).resolution, 512);
    use.bytes = 17;
    assert_int_equal(lsf_voxel_grid_fit(&params, &state, &use).resolution, 256);
    /* Six slices of 512 are deeper than 2048. */
    use = (lsf_voxel_grid_use){.bytes = 1, .sides = 6};
    assert_int_equal(lsf_voxel_grid_fit(&params, &state, &use).resolution, 256);
    use.sides = 4;
    assert_int_equal(lsf_voxel_grid_fit(&params, &state, &use).resolution, 512);
    /* Nothing fits: the coarsest. */
    use.bytes = UINT32_MAX;
    assert_int_equal(lsf_voxel_grid_fit(&params, &state, &use).resolution, 1);
}

static void unit_follows_light(void **unused)
{
    (void)unused;
    const lsf_scene scene = {0};
    lsf_light_state light = {.intensity = {0.0f, 3.0f, 0.0f}};
    lsf_state state = {.light_count = 1, .lights = &light};
    lsf_voxel_grid grid = {0};
    for (int k = -100; k <= 100; k++) {
        light.intensity[1] = ldexpf(3.0f, k);
        lsf_voxel_grid_set_unit(&grid, &scene, &state);
        assert_true(grid.unit == ldexpf(4.0f, k));
    }
    state.light_count = 0;
    lsf_voxel_grid_set_unit(&grid, &scene, &state);
    assert_true(grid.unit == 1.0f);
}

static void an_empty_scene_has_a_grid(void **unused)
{
    (void)unused;
    const lsf_state state = {.bounds_min = {INFINITY, INFINITY, INFINITY},
                             .bounds_max = {-INFINITY, -INFINITY, -INFINITY}};
    const lsf_voxel_grid_use use = {.bytes = 32, .sides = 1};
    const lsf_voxel_grid_params params = {.resolution = 64, .memory = 1e6f};
    const lsf_voxel_grid grid = lsf_voxel_grid_fit(&params, &state, &use);
    for (int axis = 0; axis < 3; axis++) {
        assert_int_equal(grid.size[axis], 16);
        assert_true(isfinite(grid.origin[axis]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holds_the_scene),
        cmocka_unit_test(halves_resolution_until_it_fits),
        cmocka_unit_test(unit_follows_light),
        cmocka_unit_test(an_empty_scene_has_a_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
