/* Directions of ray-bundles: their density integrates to one, is what they are drawn with, and is
 * the same number in the shader. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "math/sampling.h"
#include "techniques/bundle_directions.h"

enum { WIDTH = 64, HEIGHT = 32 };

/* A dim sky with a small sun a thousand times as bright. */
static lsf_environment sunny(float texels[3 * WIDTH * HEIGHT])
{
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        int x = i % WIDTH, y = i / WIDTH;
        float value = 0.2f + 0.3f * (float)(HEIGHT - y) / HEIGHT;
        if (abs(x - 11) <= 1 && abs(y - 9) <= 1)
            value = 400.0f;
        for (int c = 0; c < 3; c++)
            texels[3 * i + c] = value;
    }
    return (lsf_environment){.present = true, .width = WIDTH, .height = HEIGHT, .texels = texels};
}

static void init(lsf_bundle_directions *directions, const lsf_environment *environment)
{
    lsf_error error = {0};
    if (!lsf_bundle_directions_init(directions, environment, 1.0f, &error))
        fail_msg("%s", error.message);
}

/* Over any hemisphere, for each axis has one end in it. */
static void integrates_to_one(void **unused)
{
    (void)unused;
    static float texels[3 * WIDTH * HEIGHT];
    const lsf_environment environments[2] = {{0}, sunny(texels)};
    const lsf_float3 poles[3] = {lsf_f3(0, 1, 0), lsf_f3(0.6f, 0, 0.8f),
                                 lsf_f3(0.36f, -0.48f, 0.8f)};
    for (int e = 0; e < 2; e++) {
        lsf_bundle_directions directions;
        init(&directions, &environments[e]);
        for (int p = 0; p < 3; p++) {
            enum { COUNT = 1 << 20 };
            double sum = 0.0;
            for (uint32_t i = 0; i < COUNT; i++) {
                float u[2];
                lsf_sobol_2d(i, 5, u);
                lsf_float3 d = lsf_sample_sphere(u[0], u[1]);
                if (lsf_f3_dot(d, poles[p]) > 0.0f)
                    sum += (double)lsf_bundle_directions_pdf(&directions, d);
            }
            assert_true(fabs(sum * 4.0 * M_PI / COUNT - 1.0) < 2e-3);
        }
        lsf_bundle_directions_finish(&directions);
    }
}

/* Axes fall into cells as the density says. */
static void drawn_with_its_density(void **unused)
{
    (void)unused;
    enum { COUNT = 200000, BINS_X = 16, BINS_Y = 8 };
    static float texels[3 * WIDTH * HEIGHT];
    static double observed[BINS_X * BINS_Y], expected[BINS_X * BINS_Y];
    const lsf_environment environment = sunny(texels);
    lsf_bundle_directions directions;
    init(&directions, &environment);
    static lsf_ray_bundle_direction drawn[COUNT];
    lsf_plan plan = {0};
    lsf_iteration iteration = {.plan = &plan, .seed = 3};
    lsf_bundle_directions_draw(&directions, &iteration, COUNT, false, drawn);
    for (int i = 0; i < COUNT; i++) {
        lsf_float3 d = lsf_f3_load(drawn[i].direction);
        assert_true(fabsf(lsf_f3_length(d) - 1.0f) < 1e-5f);
        assert_true(drawn[i].pdf == lsf_bundle_directions_pdf(&directions, d));
        if (d.y < 0.0f) /* the axis' other end */
            d = lsf_f3_scale(d, -1.0f);
        double u = 0.5 + atan2((double)d.z, (double)d.x) / (2.0 * M_PI);
        int x = (int)fmin(u * BINS_X, BINS_X - 1), y = (int)fmin((double)d.y * BINS_Y, BINS_Y - 1);
        observed[y * BINS_X + x] += 1.0;
    }
    enum { POINTS = 1 << 20 };
    for (uint32_t i = 0; i < POINTS; i++) {
        float u[2];
        lsf_sobol_2d(i, 9, u);
        double angle = 2.0 * M_PI * ((double)u[0] - 0.5), sine = sqrt(1.0 - (double)(u[1] * u[1]));
        lsf_float3 d = lsf_f3((float)(sine * cos(angle)), u[1], (float)(sine * sin(angle)));
        int bin = (int)(u[1] * BINS_Y) * BINS_X + (int)(u[0] * BINS_X);
        expected[bin] +=
            (double)lsf_bundle_directions_pdf(&directions, d) * 2.0 * M_PI / POINTS * COUNT;
    }
    for (int i = 0; i < BINS_X * BINS_Y; i++)
        assert_true(fabs(observed[i] - expected[i]) <=
                    5.0 * sqrt(expected[i]) + 0.01 * expected[i]);
    lsf_bundle_directions_finish(&directions);
}

