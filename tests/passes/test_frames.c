/* A renderer that goes from frame to frame has in each the bits of one that was made for it. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

#include <lightsheaf/edit.h>

enum { SIZE = 16, SAMPLES = 2 };

static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                         "substitute_tree"};

/* --- a scene that moves -------------------------------------------------------------------------
 */

enum { NODE_BOX, NODE_LAMP, NODE_LIGHT, NODE_SPINNING, NODE_JOINT, NODES };

typedef struct world {
    lsf_scene *scene;
    uint32_t nodes[NODES];
    uint32_t lamp, sheet, banner; /* materials */
} world;

/* A banner that joints bend and a morph target shifts; it is of the last material. Its lower
 * joint. */
static uint32_t build_banner(lsf_scene *scene)
{
    static const float turn[] = {0, 0, 0, 1, 0.6f, 0, 0, 0.8f}, weights[] = {0, 1};
    build_quad(scene, lsf_f3(-1.6f, 0, 0.5f), lsf_f3(-0.9f, 0, 0.5f), lsf_f3(-0.9f, 1.8f, 0.5f),
               lsf_f3(-1.6f, 1.8f, 0.5f));
    uint32_t banner = scene->node_count - 1;
    uint32_t joint = build_deformer(scene, lsf_f3(0.4f, 0.1f, 0.3f));
    build_channel(scene, joint, LSF_PATH_ROTATION, turn, sizeof turn);
    build_channel(scene, banner, LSF_PATH_WEIGHTS, weights, sizeof weights);
    return joint - 1;
}

typedef enum sky { NO_SKY, UNIFORM_SKY, SKY_MAP } sky;

/* Bright in one part, so that it matters how it is turned. */
static void build_sky(lsf_scene *scene, sky kind)
{
    enum { WIDTH = 8, HEIGHT = 4 };
    lsf_environment *environment = &scene->environment;
    if (kind != NO_SKY)
        build_environment(scene, 0.3f);
    if (kind != SKY_MAP)
        return;
    environment->width = WIDTH;
    environment->height = HEIGHT;
    environment->texels = lsf_alloc(WIDTH * HEIGHT, 3 * sizeof *environment->texels);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        environment->texels[i] =
            0.05f + 2.0f * (float)(i / 3 == WIDTH + 2) + 0.02f * (float)(i % 7);
}

static world build_world(bool animated, sky kind)
{
    world w = {.scene = build_scene()};
    lsf_scene *scene = w.scene;
    build_corner(scene);
    build_material(scene, 0.9f, 0.4f, 0.2f);
    build_box(scene, lsf_f3(-0.3f, 0, 0.2f), lsf_f3(0.2f, 0.6f, 0.7f), false);
    w.nodes[NODE_BOX] = scene->node_count - 1;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    w.lamp = scene->material_count - 1;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    w.nodes[NODE_LAMP] = scene->node_count - 1;
    build_material(scene, 0.3f, 0.8f, 0.4f);
    w.sheet = scene->material_count - 1;
    build_quad(scene, lsf_f3(0.4f, 0, 0), lsf_f3(1, 0, 0), lsf_f3(1, 0.8f, 0),
               lsf_f3(0.4f, 0.8f, 0));
    w.nodes[NODE_SPINNING] = scene->node_count - 1;
    build_material(scene, 0.8f, 0.8f, 0.2f);
    w.banner = scene->material_count - 1;
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    w.nodes[NODE_LIGHT] = scene->node_count - 1;
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
    build_sky(scene, kind);
    if (animated) {
        static const float half_a_turn[] = {0, 0, 0, 1, 0, 1, 0, 0};
        build_channel(scene, w.nodes[NODE_SPINNING], LSF_PATH_ROTATION, half_a_turn,
                      sizeof half_a_turn);
        w.nodes[NODE_JOINT] = build_banner(scene);
    }
    finish_gl_scene(scene);
    return w;
}

static void translate(const world *w, int node, double x, double y, double z)
{
    lsf_error error = {0};
    const double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
    if (!lsf_scene_set_node(w->scene, w->nodes[node], matrix, &error))
        fail_msg("%s", error.message);
}

static void edit_material(const world *w, uint32_t material, lsf_material_desc desc)
{
    lsf_error error = {0};
    if (!lsf_scene_set_material(w->scene, material, &desc, &error))
        fail_msg("%s", error.message);
}

