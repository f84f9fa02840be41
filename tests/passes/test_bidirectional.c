/* The bidirectional technique against closed forms and by its rules: furnaces, scaling of light,
 * additivity of lights, the same bits again, extremes. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "bidirectional_rig.h"
#include "light_rules.h"
#include "shared/scene_data.h"

static void energy_in_a_furnace(void **unused)
{
    (void)unused;
    static const struct {
        float albedo;
        uint32_t bounces, samples; /* of black walls any number will do: nothing is random */
    } cases[] = {{0.0f, 1, 16}, {0.5f, 0, 512}, {0.5f, 3, 512}, {1.0f, 1, 512}};
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_scene *scene = furnace_scene(cases[i].albedo);
        /* Rays that graze an edge of the room are lost, fewer with finer bundles. */
        static const char *const finer = "bundle.resolution=256";
        lsf_render_params params = bidirectional_params(cases[i].samples, cases[i].bounces);
        params.samples = cases[i].samples; /* always: with fewer, noise alone passes the bound */
        params.options = &finer;
        params.option_count = 1;
        lsf_image *image =
            render_gl_from(scene, params, 8, lsf_f3(0.2f, 0.1f, 0.7f), lsf_f3(-0.3f, -0.2f, -1));
        assert_mean("furnace", image, furnace_radiance(cases[i].albedo, cases[i].bounces), 0.01);
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
}

static void white_furnace(void **unused)
{
    (void)unused;
    lsf_scene *scene = white_sphere_scene(3);
    lsf_render_params params = bidirectional_params(256, 0);
    params.option_count = 0; /* rays leave facets closer by than a texel, too */
    lsf_image *image = render_gl_from(scene, params, 24, lsf_f3(0, 0, 3), lsf_f3(0, 0, 0));
    assert_mean("white furnace", image, 0.5, 0.01);
    lsf_image_destroy(image);
    lsf_scene_destroy(scene);
}

/* A corner under light `which` of two, or both. */
enum { LIGHT_A = 1, LIGHT_B = 2 };
static lsf_scene *room(int which, float intensity)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    if (which & LIGHT_A)
        build_light(scene, LSF_LIGHT_POINT, lsf_f3(0.5f, 2, 0.5f), lsf_f3(0, -1, 0),
                    8.0f * intensity);
    if (which & LIGHT_B) {
        lsf_light *spot = build_light(scene, LSF_LIGHT_SPOT, lsf_f3(1.5f, 2.5f, 1.5f),
                                      lsf_f3(-0.7f, -0.6f, -0.6f), 20.0f * intensity);
        spot->inner_cone = 0.3f;
        spot->outer_cone = 0.6f;
    }
    finish_gl_scene(scene);
    return scene;
}

static void lights_add_up(void **unused)
{
    (void)unused;
    double sum[3] = {0}, both[3];
    for (int which = LIGHT_A; which <= (LIGHT_A | LIGHT_B); which++) {
        lsf_scene *scene = room(which, 1.0f);
        lsf_image *image = render_corner(scene, bidirectional_params(1024, 1), 24);
        double rgb[3];
        mean_rgb(image, 0, rgb);
        for (int c = 0; c < 3; c++) {
            sum[c] += which == (LIGHT_A | LIGHT_B) ? 0.0 : rgb[c];
            both[c] = rgb[c];
        }
        lsf_image_destroy(image);
        lsf_scene_destroy(scene);
    }
    print_message("A + B: %.5f %.5f %.5f, both: %.5f %.5f %.5f\n", sum[0], sum[1], sum[2], both[0],
                  both[1], both[2]);
    for (int c = 0; c < 3; c++)
        assert_true(fabs(both[c] / sum[c] - 1.0) <= 0.01);
}

