/* Light that comes through walls: a sealed dark room beside a lit one. In truth the dark room is
 * black; what arrives there is told relative to the lit room. */
#include <math.h>

#include "render_gl.h"

#define RESOLUTION 64

/* Two rooms of 2 x 2 x 2 with a wall of `thickness` voxels between them, and a lamp in the left
 * one. */
static lsf_scene *two_rooms(float thickness, bool lamp)
{
    /* The wall keeps its thickness in voxels: (4 + t) / (N - 2) is a voxel's side. */
    float side = 4.0f / ((float)RESOLUTION - 2.0f - thickness);
    float half = 0.5f * thickness * side;
    lsf_scene *scene = build_scene();
    build_material(scene, 0.7f, 0.7f, 0.7f);
    build_box(scene, lsf_f3(-2 - half, -1, -1), lsf_f3(-half, 1, 1), true);
    build_box(scene, lsf_f3(half, -1, -1), lsf_f3(2 + half, 1, 1), true);
    if (lamp) {
        lsf_material *material = build_material(scene, 0.7f, 0.7f, 0.7f);
        for (int c = 0; c < 3; c++)
            material->emission[c] = 4.0f;
        material->double_sided = true;
        build_quad(scene, lsf_f3(-1.3f, 0.5f, -0.4f), lsf_f3(-0.3f, 0.5f, -0.4f),
                   lsf_f3(-0.3f, 0.9f, 0.4f), lsf_f3(-1.3f, 0.9f, 0.4f));
    } else {
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(-0.8f, 0.3f, 0.1f), lsf_f3(0, -1, 0), 1.0f);
    }
    finish_gl_scene(scene);
    return scene;
}

/* Where light comes from, and by how many bounces. */
typedef struct way {
    const char *technique, *option[2];
    uint32_t bounces;
    bool lamp; /* a surface instead of a point */
} way;

static double room_light(const way *w, const lsf_scene *scene, float room)
{
    /* Towards the wall between the rooms, and its edges. */
    const float eye[3] = {1.9f * room, 0.4f, -0.8f}, target[3] = {0.0f, -0.4f, 0.5f};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    const char *options[3] = {"voxel.resolution=64", w->option[0], w->option[1]};
    params.technique = w->technique;
    params.width = params.height = 32;
    params.samples = getenv("LSF_TEST_QUICK") ? 2 : 8;
    params.bounces = w->bounces;
    params.camera_position = eye;
    params.camera_target = target;
    params.fov_y = 80.0f;
    params.options = options;
    params.option_count = w->option[1] ? 3 : w->option[0] ? 2 : 1;
    lsf_image *image = render_gl(gl_test_backend(), scene, &params);
    double sum = 0.0;
    for (uint32_t i = 0; i < image->width * image->height; i++)
        sum += (double)image->pixels[i * image->channel_count + 1];
    lsf_image_destroy(image);
    return sum / (32.0 * 32.0);
}

static double leak(const way *w, float thickness)
{
    lsf_scene *scene = two_rooms(thickness, w->lamp);
    double lit = room_light(w, scene, -1.0f), dark = room_light(w, scene, 1.0f);
    destroy_scene(scene);
    assert_true(lit > 0.01);
    print_message("%s%s %s %s, wall of %g voxels, %u bounces: %.2e of the lit room's light\n",
                  w->technique, w->lamp ? ", a lamp" : "", w->option[0] ? w->option[0] : "",
                  w->option[1] ? w->option[1] : "", (double)thickness, w->bounces, dark / lit);
    return dark / lit;
}

static const float walls[] = {0.5f, 1.0f, 2.0f, 4.0f};

/* Voxels that look the same from both sides let light through, and so do wide cones where a texel
 * of the pyramid reaches through the wall; cones that end where their axis meets a voxel do not. */
static void cones(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < 4; i++) {
        double isotropic =
            leak(&(way){"cone", {"cone.sealed=off", "cone.sides=isotropic"}, 2, false}, walls[i]);
        double anisotropic = leak(&(way){"cone", {"cone.sealed=off"}, 2, false}, walls[i]);
        double sealed = leak(&(way){"cone", {NULL}, 2, false}, walls[i]);
        assert_true(anisotropic < isotropic);
        assert_true(sealed <= (walls[i] < 1.0f ? 2e-4 : 1e-4));
    }
}

/* Two bounces more, from voxel to voxel. */
static void bounces_of_cones(void **unused)
{
    (void)unused;
    assert_true(leak(&(way){"cone", {NULL}, 4, false}, 2.0f) <= 1e-4);
}

static void paths(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < 4; i++)
        for (int lamp = 0; lamp < 2; lamp++)
            assert_true(leak(&(way){"voxel_path", {NULL}, 2, lamp}, walls[i]) <=
                        (walls[i] < 2.0f ? 1e-3 : 1e-4));
}

/* A lamp in a closed shell of no thickness: a sphere, whose facets no two voxels hold alike, or a
 * box, along whose edges voxels hold one of two sides. What of its direct light is outside. */
static void shells(void **unused)
{
    (void)unused;
    static const char *const names[] = {"nothing", "a sphere", "a box"};
    double light[3];
    for (int shell = 0; shell < 3; shell++) {
        lsf_scene *scene = build_scene();
        /* The camera sees the shells from outside. */
        build_material(scene, 0.7f, 0.7f, 0.7f)->double_sided = true;
        build_box(scene, lsf_f3(-2, -2, -2), lsf_f3(2, 2, 2), true);
        if (shell == 1)
            build_sphere(scene, 3, true);
        if (shell == 2)
            build_box(scene, lsf_f3(-0.7f, -0.65f, -0.73f), lsf_f3(0.71f, 0.72f, 0.68f), true);
        lsf_material *material = build_material(scene, 0.7f, 0.7f, 0.7f);
        material->emission[0] = material->emission[1] = material->emission[2] = 4.0f;
        material->double_sided = true;
        build_quad(scene, lsf_f3(-0.3f, 0.4f, -0.4f), lsf_f3(0.3f, 0.4f, -0.4f),
                   lsf_f3(0.3f, 0.1f, 0.4f), lsf_f3(-0.3f, 0.1f, 0.4f));
        finish_gl_scene(scene);
        light[shell] = room_light(&(way){"voxel_path", {NULL}, 0, true}, scene, 1.0f);
        destroy_scene(scene);
        print_message("%s lets %.2e of a lamp's direct light through\n", names[shell],
                      light[shell] / light[0]);
        assert_true(shell == 0 || light[shell] <= 1e-4 * light[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cones), cmocka_unit_test(bounces_of_cones),
                                       cmocka_unit_test(paths), cmocka_unit_test(shells)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
