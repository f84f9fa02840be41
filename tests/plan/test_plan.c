/* Scenes that differ in one feature each: the plan's passes, bytes and switches differ by just what
 * that feature needs. Needs no GL. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../scene/build_scene.h"
#include "base/base.h"
#include "frame/resources.h"
#include "techniques/setup.h"

enum { WIDTH = 40, HEIGHT = 30, PIXELS = WIDTH * HEIGHT };

typedef void (*feature)(lsf_scene *scene, lsf_material *material);

/* A floor under one point light, with a feature added. */
static lsf_plan *plan_with(feature add, uint32_t aovs)
{
    lsf_scene *scene = build_scene();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    lsf_material *material = build_material(scene, 0.5f, 0.5f, 0.5f);
    if (add)
        add(scene, material);
    build_floor(scene, 0.0f, 1.0f);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    params.width = WIDTH;
    params.height = HEIGHT;
    params.aovs = aovs;
    lsf_error error = {0};
    lsf_plan *plan = lsf_plan_create(scene, &params, &error);
    if (!plan)
        fail_msg("%s", error.message);
    destroy_scene(scene);
    return plan;
}

/* Prints and counts the resources and passes that only one plan has; checks the bytes of the rest
 * are equal. */
static uint64_t added(const lsf_plan *base, const lsf_plan *plan, const char *names[9])
{
    uint64_t count = 0;
    for (uint64_t i = 0; i < plan->resource_count; i++) {
        const lsf_plan_resource *in_base = lsf_plan_find(base, plan->resources[i].name);
        if (!in_base)
            names[count++] = plan->resources[i].name;
    }
    for (uint64_t i = 0; i < base->resource_count; i++) {
        const lsf_plan_resource *in_plan = lsf_plan_find(plan, base->resources[i].name);
        assert_non_null(in_plan);
        if (strcmp(base->resources[i].name, "scene.materials") != 0)
            assert_int_equal(in_plan->bytes, base->resources[i].bytes);
    }
    return count;
}

/* The switches that are not equal in both plans, as "pass.NAME " in order. */
static void changed_switches(const lsf_plan *base, const lsf_plan *plan, char *out, size_t size)
{
    out[0] = '\0';
    for (uint64_t p = 0; p < plan->pass_count; p++)
        for (uint32_t s = 0; s < plan->passes[p].switch_count; s++) {
            const lsf_define *define = &plan->passes[p].switches[s].define;
            const char *pass = plan->passes[p].name;
            if (lsf_plan_find_pass(base, pass) &&
                lsf_plan_switch_value(base, pass, define->name) != define->value) {
                size_t length = strlen(out);
                snprintf(out + length, size - length, "%s.%s ", pass, define->name);
            }
        }
}

static void check_feature(feature add, uint32_t aovs, uint64_t count, const char *const *expected,
                          uint64_t bytes, const char *switches, int extra_passes)
{
    lsf_plan *base = plan_with(NULL, 0), *plan = plan_with(add, aovs);
    const char *names[10];
    char changed[512];
    assert_int_equal(added(base, plan, names), count);
    for (uint64_t i = 0; i < count; i++)
        assert_string_equal(names[i], expected[i]);
    assert_int_equal(lsf_plan_bytes(plan) - lsf_plan_bytes(base), bytes);
    changed_switches(base, plan, changed, sizeof changed);
    assert_string_equal(changed, switches);
    assert_int_equal((int)plan->pass_count - (int)base->pass_count, extra_passes);
    lsf_plan_destroy(base);
    lsf_plan_destroy(plan);
}

static void make_glossy(lsf_scene *scene, lsf_material *material)
{
    (void)scene;
    material->roughness = 0.5f;
}

static void specular_params(void **unused)
{
    (void)unused;
    const char *const names[] = {"gbuffer.specular_params"};
    check_feature(make_glossy, 0, 1, names, PIXELS * 4,
                  "gbuffer.LSF_SPECULAR_PARAMS gbuffer.LSF_SPECULAR_PARAMS_TARGET "
                  "direct_light.LSF_SPECULAR_PARAMS ",
                  0);
}

