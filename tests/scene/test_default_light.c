/* When the default sky and key light are added, and how bright they are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/default_light.h"
#include "scene/emitted_light.h"

#include "build_scene.h"

static void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g", value, expected);
}

static lsf_material *build_emitter(lsf_scene *scene, float radiance)
{
    lsf_material *material = build_material(scene, 0, 0, 0);
    for (int c = 0; c < 3; c++)
        material->emission[c] = radiance;
    return material;
}

static float emitted_light(lsf_scene *scene)
{
    lsf_state state = {0};
    lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    finish_scene(scene);
    assert_true(lsf_state_update(&state, scene, &view, NULL));
    lsf_seen *seen = lsf_seen_create(scene, &state);
    assert_non_null(seen);
    float median = lsf_emitted_light(scene, &state, seen);
    lsf_seen_free(seen);
    lsf_state_finish(&state);
    return median;
}

/* The camera looks down from y = 4 at the square that reaches from -half to half in x and z. */
static void look_down(lsf_scene *scene, float half)
{
    lsf_camera *camera = &scene->cameras[0];
    const double matrix[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 4, 0, 1};
    camera->orthographic = true;
    camera->x_magnification = camera->y_magnification = half;
    memcpy(camera->matrix, matrix, sizeof matrix);
}

/* A unit square, seen from above, below a square lamp of area 0.01 that shines down, one unit above
 * its centre. White, the floor has the luminance L 0.01/pi / (1 + r^2)^2 at the distance r from the
 * foot, but for the lamp's size. Half of the floor lies nearer than r = sqrt(0.5 / pi). */
#define LAMP_SHARE (0.01 / M_PI / pow(1 + 0.5 / M_PI, 2))
static void build_lamp(lsf_scene *scene, float radiance)
{
    build_material(scene, 1, 1, 1);
    build_floor(scene, 0, 0.5f);
    build_emitter(scene, radiance);
    build_quad(scene, lsf_f3(-0.05f, 1, -0.05f), lsf_f3(0.05f, 1, -0.05f), lsf_f3(0.05f, 1, 0.05f),
               lsf_f3(-0.05f, 1, 0.05f));
    look_down(scene, 0.5f);
}

static void test_emitted_light_has_closed_forms(void **state)
{
    (void)state;
    lsf_scene *scene = build_scene();
    build_lamp(scene, 3);
    assert_near((double)emitted_light(scene), 3 * LAMP_SHARE, 0.03 * 3 * LAMP_SHARE);
    destroy_scene(scene);

    /* Every point of a closed box that glows from all sides, of which the camera sees the floor,
     * has radiance 2 all around it. */
    scene = build_scene();
    build_emitter(scene, 2);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    look_down(scene, 1);
    assert_near((double)emitted_light(scene), 1.85,
                0.2); /* noise puts the median a little below the mean */
    destroy_scene(scene);

    /* A convex thing cannot light itself, however strongly it glows; nor does what glows in a shell
     * light what is seen of it. */
    scene = build_scene();
    build_emitter(scene, 1000);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), false);
    build_box(scene, lsf_f3(-0.9f, -0.9f, -0.9f), lsf_f3(0.9f, 0.9f, 0.9f), true);
    look_down(scene, 1);
    assert_near((double)emitted_light(scene), 0, 0);
    destroy_scene(scene);
}

/* The key light, and the sky where no environment was there before. */
static void assert_added(lsf_scene *scene, lsf_default_light mode, bool key, bool sky)
{
    lsf_scene_compute_requirements(scene);
    assert_true(lsf_default_light_add(scene, mode, NULL));
    assert_int_equal(scene->key_light.present, key);
    assert_int_equal(scene->environment.by_default, sky);
    assert_int_equal(scene->requirements.directional_lights, key);
    assert_int_equal(scene->note_count, key && mode == LSF_DEFAULT_LIGHT_AUTO);
    for (uint32_t i = 0; i < scene->note_count; i++)
        free(scene->notes[i]);
    free(scene->notes);
    destroy_scene(scene);
}

static lsf_scene *build_sphere_scene(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_sphere(scene, 1, false);
    return scene;
}

static void test_rule(void **state)
{
    (void)state;
    assert_added(build_sphere_scene(), LSF_DEFAULT_LIGHT_AUTO, true, true);
    assert_added(build_sphere_scene(), LSF_DEFAULT_LIGHT_NEVER, false, false);

    lsf_scene *scene = build_sphere_scene();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 3, 0), lsf_f3(0, -1, 0), 1);
    assert_added(scene, LSF_DEFAULT_LIGHT_AUTO, false, false);

    for (int always = 0; always < 2; always++) {
        scene = build_sphere_scene();
        build_environment(scene, 0); /* black because somebody wants it black */
        assert_added(scene, always ? LSF_DEFAULT_LIGHT_ALWAYS : LSF_DEFAULT_LIGHT_AUTO, always,
                     false);
    }

    scene = build_sphere_scene(); /* a dial that glows */
    build_emitter(scene, 10);
    build_box(scene, lsf_f3(-0.1f, -0.1f, 0.99f), lsf_f3(0.1f, 0.1f, 1.01f), false);
    assert_added(scene, LSF_DEFAULT_LIGHT_AUTO, true, true);
}

