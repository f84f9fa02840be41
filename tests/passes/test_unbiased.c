/* Estimators that claim to be right on average: independent pictures against independent ones of
 * the path tracer, block by block. Each block's means are compared by Welch's test ("The
 * generalization of 'Student's' problem when several different population variances are involved",
 * Biometrika 34, 1947), and all blocks together are allowed one false alarm in a hundred (Sidak,
 * "Rectangular confidence regions for the means of multivariate normal distributions", JASA 62,
 * 1967). */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"
#include "sweep/statistics.h"

/* Blocks of 6 x 6 pixels, and all of them as one more. */
enum { SIZE = 24, SIDE = 6, ALONG = SIZE / SIDE, BLOCKS = ALONG * ALONG + 1, RUNS = 12 };

static const double alpha = 0.01;

typedef struct estimator {
    const char *technique, *scene;
    bool diffuse_only;
    uint32_t bounces, samples, reference_samples;
    float sky[3]; /* radiance from all around; 0: none */
} estimator;

typedef struct means {
    double block[RUNS][BLOCKS];
} means;

static lsf_scene *load(const estimator *e, float light)
{
    char path[4096];
    lsf_error error = {0};
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.diffuse_only = e->diffuse_only;
    params.environment_radiance = e->sky[0] > 0.0f ? e->sky : NULL;
    snprintf(path, sizeof path, "%s/data/scenes/%s.gltf", getenv("LSF_SOURCE_ROOT"), e->scene);
    lsf_scene *scene = lsf_scene_load(path, &params, &error);
    if (!scene)
        fail_msg("%s", error.message);
    for (uint32_t i = 0; i < scene->light_count; i++)
        for (int c = 0; c < 3; c++)
            scene->lights[i].intensity[c] *= light;
    for (uint32_t i = 0; i < scene->material_count; i++)
        for (int c = 0; c < 3; c++)
            scene->materials[i].emission[c] *= light;
    return scene;
}

static void add_means(const lsf_image *image, double block[BLOCKS])
{
    double *whole = &block[BLOCKS - 1];
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++)
            for (uint32_t c = 0; c < 3; c++) {
                double value = (double)image->pixels[(y * SIZE + x) * image->channel_count + c];
                block[y / SIDE * ALONG + x / SIDE] += value / (3.0 * SIDE * SIDE);
                *whole += value / (3.0 * SIZE * SIZE);
            }
}

/* Maps as coarse as the picture: smaller ones only make noise, which is what is tested. */
static lsf_render_params params_of(const estimator *e, uint32_t samples, uint64_t seed)
{
    static const char *const options[] = {"vpl.shadow_resolution=128", "rsm.resolution=128",
                                          "bundle.resolution=128"};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = e->technique;
    params.width = params.height = SIZE;
    params.bounces = e->bounces;
    params.samples = samples;
    params.seed = seed;
    params.options = options;
    params.option_count = LSF_COUNT(options);
    return params;
}

static means render_all(const estimator *e, float light)
{
    means found = {0};
    lsf_error error = {0};
    lsf_scene *scene = load(e, light);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL); /* keeps compiled programs */
    for (uint32_t run = 0; run < RUNS; run++) {
        lsf_render_params params = params_of(e, e->samples, 1 + run);
        lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
        bool good = renderer && lsf_renderer_run(renderer, &error);
        lsf_image *image = good ? lsf_renderer_read(renderer, &error) : NULL;
        if (!image)
            fail_msg("%s", error.message);
        add_means(image, found.block[run]);
        lsf_image_destroy(image);
        lsf_renderer_destroy(renderer);
    }
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
    return found;
}

static means trace_all(const estimator *e)
{
    means found = {0};
    lsf_error error = {0};
    lsf_scene *scene = load(e, 1.0f);
    for (uint32_t run = 0; run < RUNS; run++) {
        lsf_render_params params = params_of(e, e->reference_samples, 1000 + run);
        lsf_image *image = lsf_reference_render(scene, &params, 0, NULL, &error);
        if (!image)
            fail_msg("%s", error.message);
        add_means(image, found.block[run]);
        lsf_image_destroy(image);
    }
    lsf_scene_destroy(scene);
    return found;
}