static void make_emissive(lsf_scene *scene, lsf_material *material)
{
    (void)scene;
    material->emission[0] = 1.0f;
}

static void emission(void **unused)
{
    (void)unused;
    const char *const names[] = {"gbuffer.emission", "compose.radiance"};
    check_feature(make_emissive, 0, 2, names, PIXELS * (16 + 16),
                  "gbuffer.LSF_EMISSION gbuffer.LSF_EMISSION_TARGET ", 1);
}

static void make_sunny(lsf_scene *scene, lsf_material *material)
{
    (void)material;
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(0, -1, 0), 1.0f);
}

static void directional_light(void **unused)
{
    (void)unused;
    const char *const names[] = {"shadow_map.cascades_depth", "shadow_map.cascades_gradient"};
    check_feature(make_sunny, 0, 2, names, (uint64_t)4 * 128 * 128 * (4 + 4),
                  "direct_light.LSF_DIRECTIONAL_LIGHT ", 0);
}

static void make_masked(lsf_scene *scene, lsf_material *material)
{
    (void)scene;
    material->alpha_mode = LSF_ALPHA_MASK;
    material->alpha_cutoff = 0.5f;
}

static void mask(void **unused)
{
    (void)unused;
    check_feature(make_masked, 0, 0, NULL, 0, "gbuffer.LSF_MASK shadow_map.LSF_MASK ", 0);
}

static void make_environment(lsf_scene *scene, lsf_material *material)
{
    (void)material;
    scene->environment = (lsf_environment){.present = true, .radiance = {1, 1, 1}};
}

static void environment(void **unused)
{
    (void)unused;
    const char *const names[] = {
        "sky_map.map",          "sky_map.depth",     "sky_map.maps",   "scene.triangles",
        "open_sky.irradiance",  "open_sky.specular", "open_sky.drawn", "open_sky.drawn_staging",
        "direct_light.control", "compose.radiance"};
    /* Eight maps of 128 texels a side, which share a depth buffer; 16 slots of 128 bytes; two
     * triangles; 1024 directions, and those of three iterations; two pictures of light without
     * shadows and three layers */
    check_feature(make_environment, 0, 10, names,
                  (uint64_t)128 * 128 * (8 + 1) * 4 + 16 * 128 + 2 * 36 + 4 * 1024 * 32 +
                      (uint64_t)PIXELS * 16 * (2 + 3 + 1),
                  "direct_light.LSF_DIRECTIONAL_LIGHT ", 4);
}

static void make_textured(lsf_scene *scene, lsf_material *material)
{
    static const uint8_t texels[4 * 2 * 3];
    material->base_color_texture.texture = build_texture(scene, 4, 2, 3, texels, true);
}

static void base_color_texture(void **unused)
{
    (void)unused;
    const char *const names[] = {"scene.texture.0"};
    /* 4x2 + 2x1 + 1x1 texels of RGBA16F; the UVs are counted where they are */
    lsf_plan *plan = plan_with(make_textured, 0);
    assert_int_equal(lsf_plan_find(plan, names[0])->bytes, (8 + 2 + 1) * 8);
    assert_non_null(lsf_plan_find(plan, "scene.uv0"));
    lsf_plan_destroy(plan);
}

static void layers(void **unused)
{
    (void)unused;
    const char *const names[] = {"gbuffer.motion", "scene.previous_transforms"};
    lsf_plan *plan = plan_with(NULL, LSF_AOV_MOTION | LSF_AOV_ALBEDO);
    for (int i = 0; i < 2; i++)
        assert_non_null(lsf_plan_find(plan, names[i]));
    assert_non_null(lsf_plan_find(plan, "accumulate.albedo"));
    lsf_plan_destroy(plan);
}

static void no_light_no_shadow(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    build_material(scene, 1, 1, 1);
    build_floor(scene, 0.0f, 1.0f);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    lsf_plan *plan = lsf_plan_create(scene, &params, NULL);
    assert_null(lsf_plan_find_pass(plan, "shadow_map"));
    assert_null(lsf_plan_find_pass(plan, "direct_light"));
    lsf_plan_destroy(plan);
    destroy_scene(scene);
}