static float texel_at(const lsf_environment *map, int x, int y)
{
    y = y < 0 ? 0 : y >= HEIGHT ? HEIGHT - 1 : y;
    return map->texels[3 * (y * WIDTH + (x + WIDTH) % WIDTH)];
}

/* Bilinear, as lib/environment.glsl reads it. */
static float radiance(const lsf_environment *map, lsf_float3 d)
{
    float x = (0.5f + atan2f(d.z, d.x) / (2.0f * (float)M_PI)) * WIDTH - 0.5f;
    float y = atan2f(hypotf(d.x, d.z), d.y) / (float)M_PI * HEIGHT - 0.5f;
    int left = (int)floorf(x), top = (int)floorf(y);
    float tx = x - (float)left, ty = y - (float)top;
    return (1.0f - ty) *
               ((1.0f - tx) * texel_at(map, left, top) + tx * texel_at(map, left + 1, top)) +
           ty *
               ((1.0f - tx) * texel_at(map, left, top + 1) + tx * texel_at(map, left + 1, top + 1));
}

/* Irradiance of a plane that faces up, by `count` bundles. */
static double irradiance(const lsf_environment *map, const lsf_bundle_directions *directions,
                         lsf_plan *plan, uint64_t seed, uint32_t count)
{
    static lsf_ray_bundle_direction drawn[1024];
    const lsf_iteration iteration = {.plan = plan, .seed = seed};
    lsf_bundle_directions_draw(directions, &iteration, count, false, drawn);
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        lsf_float3 d = lsf_f3_load(drawn[i].direction);
        d = d.y < 0.0f ? lsf_f3_scale(d, -1.0f) : d;
        sum += (double)(radiance(map, d) * d.y / drawn[i].pdf);
    }
    return sum / count;
}

/* Standard deviation relative to the mean, over seeds. */
static double deviation(const lsf_environment *map, const lsf_bundle_directions *directions,
                        lsf_plan *plan, double *mean)
{
    enum { SEEDS = 256 };
    double sum = 0.0, sum2 = 0.0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        double e = irradiance(map, directions, plan, seed, 1024);
        sum += e / SEEDS;
        sum2 += e * e / SEEDS;
    }
    *mean = sum;
    return sqrt(fmax(sum2 - sum * sum, 0.0)) / sum;
}

/* The same light E with less noise: by importance rather than uniformly, and by low discrepancy
 * rather than plain random numbers. Where the density follows L, one bundle's L cos / p_r has a
 * mean square of at most E times the integral of L + L_u; light that bilinear filtering spreads
 * into a cell whose density does not know of it would exceed that. */