/* On both sides of the threshold, by the closed form above. */
static void test_emitters_count_when_they_light(void **state)
{
    (void)state;
    float threshold = (float)((double)LSF_LIT_LUMINANCE_MIN / LAMP_SHARE);
    for (int enough = 0; enough < 2; enough++) {
        lsf_scene *scene = build_scene();
        build_lamp(scene, (enough ? 1.05f : 0.95f) * threshold);
        assert_added(scene, LSF_DEFAULT_LIGHT_AUTO, !enough, !enough);
    }
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of a box's floor at y = -1: the median of I cos / r^2. */
static double median_irradiance_of_floor(const lsf_default_lamp *lamp)
{
    enum { STEPS = 100 };
    double each[STEPS * STEPS], height = lamp->position[1] + 1;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double x = 2 * (i % STEPS + 0.5) / STEPS - 1 - lamp->position[0];
        double z = 2 * (i / STEPS + 0.5) / STEPS - 1 - lamp->position[2];
        each[i] = (double)lamp->intensity * height / pow(x * x + z * z + height * height, 1.5);
    }
    qsort(each, STEPS * STEPS, sizeof *each, by_size);
    return each[STEPS * STEPS / 2];
}

static void build_room(lsf_scene *scene, bool roof)
{
    build_floor(scene, -1, 1);
    for (int wall = 0; wall < 4; wall++) {
        float x = wall % 2 ? 0 : wall - 1.0f, z = wall % 2 ? wall - 2.0f : 0; /* outwards */
        build_quad(scene, lsf_f3(x - z, -1, z + x), lsf_f3(x + z, -1, z - x),
                   lsf_f3(x + z, 1, z - x), lsf_f3(x - z, 1, z + x));
    }
    if (roof)
        build_quad(scene, lsf_f3(-1, 1, -1), lsf_f3(1, 1, -1), lsf_f3(1, 1, 1), lsf_f3(-1, 1, 1));
}

/* A lamp lights a closed room into which the camera looks from outside, and no sky can. Without its
 * roof the room needs none, nor does anything in the open. */
static void test_rooms_get_a_lamp(void **state)
{
    (void)state;
    for (int roof = 0; roof < 2; roof++) {
        lsf_scene *scene = build_scene();
        build_material(scene, 1, 1, 1);
        build_room(scene, roof);
        look_down(scene, 1);
        finish_scene(scene);
        lsf_scene_compute_requirements(scene);
        assert_true(lsf_default_light_add(scene, LSF_DEFAULT_LIGHT_ALWAYS, NULL));
        const lsf_default_lamp *lamp = &scene->default_lamp;
        assert_int_equal(lamp->present, roof);
        assert_int_equal(scene->requirements.point_lights, roof);
        for (int axis = 0; axis < 3; axis++)
            assert_true(fabs(lamp->position[axis]) < 0.9);
        if (roof) /* seen points lie anywhere in their pixels, up to 1/16 from the centre */
            assert_near(median_irradiance_of_floor(lamp), 0.5 * M_PI, 0.04 * 0.5 * M_PI);
        destroy_scene(scene);
    }
}

/* Irradiance of a plane by the sky's map, whose rows are uniform: over the whole sphere. */
static double sky_irradiance(const lsf_environment *sky, const double normal[3])
{
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        double theta = M_PI * (i + 0.5) / STEPS;
        double y = theta / M_PI * sky->height - 0.5;
        int low = (int)fmax(floor(y), 0), high = low + 1 < (int)sky->height ? low + 1 : low;
        double t = fmax(y - low, 0);
        double radiance = (1 - t) * (double)sky->texels[3 * sky->width * (uint32_t)low] +
                          t * (double)sky->texels[3 * sky->width * (uint32_t)high];
        for (int j = 0; j < 2 * STEPS; j++) {
            double phi = M_PI * (j + 0.5) / STEPS;
            double cosine = normal[0] * sin(theta) * cos(phi) + normal[1] * cos(theta) +
                            normal[2] * sin(theta) * sin(phi);
            sum += fmax(cosine, 0) * radiance * sin(theta) * M_PI / STEPS * M_PI / STEPS;
        }
    }
    return sum;
}

static void test_brightness(void **state)
{
    (void)state;
    lsf_scene *scene = build_sphere_scene();
    lsf_scene_compute_requirements(scene);
    assert_true(lsf_default_light_add(scene, LSF_DEFAULT_LIGHT_ALWAYS, NULL));
    const double *way = scene->key_light.direction;
    assert_near(way[0] * way[0] + way[1] * way[1] + way[2] * way[2], 1, 1e-12);

    /* A white surface that faces the key light: radiance 1, half of it from the sky. */
    const double facing[3] = {-way[0], -way[1], -way[2]};
    double by_sky = sky_irradiance(&scene->environment, facing);
    assert_near((by_sky + (double)scene->key_light.irradiance) / M_PI, 1, 1e-3);
    assert_near(by_sky / M_PI, 0.5, 5e-4);
    const double up[3] = {0, 1, 0}, down[3] = {0, -1, 0};
    assert_near(sky_irradiance(&scene->environment, up) / sky_irradiance(&scene->environment, down),
                (1 + 0.6 * 2 / 3) / (1 - 0.6 * 2 / 3), 5e-3); /* b / a = (4 - 1) / (4 + 1) */

    lsf_state now = {0};
    lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    assert_true(lsf_state_update(&now, scene, &view, NULL));
    assert_int_equal(now.light_count, 1);
    assert_int_equal(now.lights[0].type, LSF_LIGHT_DIRECTIONAL);
    for (int axis = 0; axis < 3; axis++) {
        assert_near((double)now.lights[0].direction[axis], way[axis], 1e-6);
        assert_near((double)now.lights[0].intensity[axis], (double)scene->key_light.irradiance, 0);
    }
    lsf_state_finish(&now);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_emitted_light_has_closed_forms),
        cmocka_unit_test(test_rule),
        cmocka_unit_test(test_emitters_count_when_they_light),
        cmocka_unit_test(test_rooms_get_a_lamp),
        cmocka_unit_test(test_brightness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