/* Mean over runs and the variance of that mean. */
static void describe(const means *m, uint32_t block, double *mean, double *variance)
{
    *mean = *variance = 0.0;
    for (uint32_t run = 0; run < RUNS; run++)
        *mean += m->block[run][block] / RUNS;
    for (uint32_t run = 0; run < RUNS; run++)
        *variance += pow(m->block[run][block] - *mean, 2) / (RUNS - 1) / RUNS;
}

/* The probability that means of blocks that are right on average differ as much by chance. */
static double chance(const means *a, const means *b, uint32_t block, double *difference)
{
    double x, y, vx, vy;
    describe(a, block, &x, &vx);
    describe(b, block, &y, &vy);
    *difference = y != 0.0 ? x / y - 1.0 : 0.0;
    if (vx + vy == 0.0)
        return x == y ? 1.0 : 0.0;
    double degrees = pow(vx + vy, 2) / (vx * vx / (RUNS - 1) + vy * vy / (RUNS - 1));
    double t = fabs(x - y) / sqrt(vx + vy);
    return 2.0 * (1.0 - lsf_student_probability(t, (uint32_t)degrees));
}

/* Whether some block, or all of them together, is too far off for chance. */
static bool is_biased(const char *what, const means *gl, const means *reference)
{
    double limit = 1.0 - pow(1.0 - alpha, 1.0 / BLOCKS), least = 1.0, off = 0.0, whole;
    for (uint32_t block = 0; block < BLOCKS; block++) {
        double difference, p = chance(gl, reference, block, &difference);
        if (p < least) {
            least = p;
            off = difference;
        }
    }
    double p = chance(gl, reference, BLOCKS - 1, &whole);
    print_message("%s: %+.2f %% on the whole (p %.2g), worst block %+.2f %% (p %.2g, limit %.2g)\n",
                  what, 100.0 * whole, p, 100.0 * off, least, limit);
    return least < limit;
}

static void check(const char *name, const estimator *e)
{
    means reference = trace_all(e), gl = render_all(e, 1.0f);
    if (is_biased(name, &gl, &reference))
        fail_msg("%s is biased", name);
    /* The test would find 2 %: radiance is linear in the light. */
    for (uint32_t run = 0; run < RUNS; run++)
        for (uint32_t block = 0; block < BLOCKS; block++)
            gl.block[run][block] *= 0.98;
    assert_true(is_biased("2 % less", &gl, &reference));
}

static void direct(void **state)
{
    (void)state;
    const estimator e = {
        .technique = "direct", .scene = "cornell_point", .samples = 16, .reference_samples = 64};
    check("direct light of a point", &e);
    means dimmed = render_all(&e, 0.98f), reference = trace_all(&e);
    assert_true(is_biased("lamps with 2 % less light", &dimmed, &reference));
}

static void bidirectional(void **state)
{
    (void)state;
    check("bidirectional, a point light", &(estimator){.technique = "bidirectional",
                                                       .scene = "cornell_point",
                                                       .diffuse_only = true,
                                                       .bounces = 2,
                                                       .samples = 16,
                                                       .reference_samples = 64});
}

static void emissive(void **state)
{
    (void)state;
    check("bidirectional, an emissive surface", &(estimator){.technique = "bidirectional",
                                                             .scene = "cornell_emissive",
                                                             .diffuse_only = true,
                                                             .bounces = 1,
                                                             .samples = 40,
                                                             .reference_samples = 256});
}

/* By directions that all pixels share, each with a shadow map. */
static void sky(void **state)
{
    (void)state;
    check("direct light of a sky", &(estimator){.technique = "direct",
                                                .scene = "cornell_point",
                                                .diffuse_only = true,
                                                .samples = 16,
                                                .reference_samples = 64,
                                                .sky = {1.0f, 0.8f, 0.6f}});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(direct),
        cmocka_unit_test(bidirectional),
        cmocka_unit_test(emissive),
        cmocka_unit_test(sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