static void bad_params(void **unused)
{
    (void)unused;
    lsf_scene *scene = build_scene();
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    static const char *const bad[] = {"shadow.filter",        "shadow.filter=soft",
                                      "shadow.nothing=1",     "shadow.texels_per_pixel=1e9",
                                      "shadow.filter=pcf ",   "shadow.texels_per_pixel=nan",
                                      "bundle.resolution=15", "rsm.resolution=15"};
    for (size_t i = 0; i < LSF_COUNT(bad); i++) {
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
        params.technique = "direct";
        lsf_error error = {0};
        params.options = &bad[i];
        params.option_count = 1;
        assert_null(lsf_plan_create(scene, &params, &error));
        assert_int_equal(error.code, LSF_ERROR_USAGE);
        assert_non_null(strstr(error.message, bad[i]));
    }
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true};
    params.technique = "direct";
    lsf_error error = {0};
    params.camera = "nowhere";
    assert_null(lsf_plan_create(scene, &params, &error));
    assert_int_equal(error.code, LSF_ERROR_USAGE);
    params.camera = NULL;
    static const uint32_t bounces[] = {1001, 1u << 31, UINT32_MAX - 1};
    for (size_t i = 0; i < LSF_COUNT(bounces); i++) {
        params.bounces = bounces[i];
        assert_null(lsf_plan_create(scene, &params, &error));
        assert_non_null(strstr(error.message, "bounces"));
    }
    params.bounces = 1;
    params.camera_target = (const float[]){0.0f, NAN, 0.0f};
    assert_null(lsf_plan_create(scene, &params, &error));
    assert_non_null(strstr(error.message, "finite"));
    params.camera_target = NULL;
    params.time = NAN;
    assert_null(lsf_plan_create(scene, &params, &error));
    assert_non_null(strstr(error.message, "time"));
    destroy_scene(scene);
}

/* Before GL is asked for anything. */
static void only_what_is_planned_is_created(void **state)
{
    (void)state;
    static const char *const files[5] = {"passes/none.comp.glsl"};
    lsf_plan *plan = calloc(1, sizeof *plan);
    assert_non_null(plan);
    lsf_plan_texture_add(plan, "test.texture", GL_R32F, 4, 4, "test");
    GLuint name = 0;
    lsf_error error = {0};
    assert_false(lsf_plan_create_texture(plan, NULL, "test.textures", &name, &error));
    assert_non_null(strstr(error.message, "test.textures"));
    assert_false(lsf_plan_create_buffer(plan, NULL, "test.texture", NULL, 0, &name, &error));
    assert_false(lsf_plan_resize_buffer(plan, NULL, "test.buffer", 4, 0, &name, &error));
    assert_int_equal(lsf_plan_program(plan, NULL, "test", files, &error), 0);
    assert_true(lsf_plan_create_texture_if_planned(plan, NULL, "test.other", &name, &error));
    assert_int_equal(name, 0);
    lsf_plan_destroy(plan);
}

static lsf_scene *lit_floor(void)
{
    lsf_scene *scene = build_scene();
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 2, 0), lsf_f3(0, -1, 0), 1.0f);
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_floor(scene, 0.0f, 1.0f);
    finish_scene(scene);
    lsf_scene_compute_requirements(scene);
    return scene;
}

/* What is planned for a picture of indirect light seen at one point of each pixel; NULL with an
 * error. */
static lsf_plan *plan_points(const char *technique, double time_limit, uint32_t width, bool raw,
                             const char *option, lsf_error *error)
{
    const char *const options[] = {"gbuffer.side=1", option};
    lsf_scene *scene = lit_floor();
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
    params.technique = technique;
    params.time_limit = time_limit;
    params.width = params.height = width;
    params.raw = raw;
    params.options = options;
    params.option_count = option ? 2 : 1;
    lsf_plan *plan = lsf_plan_create(scene, &params, error);
    destroy_scene(scene);
    return plan;
}