/* All strategies estimate the same integral. */
static void strategies_agree(void **unused)
{
    (void)unused;
    static const char *const strategies[] = {"bidirectional.strategy=both",
                                             "bidirectional.strategy=vpl",
                                             "bidirectional.strategy=bundle"};
    const char *options[] = {SMALL_MAPS, NULL};
    lsf_scene *scene = room(LIGHT_A, 1.0f);
    for (uint32_t bounces = 1; bounces <= 2; bounces++) {
        double rgb[3][3];
        for (int i = 0; i < 3; i++) {
            lsf_render_params params = bidirectional_params(512, bounces);
            options[SMALL_MAP_OPTIONS] = strategies[i];
            params.options = options;
            params.option_count = SMALL_MAP_OPTIONS + 1;
            lsf_image *image = render_corner(scene, params, 16);
            mean_rgb(image, 0, rgb[i]);
            print_message("%u bounces, %s: %.5f %.5f %.5f\n", bounces, strategies[i], rgb[i][0],
                          rgb[i][1], rgb[i][2]);
            lsf_image_destroy(image);
        }
        for (int i = 1; i < 3; i++)
            for (int c = 0; c < 3; c++)
                assert_true(fabs(rgb[i][c] / rgb[0][c] - 1.0) <= 0.02);
    }
    lsf_scene_destroy(scene);
}

/* Light times 2^k gives the picture times 2^k, to the bit. */
/* A wall whose normals are bent by 35 degrees lights the floor beside it, from below its shading
 * horizon, too: VPLs on it and bundles that hit it alike. */
static void bent_normals(void **unused)
{
    (void)unused;
    static const char *const strategies[] = {"bidirectional.strategy=vpl",
                                             "bidirectional.strategy=bundle"};
    const char *options[] = {SMALL_MAPS, NULL};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_floor(scene, 0.0f, 2.0f);
    uint64_t first = scene->vertices.count;
    build_quad(scene, lsf_f3(-1, 0, -0.5f), lsf_f3(1, 0, -0.5f), lsf_f3(1, 1.5f, -0.5f),
               lsf_f3(-1, 1.5f, -0.5f));
    for (uint64_t i = first; i < scene->vertices.count; i++)
        lsf_f3_store(scene->vertices.normal + 3 * i, lsf_f3(0, 0.574f, 0.819f));
    scene->diffuse_only = true;
    lsf_light *spot =
        build_light(scene, LSF_LIGHT_SPOT, lsf_f3(0, 1.5f, 2), lsf_f3(0, -0.3f, -1), 20.0f);
    spot->inner_cone = 0.15f;
    spot->outer_cone = 0.2f;
    finish_gl_scene(scene);
    double rgb[2][3];
    for (int i = 0; i < 2; i++) {
        options[SMALL_MAP_OPTIONS] = strategies[i];
        lsf_render_params params = bidirectional_params(1024, 1);
        params.options = options;
        params.option_count = SMALL_MAP_OPTIONS + 1;
        params.fov_y = 20.0f;
        lsf_image *image =
            render_gl_from(scene, params, 16, lsf_f3(0, 2, 0.5f), lsf_f3(0, 0, -0.2f));
        mean_rgb(image, 0, rgb[i]);
        lsf_image_destroy(image);
    }
    print_message("by VPLs %.5f, by bundles %.5f\n", rgb[0][0], rgb[1][0]);
    assert_true(rgb[1][0] > 0.0 && fabs(rgb[0][0] / rgb[1][0] - 1.0) < 0.04);
    destroy_scene(scene);
}

static void light_scales(void **unused)
{
    (void)unused;
    static const float scales[] = {0x1p-60f, 0x1p60f};
    lsf_scene *scene = room(LIGHT_A | LIGHT_B, 1.0f);
    lsf_image *expected = render_corner(scene, bidirectional_params(4, 2), 24);
    for (int i = 0; i < 2; i++) {
        lsf_scene *scaled = room(LIGHT_A | LIGHT_B, scales[i]);
        lsf_image *image = render_corner(scaled, bidirectional_params(4, 2), 24);
        assert_scaled_pixels(image, expected, scales[i]);
        lsf_image_destroy(image);
        lsf_scene_destroy(scaled);
    }
    lsf_image_destroy(expected);
    lsf_scene_destroy(scene);
}

static void same_bits_again(void **unused)
{
    (void)unused;
    lsf_scene *scene = room(LIGHT_A | LIGHT_B, 1.0f);
    lsf_render_params params = corner_params(bidirectional_params(3, 2), 33);
    assert_same_for_any_threads(scene, &params);
    lsf_scene_destroy(scene);
}

/* Pictures of 1 x 1 and 7 x 13, an empty scene, one flat triangle, a camera in a surface, a light
 * in a surface. */
static void extremes(void **unused)
{
    (void)unused;
    assert_finite_extremes(bidirectional_params(4, 2), 0.0f);
}

