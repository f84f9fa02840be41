/* Light of emissive surfaces: how points on them are drawn, and that VPLs, bundles and both bring
 * the same light. */
#include <math.h>

#include "base/base.h"
#include "bidirectional_rig.h"
#include "math/sampling.h"
#include "scene/emitters.h"

/* Small maps: what is tested here does not depend on their resolution. */
enum { POINT = 1, LAMP = 2, PLAIN = 0, BOTH_SIDES = 4, TEXTURED = 8 };

static void add_lamp(lsf_scene *scene, int kind, float radiance)
{
    static const uint8_t texels[] = {255, 255, 255, 20, 40, 90, 0, 0, 0, 200, 100, 50};
    lsf_material *material = build_material(scene, 0.2f, 0.2f, 0.2f);
    for (int c = 0; c < 3; c++)
        material->emission[c] = radiance * (1.0f - 0.2f * (float)c);
    material->double_sided = kind & BOTH_SIDES;
    if (kind & TEXTURED) {
        material->emissive_texture.texture = build_texture(scene, 2, 2, 3, texels, true);
        scene->textures[0].nearest = true; /* as bundles read all textures */
    }
    build_quad(scene, lsf_f3(-0.4f, 1.7f, -0.2f), lsf_f3(0.2f, 1.7f, -0.2f),
               lsf_f3(0.2f, 1.9f, 0.5f), lsf_f3(-0.4f, 1.9f, 0.5f));
}

/* A corner with lights as `kind` says. */
static lsf_scene *room(int kind, float radiance)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    if (kind & LAMP)
        add_lamp(scene, kind, radiance);
    if (kind & POINT)
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(1.5f, 2, 0.5f), lsf_f3(0, -1, 0), 4.0f);
    if (kind & TEXTURED) { /* each corner of the quad shows a corner of the texture */
        scene->vertices.uv0 = calloc(2 * scene->vertices.count, sizeof(float));
        for (uint64_t i = 0; i < 2 * scene->vertices.count; i++)
            scene->vertices.uv0[i] = 0.5f + scene->vertices.position[3 * (i / 2) + 2 * (i % 2)];
    }
    finish_gl_scene(scene);
    return scene;
}

static lsf_image *render(const lsf_scene *scene, uint32_t samples, uint32_t bounces, uint32_t size,
                         const char *option)
{
    const char *options[] = {SMALL_MAPS, option};
    lsf_render_params params = bidirectional_params(samples, bounces);
    params.options = options;
    params.option_count = option ? SMALL_MAP_OPTIONS + 1 : SMALL_MAP_OPTIONS;
    params.aovs = LSF_AOV_DIRECT | LSF_AOV_EMISSION;
    return render_corner(scene, params, size);
}

static void same_mean(const double a[3], const double b[3], double bound)
{
    for (int c = 0; c < 3; c++)
        assert_true(fabs(a[c] / b[c] - 1.0) <= bound);
}

/* Means of 1 / density and radiance / density are area and power of all sides; points lie on the
 * lamp's plane, and shine from the side that emits. */
static void points_are_drawn_by_power(void **unused)
{
    (void)unused;
    static const int kinds[] = {PLAIN, BOTH_SIDES, TEXTURED, TEXTURED | BOTH_SIDES};
    enum { COUNT = 1 << 16 };
    for (size_t k = 0; k < LSF_COUNT(kinds); k++) {
        lsf_scene *scene = room(LAMP | kinds[k], 5.0f);
        lsf_state state = {0};
        lsf_emitters emitters;
        lsf_error error = {0};
        const lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
        assert_true(lsf_state_update(&state, scene, &view, &error));
        assert_true(lsf_emitters_init(&emitters, scene, &state));
        assert_int_equal(emitters.count, 2);
        double area = 0.0, luminance = 0.0, front = 0.0;
        for (uint32_t i = 0; i < COUNT; i++) {
            uint32_t bits[2];
            lsf_sobol_2d_bits(i, 3, bits);
            const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
            lsf_emitter_sample s = lsf_emitters_sample(&emitters, u);
            double l = (double)lsf_f3_luminance(lsf_f3_load(s.radiance));
            double y = s.position[1] / state.scale + state.center[1];
            double z = s.position[2] / state.scale + state.center[2];
            assert_true(fabs(y - 1.7 - (z + 0.2) * (0.2 / 0.7)) < 1e-5);
            assert_true(fabs((double)s.weight_density / (double)lsf_emitters_weight(&emitters) -
                             l) <= 1e-5 * l);
            area += 1.0 / (double)s.density / COUNT;
            luminance += l / (double)s.density / COUNT;
            front += s.normal[1] < 0.0f ? 1.0 / COUNT : 0.0;
        }
        double sides = kinds[k] & BOTH_SIDES ? 2.0 : 1.0;
        double expected = 0.6 * hypot(0.7, 0.2) * state.scale * state.scale * sides;
        print_message("kind %d: area %.6f of %.6f, luminance %.5f of about %.5f, %.3f down\n",
                      kinds[k], area, expected, luminance, emitters.power.sum, front);
        assert_true(fabs(area / expected - 1.0) < 1e-4);
        assert_true(fabs(luminance / emitters.power.sum - 1.0) <
                    (kinds[k] & TEXTURED ? 0.15 : 1e-4));
        assert_true(fabs(front - 1.0 / sides) < 1e-3);
        lsf_emitters_finish(&emitters);
        lsf_state_finish(&state);
        lsf_scene_destroy(scene);
    }
}

