/* How the path tracer finds light: from punctual lights by way of a surface, and from many lights.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "chi_square.h"
#include "math/sampling.h"
#include "reference/light_tree.h"
#include "render_scene.h"

/* Within a sphere, what any of its points reflects diffusely reaches all others alike: of the power
 * P of a lamp anywhere inside, E_k = albedo^k P / (4 pi r^2) arrives at each after k reflections.
 * The lamp is so close to the wall that a path comes by chance upon what it lights once in
 * thousands. */
static double one_bounce_within_sphere(lsf_light_type type, float from_wall, uint32_t samples,
                                       uint32_t bounces)
{
    static const float eye[3] = {0.2f, 0.1f, 0.3f}, target[3] = {-1.0f, 0.2f, 0.1f};
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_sphere(scene, 5, true);
    lsf_light *lamp = build_light(scene, type, lsf_f3(0, 1.0f - from_wall, 0), lsf_f3(0, 1, 0), 1);
    double power = 4.0 * M_PI;
    if (type == LSF_LIGHT_SPOT) {
        lamp->inner_cone = 0.5f;
        lamp->outer_cone = 1.0f;
        /* Of the squared ramp from cos 1 to cos 0.5: a third of its height. */
        power = 2.0 * M_PI * (1.0 - cos(0.5) + (cos(0.5) - cos(1.0)) / 3.0);
    }
    finish_scene(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = params.height = 8;
    params.samples = samples;
    params.bounces = bounces;
    params.camera_position = eye;
    params.camera_target = target;
    lsf_image *image = render_scene(scene, &params, 0, 0);
    double mean[3], expected = 0.0;
    image_mean(image, 16, mean);
    for (uint32_t k = 1; k <= bounces; k++)
        expected += pow(0.5, k + 1.0) / M_PI * power / (4.0 * M_PI);
    lsf_image_destroy(image);
    destroy_scene(scene);
    return mean[0] / expected - 1.0;
}

static void lamps_close_to_walls(void **unused)
{
    (void)unused;
    static const float from_wall[] = {0.5f, 0.02f};
    for (int type = 0; type < 2; type++) {
        for (int place = 0; place < 2; place++) {
            for (uint32_t bounces = 1; bounces < 4; bounces += 2) {
                double error = one_bounce_within_sphere(type ? LSF_LIGHT_SPOT : LSF_LIGHT_POINT,
                                                        from_wall[place], 64, bounces);
                print_message("%s, %g from the wall, %u bounces: %.4f\n", type ? "spot" : "point",
                              (double)from_wall[place], bounces, error);
                assert_true(fabs(error) < 0.002);
            }
        }
    }
}

enum { LIGHTS = 60 };

static float uniform(uint32_t seed, uint32_t index, float low, float high)
{
    return low + (high - low) * lsf_random_float(seed, index);
}

/* Points, spots and triangles of both kinds, as lights.c bounds them; triangles' corners on the
 * side. */
typedef struct test_light {
    lsf_light_bounds bounds;
    lsf_float3 corners[3]; /* of a point light all three are the same */
    float cos_outer;       /* -1: it is no spot */
} test_light;

static test_light make_light(uint32_t i, uint32_t seed)
{
    uint32_t at = 64 * i;
    lsf_float3 place = lsf_f3(uniform(seed, at, -1, 1), uniform(seed, at + 1, -1, 1),
                              uniform(seed, at + 2, -1, 1));
    lsf_float3 axis = lsf_sample_sphere(uniform(seed, at + 3, 0, 1), uniform(seed, at + 4, 0, 1));
    test_light light = {.corners = {place, place, place}, .cos_outer = -1.0f};
    light.bounds = (lsf_light_bounds){.cos_spread = -1.0f,
                                      .intensity = uniform(seed, at + 5, 0.01f, 1.0f),
                                      .range = i % 4 == 1 ? 0.8f : INFINITY};
    if (i % 4 == 0) { /* a spot: full within 0.3 radians, none beyond 0.6 */
        light.cos_outer = cosf(0.6f);
        light.bounds.cos_spread = cosf(0.3f);
        light.bounds.cos_emission = cosf(0.3f + LSF_LIGHT_ROUNDING);
    }
    if (i % 4 > 1) {
        for (uint32_t c = 1; c < 3; c++)
            for (uint32_t k = 0; k < 3; k++)
                (&light.corners[c].x)[k] += uniform(seed, at + 3 * c + k + 6, -0.2f, 0.2f);
        axis = lsf_f3_normalize(lsf_f3_cross(lsf_f3_sub(light.corners[1], light.corners[0]),
                                             lsf_f3_sub(light.corners[2], light.corners[0])));
        light.bounds.cos_spread = 1.0f;
        light.bounds.two_sided = i % 4 == 3;
    }
    lsf_f3_store(light.bounds.axis, axis);
    for (int k = 0; k < 3; k++) {
        float a = (&light.corners[0].x)[k], b = (&light.corners[1].x)[k];
        float c = (&light.corners[2].x)[k];
        light.bounds.low[k] = fminf(a, fminf(b, c));
        light.bounds.high[k] = fmaxf(a, fmaxf(b, c));
    }
    return light;
}

static lsf_light_receiver make_receiver(uint32_t i)
{
    return (lsf_light_receiver){
        .position = lsf_f3(uniform(77, 8 * i, -1.5f, 1.5f), uniform(77, 8 * i + 1, -1.5f, 1.5f),
                           uniform(77, 8 * i + 2, -1.5f, 1.5f)),
        .normal = lsf_sample_sphere(uniform(77, 8 * i + 3, 0, 1), uniform(77, 8 * i + 4, 0, 1)),
        .both_sides = i % 3 == 0,
    };
}

/* Whether any of a hundred of its points shines on the receiver. */
static bool can_light(const test_light *light, const lsf_light_receiver *receiver)
{
    for (uint32_t i = 0; i < 100; i++) {
        float u[2], b1, b2;
        lsf_sobol_2d(i, 5, u);
        lsf_sample_triangle(u[0], u[1], &b1, &b2);
        lsf_float3 point = lsf_f3_scale(light->corners[0], 1.0f - b1 - b2);
        point = lsf_f3_mad(lsf_f3_mad(point, light->corners[1], b1), light->corners[2], b2);
        lsf_float3 way = lsf_f3_sub(receiver->position, point);
        float emitted = lsf_f3_dot(way, lsf_f3_load(light->bounds.axis)) / lsf_f3_length(way);
        if (light->bounds.two_sided)
            emitted = fabsf(emitted);
        if (light->bounds.cos_spread == -1.0f)
            emitted = 1.0f;
        else if (light->cos_outer > -1.0f)
            emitted -= light->cos_outer;
        float received = -lsf_f3_dot(way, receiver->normal);
        if (emitted > 0.0f && lsf_f3_length(way) < light->bounds.range &&
            (received > 0.0f || receiver->both_sides))
            return true;
    }
    return false;
}

/* As often as their probabilities say; these sum up to 1, or less where a group turns out to send
 * nothing; none that can light is left out. */
static void draws_follow_probabilities(void **unused)
{
    (void)unused;
    enum { DRAWS = 8192, RECEIVERS = 24 };
    static const uint32_t most[] = {1, 1, 3, 8};
    test_light lights[LIGHTS];
    lsf_light_bounds bounds[LIGHTS];
    for (uint32_t i = 0; i < LIGHTS; i++) {
        lights[i] = make_light(i, 3);
        bounds[i] = lights[i].bounds;
    }
    lsf_light_tree tree;
    assert_true(lsf_light_tree_init(&tree, bounds, LIGHTS));
    double worst = 0.0;
    for (uint32_t r = 0; r < RECEIVERS; r++) {
        lsf_light_receiver receiver = make_receiver(r);
        double counts[LIGHTS + 1] = {0}, expected[LIGHTS + 1], sum = 0.0, drawn = 0.0;
        uint32_t groups = most[r % 4];
        for (uint32_t i = 0; i < DRAWS; i++) {
            lsf_light_choice choices[8];
            /* A seed of its own for each: chance, not the sequence's evenness, is tested. */
            lsf_light_numbers numbers = {lsf_hash(r, i), 0};
            uint32_t count = lsf_light_tree_draw(&tree, &receiver, groups, numbers, choices);
            assert_true(count <= groups);
            for (uint32_t k = 0; k < count; k++) {
                float p = lsf_light_tree_probability(&tree, &receiver, groups, choices[k].light);
                assert_true(fabsf(p / choices[k].probability - 1.0f) < 1e-5f);
                assert_true(choices[k].u[0] >= 0.0 && choices[k].u[0] < 1.0);
                counts[choices[k].light] += 1.0;
            }
            drawn += count;
        }
        for (uint32_t i = 0; i < LIGHTS; i++) {
            double p = (double)lsf_light_tree_probability(&tree, &receiver, groups, i);
            if (can_light(&lights[i], &receiver))
                assert_true(p > 0.0);
            expected[i] = p * DRAWS;
            sum += p;
        }
        assert_true(sum < groups + 1e-4);
        assert_true(fabs(drawn / DRAWS - sum) < 4.0 * sqrt((double)groups / DRAWS));
        counts[LIGHTS] = groups * (double)DRAWS - drawn;
        expected[LIGHTS] = (groups - sum) * DRAWS;
        worst = fmax(worst, chi_square_z(counts, expected, LIGHTS + 1, 5.0));
    }
    print_message("draws against probabilities: %.1f standard deviations at most\n", worst);
    assert_true(worst < 4.0);
    lsf_light_tree_finish(&tree);
}

static void probabilities_sum_up(void **unused)
{
    (void)unused;
    lsf_light_bounds bounds[LIGHTS];
    for (uint32_t i = 0; i < LIGHTS; i++) {
        bounds[i] = make_light(4 * i + 1, 9).bounds; /* points, */
        bounds[i].range = INFINITY;                  /* which reach everything above a horizon */
    }
    for (uint32_t count = 1; count <= LIGHTS; count += count < 12 ? 1 : 16) {
        lsf_light_tree tree;
        assert_true(lsf_light_tree_init(&tree, bounds, count));
        lsf_light_receiver receiver = {.position = {0.3f, 0.2f, 0.1f}, .normal = {0, 0, 1}};
        for (uint32_t most = 1; most <= 8; most++) {
            receiver.both_sides = true;
            double sum = 0.0;
            for (uint32_t i = 0; i < count; i++)
                sum += (double)lsf_light_tree_probability(&tree, &receiver, most, i);
            assert_true(fabs(sum - (most < count ? most : count)) < 1e-5 * most);
        }
        lsf_light_tree_finish(&tree);
    }
}

/* One that outshines all, ones that do not shine, all in one place, one alone, none. */
static void extreme_lights(void **unused)
{
    (void)unused;
    lsf_light_bounds bounds[LIGHTS];
    lsf_light_receiver receiver = {.position = {0, 2, 0}, .normal = {0, -1, 0}};
    lsf_light_choice choice;
    for (uint32_t i = 0; i < LIGHTS; i++) {
        bounds[i] = make_light(1, 2).bounds;
        bounds[i].range = INFINITY;
        bounds[i].intensity = i % 2 == 0 ? 0.0f : 1e-20f;
    }
    for (float bright = 1e-20f; bright < 1e20f; bright *= 1e6f) {
        bounds[7].intensity = bright;
        lsf_light_tree tree;
        assert_true(lsf_light_tree_init(&tree, bounds, LIGHTS));
        double sum = 0.0;
        for (uint32_t i = 0; i < LIGHTS; i++) {
            double p = (double)lsf_light_tree_probability(&tree, &receiver, 1, i);
            double share = (double)bounds[i].intensity / ((double)bright + 29e-20);
            assert_true(fabs(p - share) <= 1e-5 * share + 1e-37);
            assert_true((p > 0.0) == (i % 2 == 1) || share < 1e-37);
            sum += p;
        }
        assert_true(fabs(sum - 1.0) < 1e-5);
        lsf_light_tree_finish(&tree);
    }
    lsf_light_tree tree;
    for (uint32_t count = 0; count < 2; count++) { /* none; one that does not shine */
        assert_true(lsf_light_tree_init(&tree, bounds, count));
        assert_int_equal(
            lsf_light_tree_draw(&tree, &receiver, 8, (lsf_light_numbers){1, 1}, &choice), 0);
        if (count == 1)
            assert_true(lsf_light_tree_probability(&tree, &receiver, 8, 0) == 0.0f);
        lsf_light_tree_finish(&tree);
    }
    assert_true(lsf_light_tree_init(&tree, bounds + 1, 1));
    assert_int_equal(lsf_light_tree_draw(&tree, &receiver, 1, (lsf_light_numbers){1, 1}, &choice),
                     1);
    assert_true(choice.probability == 1.0f && choice.light == 0);
    lsf_light_tree_finish(&tree);
}

/* 400 lamps above a floor, points or small squares: E = sum I cos / d^2. A unit square's worth of
 * squares has its light at its middle, to the square of size over height. */
static void many_lamps_over_floor(void **unused)
{
    (void)unused;
    for (int glowing = 0; glowing < 2; glowing++) {
        lsf_scene *scene = build_scene();
        scene->diffuse_only = true;
        build_material(scene, 1.0f, 1.0f, 1.0f);
        build_floor(scene, 0.0f, 4.0f);
        lsf_material *glow = build_material(scene, 0.0f, 0.0f, 0.0f);
        glow->emission[0] = glow->emission[1] = glow->emission[2] = 1.0f;
        double expected = 0.0;
        for (uint32_t i = 0; i < 400; i++) {
            float x = uniform(8, 4 * i, -4, 4), z = uniform(8, 4 * i + 1, -4, 4), h = 1.0f;
            float size = uniform(8, 4 * i + 2, 0.01f, 0.04f), intensity = 4.0f * size * size;
            double d2 = (double)(x * x + z * z + h * h);
            expected += (double)intensity * (glowing ? 1.0 : sqrt(d2)) / (d2 * d2);
            if (!glowing)
                build_light(scene, LSF_LIGHT_POINT, lsf_f3(x, h, z), lsf_f3(0, -1, 0), intensity);
            else
                build_quad(scene, lsf_f3(x - size, h, z - size), lsf_f3(x + size, h, z - size),
                           lsf_f3(x + size, h, z + size), lsf_f3(x - size, h, z + size));
        }
        finish_scene(scene);
        float rgb[3];
        render_point(scene, lsf_f3(0.1f, 0.5f, 0.3f), lsf_f3(0, 0, 0), 4096, 0, rgb);
        double error = (double)rgb[0] * M_PI / expected - 1.0;
        print_message("400 %s: off by %.1e\n", glowing ? "squares" : "points", error);
        assert_true(fabs(error) < 5e-3);
        destroy_scene(scene);
    }
}

/* Twelve suns, some of them below the floor, and the sky: more than are each asked. */
static void many_suns_and_sky(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    scene->diffuse_only = true;
    build_material(scene, 1.0f, 1.0f, 1.0f);
    build_floor(scene, 0.0f, 1.0f);
    double expected = M_PI * 0.5; /* of the sky */
    for (uint32_t i = 0; i < 12; i++) {
        lsf_float3 way = lsf_sample_sphere(uniform(4, 3 * i, 0, 1), uniform(4, 3 * i + 1, 0, 1));
        float intensity = uniform(4, 3 * i + 2, 0, 1);
        build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), way, intensity);
        expected += (double)intensity * fmax(0.0, (double)-way.y);
    }
    float *texels = build_environment_map(scene, 16, 8);
    for (uint32_t i = 0; i < 3 * 16 * 8; i++)
        texels[i] = 0.5f;
    finish_scene(scene);
    float rgb[3];
    render_point(scene, lsf_f3(0.1f, 0.5f, 0.3f), lsf_f3(0, 0, 0), 4096, 0, rgb);
    double error = (double)rgb[0] * M_PI / expected - 1.0;
    print_message("12 suns and a sky: off by %.1e\n", error);
    assert_true(fabs(error) < 2e-3);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_close_to_walls),  cmocka_unit_test(draws_follow_probabilities),
        cmocka_unit_test(probabilities_sum_up),  cmocka_unit_test(extreme_lights),
        cmocka_unit_test(many_lamps_over_floor), cmocka_unit_test(many_suns_and_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