static void importance_and_low_discrepancy_pay(void **unused)
{
    (void)unused;
    static float texels[3 * WIDTH * HEIGHT];
    const lsf_environment environment = sunny(texels);
    lsf_bundle_directions by_light, uniform = {0};
    init(&by_light, &environment);
    lsf_plan sobol = {0}, random = {.random_samples = true};
    double means[4], integral = 0.0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double sine = sin(M_PI * (i / WIDTH + 0.5) / HEIGHT);
        integral += 2.0 * (double)texels[3 * i] * sine * 2.0 * M_PI * M_PI / (WIDTH * HEIGHT);
    }
    double of_light = deviation(&environment, &by_light, &sobol, &means[0]);
    double random_of_light = deviation(&environment, &by_light, &random, &means[1]);
    double of_uniform = deviation(&environment, &uniform, &sobol, &means[2]);
    double random_of_uniform = deviation(&environment, &uniform, &random, &means[3]);
    print_message("1024 bundles, deviation by light %.4f, plain random %.4f; uniform %.4f, plain "
                  "random %.4f; means %.3f %.3f %.3f %.3f\n",
                  of_light, random_of_light, of_uniform, random_of_uniform, means[0], means[1],
                  means[2], means[3]);
    for (int i = 1; i < 4; i++)
        assert_true(fabs(means[i] / means[0] - 1.0) < 4.0 * random_of_uniform / 16.0);
    assert_true(random_of_light < sqrt(integral / means[0] / 1024.0));
    assert_true(of_light < 0.75 * random_of_light);
    assert_true(random_of_light < 0.25 * random_of_uniform);
    lsf_bundle_directions_finish(&by_light);
}

/* lib/bundle_pdf.glsl reads the same cells. */
static void shader_agrees(void **unused)
{
    (void)unused;
    enum { COUNT = 4096 };
    static float texels[3 * WIDTH * HEIGHT], points[COUNT][4], pdfs[COUNT][4];
    const lsf_environment environment = sunny(texels);
    lsf_bundle_directions directions;
    init(&directions, &environment);
    shader_folder folder;
    shader_folder_create(&folder);
    shader_folder_write(&folder, "pdf.comp.glsl",
                        "#include \"lib/bundle_pdf.glsl\"\n"
                        "layout(local_size_x = 64) in;\n"
                        "layout(std430, binding = 0) buffer block { vec4 d[]; };\n"
                        "void main()\n"
                        "{\n"
                        "    uint i = gl_GlobalInvocationID.x;\n"
                        "    d[i].w = bundle_pdf(d[i].xyz);\n"
                        "}\n");
    lsf_context *context = gl_test_context(gl_test_backend(), folder.path);
    lsf_error error = {0};
    const lsf_define define = {"LSF_BUNDLE_IMPORTANCE", 1};
    lsf_program_desc desc = {
        .label = "pdf", .files = {"pdf.comp.glsl"}, .defines = &define, .define_count = 1};
    GLuint program = lsf_program_get(context, &desc, &error);
    if (!program)
        fail_msg("%s", error.message);
    lsf_texture_desc texture_desc = {.label = "pdf",
                                     .target = GL_TEXTURE_2D,
                                     .internal_format = GL_R32F,
                                     .width = WIDTH,
                                     .height = HEIGHT,
                                     .depth = 1,
                                     .levels = 1};
    GLuint texture = lsf_texture_create(context, &texture_desc, &error);
    glTextureSubImage2D(texture, 0, 0, 0, WIDTH, HEIGHT, GL_RED, GL_FLOAT, directions.pdf);
    for (uint32_t i = 0; i < COUNT; i++) {
        float u[2];
        lsf_sobol_2d(i, 11, u);
        lsf_f3_store(points[i], lsf_sample_sphere(u[0], u[1]));
    }
    GLuint buffer = lsf_buffer_create(context, "points", sizeof points, points, 0, &error);
    glUseProgram(program);
    glBindTextureUnit(9, texture);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    glDispatchCompute(COUNT / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof pdfs, pdfs);
    int different = 0;
    for (uint32_t i = 0; i < COUNT; i++)
        different += pdfs[i][3] != lsf_bundle_directions_pdf(&directions, lsf_f3_load(points[i]));
    /* On a cell's edge rounding decides. */
    assert_true(different <= COUNT / 200);
    lsf_buffer_destroy(context, &buffer);
    lsf_texture_destroy(context, &texture);
    gl_test_check(context);
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
    lsf_bundle_directions_finish(&directions);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrates_to_one),
        cmocka_unit_test(drawn_with_its_density),
        cmocka_unit_test(importance_and_low_discrepancy_pay),
        cmocka_unit_test(shader_agrees),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