static void strategies_agree(void **unused)
{
    (void)unused;
    static const struct {
        int kind;
        uint32_t bounces;
    } cases[] = {{PLAIN, 0}, {PLAIN, 2}, {BOTH_SIDES, 1}, {TEXTURED, 0}};
    static const char *const strategies[] = {"bidirectional.strategy=both",
                                             "bidirectional.strategy=vpl",
                                             "bidirectional.strategy=bundle"};
    for (size_t k = 0; k < LSF_COUNT(cases); k++) {
        lsf_scene *scene = room(LAMP | cases[k].kind, 5.0f);
        double rgb[3][3];
        for (int i = 0; i < 3; i++) {
            /* Bundles alone find the lamp by chance; which VPLs shine most, a texture decides. */
            uint32_t samples = (i == 2 ? 1024 : 256) * (cases[k].kind & TEXTURED ? 4 : 1);
            lsf_image *image = render(scene, samples, cases[k].bounces, 16, strategies[i]);
            mean_rgb(image, 0, rgb[i]);
            print_message("kind %d, %u bounces, %s: %.5f %.5f %.5f\n", cases[k].kind,
                          cases[k].bounces, strategies[i], rgb[i][0], rgb[i][1], rgb[i][2]);
            lsf_image_destroy(image);
        }
        double noise = getenv("LSF_TEST_QUICK") ? 2.0 : 1.0;
        same_mean(rgb[1], rgb[0], 0.01 * noise);
        same_mean(rgb[2], rgb[0], 0.03 * noise);
        lsf_scene_destroy(scene);
    }
}

static void lamp_and_light_add_up(void **unused)
{
    (void)unused;
    double sum[3] = {0}, both[3] = {0};
    for (int kind = POINT; kind <= (POINT | LAMP); kind++) {
        /* A dark lamp is in the way of the light just as well. */
        lsf_scene *scene = room(kind | LAMP, kind & LAMP ? 5.0f : 0.0f);
        lsf_image *image = render(scene, 256, 1, 24, NULL);
        double rgb[3];
        mean_rgb(image, 0, rgb);
        for (int c = 0; c < 3; c++) {
            sum[c] += kind == (POINT | LAMP) ? 0.0 : rgb[c];
            both[c] = rgb[c];
        }
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
    print_message("point + lamp: %.5f %.5f %.5f, both: %.5f %.5f %.5f\n", sum[0], sum[1], sum[2],
                  both[0], both[1], both[2]);
    same_mean(both, sum, getenv("LSF_TEST_QUICK") ? 0.02 : 0.01);
}

/* Without bounces, all light is direct. Layers follow the picture: direct, emission. */
static void a_lamp_lights_directly(void **unused)
{
    (void)unused;
    lsf_scene *scene = room(LAMP, 5.0f);
    lsf_image *image = render(scene, 64, 0, 24, NULL);
    double picture[3], emission[3], direct[3];
    mean_rgb(image, 0, picture);
    mean_rgb(image, 3, emission);
    mean_rgb(image, 6, direct);
    print_message("picture %.5f, emission %.5f, direct %.5f\n", picture[0], emission[0], direct[0]);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(picture[c] - emission[c] - direct[c]) <= 1e-5 * picture[c]);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

static void same_bits_again(void **unused)
{
    (void)unused;
    lsf_scene *scene = room(LAMP | POINT, 5.0f);
    lsf_render_params params = corner_params(bidirectional_params(3, 2), 33);
    params.aovs = LSF_AOV_DIRECT | LSF_AOV_EMISSION;
    assert_same_for_any_threads(scene, &params);
    lsf_scene_destroy(scene);
}

/* Light times 2^k gives the picture times 2^k, to the bit; what emits but has no area, nothing. */
static void extremes(void **unused)
{
    (void)unused;
    static const float scales[] = {0x1p-60f, 0x1p60f};
    lsf_scene *scene = room(LAMP, 5.0f);
    lsf_image *expected = render(scene, 4, 1, 24, NULL);
    for (int i = 0; i < 2; i++) {
        lsf_scene *scaled = room(LAMP, 5.0f * scales[i]);
        lsf_image *image = render(scaled, 4, 1, 24, NULL);
        assert_scaled_pixels(image, expected, scales[i]);
        lsf_image_destroy(image);
        lsf_scene_destroy(scaled);
    }
    lsf_image_destroy(expected);
    lsf_scene_destroy(scene);

    const lsf_float3 needle[3] = {lsf_f3(0, 1, 0), lsf_f3(0, 1.5f, 0), lsf_f3(0, 2, 0)};
    scene = build_scene();
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 2.0f);
    build_material(scene, 0.5f, 0.5f, 0.5f)->emission[1] = 3.0f;
    build_triangles(scene, needle, 1);
    finish_gl_scene(scene);
    lsf_image *image = render(scene, 4, 1, 9, NULL);
    double rgb[3];
    mean_rgb(image, 0, rgb);
    assert_true(rgb[0] == 0.0 && rgb[1] == 0.0 && rgb[2] == 0.0);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_drawn_by_power), cmocka_unit_test(strategies_agree),
        cmocka_unit_test(lamp_and_light_add_up),     cmocka_unit_test(a_lamp_lights_directly),
        cmocka_unit_test(same_bits_again),           cmocka_unit_test(extremes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