static lsf_material_desc material_of(const world *w, uint32_t material)
{
    lsf_material_desc desc;
    lsf_error error = {0};
    assert_true(lsf_scene_get_material(w->scene, material, &desc, &error));
    return desc;
}

static void set_light(const world *w, lsf_light_type type, float intensity)
{
    lsf_error error = {0};
    const lsf_light_desc desc = {.type = type,
                                 .intensity = {intensity, intensity, 0.8f * intensity},
                                 .range = INFINITY,
                                 .outer_cone = 0.6f};
    if (!lsf_scene_set_light(w->scene, 0, &desc, &error))
        fail_msg("%s", error.message);
}

static void turn_environment(const world *w, float rotation, float strength)
{
    lsf_error error = {0};
    if (!lsf_scene_set_environment_rotation(w->scene, rotation, &error) ||
        !lsf_scene_set_environment_strength(w->scene, strength, &error))
        fail_msg("%s", error.message);
}

/* --- what happens in frame k: a little in each, and now and then what asks for another plan */

enum { FRAMES = 12 };

static lsf_view view_at(int k)
{
    float angle = 0.6f + 0.05f * (float)k;
    return (lsf_view){.position = {4.0 * sin((double)angle), 2.0, 4.0 * cos((double)angle)},
                      .forward = {-sinf(angle), -0.3f, -cosf(angle)},
                      .up = {0, 1, 0},
                      .fov_y = 50.0f,
                      .height = k == 10 ? 3.0f : 0.0f};
}

static void edit_frame(const world *w, int k)
{
    lsf_material_desc lamp = material_of(w, w->lamp), sheet = material_of(w, w->sheet);
    if (k > 0)
        translate(w, NODE_BOX, 0.05 * k, 0.0, 0.02 * k);
    if (k == 2 || k == 4)
        translate(w, NODE_LIGHT, 1.0, 2.0 - 0.1 * k, 0.8);
    if (k == 3)
        set_light(w, LSF_LIGHT_SPOT, 9.0f);
    if (k == 5) { /* the first emitter */
        lamp.emission[0] = lamp.emission[1] = 3.0f;
        edit_material(w, w->lamp, lamp);
    }
    if (k == 6) {
        lsf_material_desc banner = material_of(w, w->banner);
        translate(w, NODE_LAMP, 0.3, -0.2, 0.0);
        banner.emission[1] = 2.0f;
        edit_material(w, w->banner, banner);
    }
    if (k == 7) {
        sheet.alpha_mode = LSF_ALPHA_MASK;
        sheet.alpha_cutoff = 0.5f;
        sheet.base_color[3] = 0.4f;
        edit_material(w, w->sheet, sheet);
    }
    if (k == 8) {
        sheet.alpha_mode = LSF_ALPHA_OPAQUE;
        sheet.roughness = 0.2f;
        edit_material(w, w->sheet, sheet);
    }
    if (k >= 8 && w->nodes[NODE_JOINT]) /* by a program, no longer at rest */
        translate(w, NODE_JOINT, -1.0, 0.1 * (k - 7), 0.4);
    if (k == 9) /* out of what voxels held so far */
        translate(w, NODE_BOX, 2.5, 0.5, 0.0);
    if (k == 11)
        set_light(w, LSF_LIGHT_POINT, 0.0f);
    if (w->scene->environment.present && (k == 1 || k == 4 || k == 6 || k == 9))
        turn_environment(w, 50.0f * (float)k, k == 6 ? 0.0f : 0.5f * (float)k);
}

static lsf_render_params params_of(const char *technique, const char *const *options,
                                   uint32_t option_count)
{
    return (lsf_render_params){
        LSF_RENDER_PARAMS_DEFAULTS,  .technique = technique, .width = SIZE, .height = SIZE,
        .samples = SAMPLES,          .bounces = 2,           .seed = 5,     .options = options,
        .option_count = option_count};
}

static lsf_image *run_frame(lsf_renderer *renderer, const lsf_frame *frame)
{
    lsf_error error = {0};
    lsf_image *image = NULL;
    if (lsf_renderer_begin_frame(renderer, frame, &error) && lsf_renderer_run(renderer, &error))
        image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    return image;
}

