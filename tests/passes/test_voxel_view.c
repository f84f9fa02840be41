/* Layers of voxels: what the grid holds is what the scene is, and lit as closed forms say. */
#include <math.h>

#include "render_gl.h"
#include "shared/brdf.h"

static lsf_scene *lit_floor(void)
{
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.25f, 0.75f);
    build_floor(scene, 0.0f, 1.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 1, 0), lsf_f3(0.6f, -0.8f, 0.0f), 2.0f);
    finish_gl_scene(scene);
    return scene;
}

static float channel_at(const lsf_image *image, const char *name, uint32_t pixel)
{
    int channel = lsf_image_channel(image, name);
    assert_true(channel >= 0);
    return image->pixels[pixel * image->channel_count + (uint32_t)channel];
}

/* Seen from above and from below, where the floor is dark. */
static void floor_of_voxels(const char *technique, float side)
{
    const float eye[3] = {0.3f, 2.0f * side, 0.4f}, target[3] = {0.1f, 0.0f, 0.0f};
    lsf_scene *scene = lit_floor();
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    params.technique = technique;
    params.width = params.height = 16;
    params.samples = 4;
    params.camera_position = eye;
    params.camera_target = target;
    params.fov_y = 20.0f;
    params.aovs = LSF_AOV_VOXEL_ALBEDO | LSF_AOV_VOXEL_NORMAL | LSF_AOV_VOXEL_RADIANCE;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    const float lit = side > 0.0f ? 0.8f * 2.0f / LSF_PI : 0.0f;
    for (uint32_t pixel = 0; pixel < 256; pixel++) {
        assert_true(fabsf(channel_at(image, "voxel_albedo.R", pixel) - 0.5f) < 1e-3f);
        assert_true(fabsf(channel_at(image, "voxel_albedo.G", pixel) - 0.25f) < 1e-3f);
        assert_true(fabsf(channel_at(image, "voxel_albedo.B", pixel) - 0.75f) < 2e-3f);
        assert_true(fabsf(channel_at(image, "voxel_normal.Y", pixel) - side) < 1e-3f);
        assert_true(fabsf(channel_at(image, "voxel_radiance.G", pixel) - 0.25f * lit) <
                    2e-3f * lit + 1e-6f);
    }
    lsf_image_destroy(image);
    destroy_scene(scene);
}

static void floors(void **unused)
{
    (void)unused;
    floor_of_voxels("cone", 1.0f);
    floor_of_voxels("cone", -1.0f);
    floor_of_voxels("voxel_path", 1.0f);
    floor_of_voxels("voxel_path", -1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(floors)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