/* Fewer points than pixels where a first iteration would take too long, with a word on it. */
static void points_where_they_pay(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique;
        double time_limit;
        uint32_t width;
        bool raw;
        const char *option;
        uint32_t stride;
    } cases[] = {
        {"voxel_path", 1.0, 1024, false, NULL, 4},
        {"voxel_path", 0.1, 1024, false, NULL, 16},
        {"voxel_path", 1e-3, 4096, false, NULL, 16},
        {"cone", 1.0, 1024, false, NULL, 2},
        {"substitute_tree", 1.0, 1024, false, NULL, 4},
        {"voxel_path", 8.0, 1024, false, NULL, 1},
        {"voxel_path", 1.0, 256, false, NULL, 1},
        {"voxel_path", INFINITY, 4096, false, NULL, 1},
        {"voxel_path", 1.0, 1024, true, NULL, 1},
        {"voxel_path", 1.0, 1024, false, "sparse.grid=1", 1},
        {"bidirectional", 1.0, 1024, false, NULL, 4},
        {"bidirectional", 8.0, 1024, false, NULL, 1},
        {"bidirectional", INFINITY, 64, true, "sparse.grid=16", 16},
        {"direct", 1.0, 1024, false, "sparse.grid=16", 1},
    };
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_error error = {0};
        lsf_plan *plan = plan_points(cases[i].technique, cases[i].time_limit, cases[i].width,
                                     cases[i].raw, cases[i].option, &error);
        if (!plan)
            fail_msg("%s", error.message);
        bool sparse = cases[i].stride > 1, told = false;
        for (uint64_t r = 0; r < plan->remark_count; r++)
            told |= strstr(plan->remarks[r], "sparse.grid") != NULL;
        assert_int_equal(plan->stride, cases[i].stride);
        assert_int_equal(told, sparse);
        assert_int_equal(lsf_plan_find_pass(plan, "sparse_fit") != NULL, sparse);
        assert_int_equal(lsf_plan_find(plan, "upsampled.irradiance") != NULL, sparse);
        lsf_plan_destroy(plan);
    }
}

/* An option that is gone names what does its work now. */
static void replaced_options(void **unused)
{
    (void)unused;
    static const char *const options[][2] = {
        {"cone.scale=0.5", "sparse.grid"},
        {"voxel_path.scale=0.5", "sparse.grid"},
        {"blur.phases=5", "sparse.blur"},
        {"blur.slope=1", "sparse.blur"},
        {"upsample_search.slope=1", "sparse.slope"},
        {"interleave.periods=2", "sparse.blur"},
        {"cone.scales=1", "no such option of a pass"},
    };
    for (size_t i = 0; i < LSF_COUNT(options); i++) {
        lsf_error error = {0};
        assert_null(plan_points("cone", INFINITY, 64, false, options[i][0], &error));
        assert_int_equal(error.code, LSF_ERROR_USAGE);
        assert_non_null(strstr(error.message, options[i][1]));
    }
}

static uint64_t shadow_map_bytes(double time_limit, uint32_t width, bool raw, const char *option)
{
    lsf_error error = {0};
    lsf_plan *plan = plan_points("bidirectional", time_limit, width, raw, option, &error);
    if (!plan)
        fail_msg("%s", error.message);
    uint64_t bytes = lsf_plan_find(plan, "shadow_map.cube_depth")->bytes;
    lsf_plan_destroy(plan);
    return bytes;
}

/* Where the time is short for the picture, shadow maps have a quarter of the texels. */
static void coarse_shadows_where_time_is_short(void **unused)
{
    (void)unused;
    uint64_t fine = shadow_map_bytes(INFINITY, 1024, false, NULL);
    assert_int_equal(shadow_map_bytes(8.0, 1024, false, NULL), fine);
    assert_int_equal(shadow_map_bytes(1.0, 1024, true, NULL), fine);
    assert_int_equal(shadow_map_bytes(1.0, 1024, false, "shadow.texels_per_pixel=16"), fine);
    uint64_t coarse = shadow_map_bytes(1.0, 1024, false, NULL);
    assert_true(4 * coarse > fine - fine / 50 && 4 * coarse < fine + fine / 50);
}