static lsf_renderer *create(lsf_context *context, const lsf_scene *scene,
                            const lsf_render_params *params)
{
    lsf_error error = {0};
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static void assert_frames_are_those_of_new_renderers(const world *w,
                                                     const lsf_render_params *params)
{
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_renderer *renderer = create(context, w->scene, params);
    const size_t bytes = (size_t)SIZE * SIZE * 3 * sizeof(float);
    float before[SIZE * SIZE * 3] = {0};
    for (int k = 0; k < FRAMES; k++) {
        lsf_view view = view_at(k);
        const lsf_frame frame = {
            .time = 0.07 * k, .view = &view, .first_sample = (uint32_t)k * SAMPLES};
        edit_frame(w, k);
        lsf_image *image = run_frame(renderer, &frame);
        assert_int_equal(lsf_context_get_info(context).gl_bytes,
                         lsf_plan_bytes(lsf_renderer_plan(renderer)));
        lsf_renderer *fresh = create(context, w->scene, params);
        lsf_image *expected = run_frame(fresh, &frame);
        assert_memory_not_equal(image->pixels, before, bytes);
        memcpy(before, image->pixels, bytes);
        if (memcmp(image->pixels, expected->pixels, bytes) != 0)
            fail_msg("%s: frame %d differs from that of a new renderer", params->technique, k);
        lsf_image_destroy(image);
        lsf_image_destroy(expected);
        lsf_renderer_destroy(fresh);
    }
    lsf_renderer_destroy(renderer);
    assert_int_equal(lsf_context_get_info(context).gl_bytes, 0);
    gl_test_check(context);
    lsf_context_destroy(context);
}

static void every_technique(void **unused)
{
    (void)unused;
    static const char *const options[] = {"voxel.resolution=32", "rsm.resolution=64",
                                          "bundle.resolution=64", "vpl.shadow_resolution=64",
                                          "cloud.count=8192"};
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        world w = build_world(true, t % 2 ? SKY_MAP : UNIFORM_SKY);
        lsf_render_params params = params_of(techniques[t], options, LSF_COUNT(options));
        assert_frames_are_those_of_new_renderers(&w, &params);
        lsf_scene_destroy(w.scene);
    }
}

/* A grid that does not shift keeps voxels of what stands still from frame to frame. */
static void voxels_that_are_kept(void **unused)
{
    (void)unused;
    static const char *const options[] = {"voxel.jitter=off", "voxel.resolution=32"};
    world w = build_world(true, NO_SKY);
    lsf_render_params params = params_of("voxel_path", options, LSF_COUNT(options));
    assert_frames_are_those_of_new_renderers(&w, &params);
    lsf_scene_destroy(w.scene);
}

/* Polled in each frame, passes tell of each of its runs once; after another plan, means are those
 * of its passes alone. */
static void times_of_passes(void **unused)
{
    (void)unused;
    world w = build_world(false, NO_SKY);
    lsf_render_params params = params_of("direct", NULL, 0);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    lsf_renderer *renderer = create(context, w.scene, &params);
    const lsf_pass_time *times = NULL;
    double milliseconds = 0.0;
    uint64_t runs = 0;
    for (int k = 0; k < 6; k++) {
        if (k == 3) /* another plan */
            set_light(&w, LSF_LIGHT_SPOT, 9.0f);
        const lsf_frame frame = {.first_sample = (uint32_t)k * SAMPLES};
        lsf_image_destroy(run_frame(renderer, &frame));
        uint32_t count = lsf_renderer_poll_times(renderer, &times);
        assert_in_range(count, 3, 20);
        for (uint32_t i = 0; i < count; i++) {
            assert_int_equal(times[i].runs % SAMPLES, 0);
            assert_true(times[i].runs > 0 && times[i].milliseconds > 0.0);
        }
        assert_string_equal(times[0].name, "gbuffer");
        milliseconds = k < 3 ? 0.0 : milliseconds + times[0].milliseconds;
        runs = k < 3 ? 0 : runs + times[0].runs;
        assert_int_equal(lsf_renderer_poll_times(renderer, &times), count);
        for (uint32_t i = 0; i < count; i++)
            assert_int_equal(times[i].runs, 0);
    }
    const lsf_renderer_stats stats = lsf_renderer_get_stats(renderer);
    assert_string_equal(stats.passes[0].name, "gbuffer");
    assert_int_equal(stats.passes[0].runs, runs);
    double mean = milliseconds / (3 * SAMPLES);
    assert_true(fabs(stats.passes[0].milliseconds - mean) <= 1e-9 * mean);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    lsf_scene_destroy(w.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_technique),
        cmocka_unit_test(voxels_that_are_kept),
        cmocka_unit_test(times_of_passes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