/* Unequal numbers of samples, interleaved or not, have the same mean. */
static void counts_do_not_change_the_mean(void **unused)
{
    (void)unused;
    enum { OPTIONS = SMALL_MAP_OPTIONS + 3 };
    static const char *const options[4][OPTIONS] = {
        {SMALL_MAPS, "vpl.count=1", "bundle.count=1", "mis.beta=1"},
        {SMALL_MAPS, "vpl.count=3", "bundle.count=1", "mis.beta=2"},
        {SMALL_MAPS, "vpl.count=1", "bundle.count=4", "mis.beta=0.5"},
        {SMALL_MAPS, "vpl.count=6", "interleave.size=2", "mis.beta=1"},
    };
    lsf_scene *scene = room(LIGHT_A, 1.0f);
    double rgb[4][3];
    for (int i = 0; i < 4; i++) {
        lsf_render_params params = bidirectional_params(1024, 1);
        params.options = options[i];
        params.option_count = OPTIONS;
        lsf_image *image = render_corner(scene, params, 24);
        mean_rgb(image, 0, rgb[i]);
        lsf_image_destroy(image);
        print_message("%s %s %s: %.5f %.5f %.5f\n", options[i][4], options[i][5], options[i][6],
                      rgb[i][0], rgb[i][1], rgb[i][2]);
        for (int c = 0; c < 3; c++)
            assert_true(fabs(rgb[i][c] / rgb[0][c] - 1.0) <= 0.01);
    }
    lsf_scene_destroy(scene);
}

/* Both strategies' weights of one path, for densities over the range of floats and several
 * exponents. */
static void weights_sum_to_one(void **unused)
{
    (void)unused;
    enum { COUNT = 65 * 65 };
    static float pairs[COUNT][4];
    shader_folder folder;
    shader_folder_create(&folder);
    shader_folder_write(&folder, "weights.comp.glsl",
                        "#include \"lib/mis.glsl\"\n"
                        "layout(local_size_x = 65) in;\n"
                        "layout(std430, binding = 0) buffer block { vec4 p[]; };\n"
                        "void main()\n"
                        "{\n"
                        "    vec4 q = p[gl_GlobalInvocationID.x];\n"
                        "    p[gl_GlobalInvocationID.x].zw =\n"
                        "        vec2(mis_weight(q.x, q.y), mis_weight(q.y, q.x));\n"
                        "}\n");
    lsf_context *context = gl_test_context(gl_test_backend(), folder.path);
    lsf_error error = {0};
    lsf_program_desc desc = {.label = "weights", .files = {"weights.comp.glsl"}};
    GLuint program = lsf_program_get(context, &desc, &error);
    if (!program)
        fail_msg("%s", error.message);
    static const float betas[] = {0.0f, 0.5f, 1.0f, 2.0f, 8.0f};
    for (size_t b = 0; b < LSF_COUNT(betas); b++) {
        for (int i = 0; i < COUNT; i++) {
            pairs[i][0] = ldexpf(1.0f, 3 * (i % 65 - 32));
            pairs[i][1] = ldexpf(1.0f, 3 * (i / 65 - 32));
        }
        GLuint buffer = lsf_buffer_create(context, "pairs", sizeof pairs, pairs, 0, &error);
        glUseProgram(program);
        glUniform4f(LSF_LOCATION_STRATEGY, 1.0f, 1.0f, betas[b], 1.0f);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
        glDispatchCompute(65, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(buffer, 0, sizeof pairs, pairs);
        for (int i = 0; i < COUNT; i++) {
            assert_true(pairs[i][2] >= 0.0f && pairs[i][3] >= 0.0f);
            assert_true(fabsf(pairs[i][2] + pairs[i][3] - 1.0f) < 1e-5f);
        }
        lsf_buffer_destroy(context, &buffer);
    }
    gl_test_check(context);
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weights_sum_to_one), cmocka_unit_test(energy_in_a_furnace),
        cmocka_unit_test(white_furnace),      cmocka_unit_test(lights_add_up),
        cmocka_unit_test(strategies_agree),   cmocka_unit_test(bent_normals),
        cmocka_unit_test(light_scales),       cmocka_unit_test(same_bits_again),
        cmocka_unit_test(extremes),           cmocka_unit_test(counts_do_not_change_the_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