/* Few voxels where the time is short; a GPU has time for all. */
static void voxels_by_time(void **unused)
{
    (void)unused;
    static const struct {
        double time_limit;
        bool raw, software;
        uint32_t voxels;
    } cases[] = {{1e-3, false, true, 32},     {1.0, false, true, 64}, {4.0, false, true, 112},
                 {60.0, false, true, 128},    {1.0, true, true, 128}, {1.0, false, false, 128},
                 {INFINITY, false, true, 128}};
    lsf_scene *scene = lit_floor();
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
    params.technique = "cone";
    params.width = params.height = 1024;
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_setup setup;
        lsf_error error = {0};
        params.time_limit = cases[i].time_limit;
        params.raw = cases[i].raw;
        if (!lsf_setup_init(&setup, scene, &params, cases[i].software, &error))
            fail_msg("%s", error.message);
        uint64_t width = lsf_plan_find(setup.plan, "voxelize.albedo")->texture.width;
        assert_int_equal(width, cases[i].voxels);
        assert_true(!setup.plan->hurried || cases[i].software);
        lsf_setup_finish(&setup);
    }
    destroy_scene(scene);
}

/* Texels of bundles and of a point light's map narrow as iterations take the noise away, if their
 * number is known. */
static void maps_by_iterations(void **unused)
{
    (void)unused;
    static const struct {
        uint32_t samples;
        double time_limit;
        const char *option;
        int side;
        uint32_t map_side;
    } cases[] = {{16, INFINITY, NULL, 256, 64},
                 {32, INFINITY, NULL, 256, 80},
                 {512, INFINITY, NULL, 512, 160},
                 {256, INFINITY, NULL, 432, 128},
                 {1u << 20, INFINITY, NULL, 768, 256},
                 {UINT32_MAX, INFINITY, NULL, 256, 64},
                 {UINT32_MAX, 16.0, NULL, 256, 80},
                 {UINT32_MAX, 256.0, NULL, 512, 160},
                 {512, 1.0, NULL, 256, 64},
                 {256, INFINITY, "bundle.resolution=96", 96, 128},
                 {256, INFINITY, "rsm.resolution=48", 432, 48}};
    lsf_scene *scene = lit_floor();
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        lsf_error error = {0};
        lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .bounces = 1};
        params.samples = cases[i].samples;
        params.time_limit = cases[i].time_limit;
        params.options = &cases[i].option;
        params.option_count = cases[i].option ? 1 : 0;
        lsf_plan *plan = lsf_plan_create(scene, &params, &error);
        if (!plan)
            fail_msg("%s", error.message);
        char maps[32];
        snprintf(maps, sizeof maps, "%d x %d texels", cases[i].side, cases[i].side);
        assert_non_null(strstr(lsf_plan_find_pass(plan, "ray_bundle_build")->why, maps));
        const lsf_plan_resource *map = lsf_plan_find(plan, "reflective_shadow_map.cube_depth");
        assert_int_equal(map->texture.width, cases[i].map_side);
        lsf_plan_destroy(plan);
    }
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(specular_params),
        cmocka_unit_test(emission),
        cmocka_unit_test(directional_light),
        cmocka_unit_test(mask),
        cmocka_unit_test(environment),
        cmocka_unit_test(base_color_texture),
        cmocka_unit_test(layers),
        cmocka_unit_test(no_light_no_shadow),
        cmocka_unit_test(bad_params),
        cmocka_unit_test(only_what_is_planned_is_created),
        cmocka_unit_test(points_where_they_pay),
        cmocka_unit_test(coarse_shadows_where_time_is_short),
        cmocka_unit_test(voxels_by_time),
        cmocka_unit_test(maps_by_iterations),
        cmocka_unit_test(replaced_options),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
