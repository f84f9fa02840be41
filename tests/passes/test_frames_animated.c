/* Animated materials, lights and visibility: frames have the bits of new renderers', and of those
 * that a program makes by edits. */
#include <math.h>

#include "base/base.h"
#include "render_gl.h"

#include <lightsheaf/edit.h>

enum { SIZE = 16, SAMPLES = 1, FRAMES = 4 };

/* The last option holds only where voxels of what stands still are kept from frame to frame. */
typedef struct test_case {
    const char *technique;
    bool keeps_voxels;
} test_case;
static const test_case cases[] = {{"direct", false},     {"bidirectional", false},
                                  {"voxel_path", false}, {"voxel_path", true},
                                  {"cone", false},       {"substitute_tree", false}};
static const char *const options[] = {"voxel.resolution=32",  "rsm.resolution=64",
                                      "bundle.resolution=64", "vpl.shadow_resolution=64",
                                      "cloud.count=8192",     "voxel.jitter=off"};

/* A lamp that begins to glow, a box that changes colour and becomes glossy, and a quad, which are
 * nodes by these numbers; a point light that dims. */
typedef struct world {
    lsf_scene *scene;
    uint32_t lamp, box; /* materials */
    uint32_t box_node, lamp_node, quad_node;
} world;

static world build_world(void)
{
    world w = {.scene = build_scene()};
    lsf_scene *scene = w.scene;
    build_corner(scene);
    build_material(scene, 0.9f, 0.4f, 0.2f);
    w.box = scene->material_count - 1;
    build_box(scene, lsf_f3(-0.3f, 0, 0.2f), lsf_f3(0.2f, 0.6f, 0.7f), false);
    w.box_node = scene->node_count - 1;
    build_material(scene, 0.5f, 0.5f, 0.5f);
    w.lamp = scene->material_count - 1;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    w.lamp_node = scene->node_count - 1;
    build_material(scene, 0.3f, 0.8f, 0.4f);
    build_quad(scene, lsf_f3(0.4f, 0, 0), lsf_f3(1, 0, 0), lsf_f3(1, 0.8f, 0),
               lsf_f3(0.4f, 0.8f, 0));
    w.quad_node = scene->node_count - 1;
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    for (int c = 0; c < 3; c++)
        scene->lights[0].color[c] = 1.0f;
    build_environment(scene, 0.3f);
    return w;
}

#define EMISSIVE_STRENGTH "extensions/KHR_materials_emissive_strength/emissiveStrength"

static void animate(const world *w)
{
    lsf_scene *scene = w->scene;
    for (int c = 0; c < 3; c++)
        scene->materials[w->lamp].emissive_factor[c] = 1.0f;
    build_value(scene, LSF_KIND_MATERIAL, w->box, "pbrMetallicRoughness/baseColorFactor",
                (float[]){0.9f, 0.4f, 0.2f, 1, 0.1f, 0.4f, 1, 1});
    build_value(scene, LSF_KIND_MATERIAL, w->box, "pbrMetallicRoughness/roughnessFactor",
                (float[]){1, 0.5f});
    build_value(scene, LSF_KIND_MATERIAL, w->lamp, EMISSIVE_STRENGTH, (float[]){0, 4});
    build_value(scene, LSF_KIND_LIGHT, 0, "intensity", (float[]){5, 1});
}

static lsf_render_params params_of(const test_case *tested)
{
    return (lsf_render_params){LSF_RENDER_PARAMS_DEFAULTS,
                               .technique = tested->technique,
                               .width = SIZE,
                               .height = SIZE,
                               .samples = SAMPLES,
                               .bounces = 2,
                               .seed = 5,
                               .options = options,
                               .option_count =
                                   (uint32_t)LSF_COUNT(options) - !tested->keeps_voxels};
}

static lsf_renderer *create(lsf_context *context, const lsf_scene *scene, const test_case *tested)
{
    lsf_error error = {0};
    const lsf_render_params params = params_of(tested);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer)
        fail_msg("%s", error.message);
    return renderer;
}

static const lsf_view view = {.position = {2.5, 2.0, 3.0},
                              .forward = {-0.62f, -0.3f, -0.72f},
                              .up = {0, 1, 0},
                              .fov_y = 50.0f};

static lsf_image *run_frame(lsf_renderer *renderer, double time)
{
    lsf_error error = {0};
    const lsf_frame frame = {.time = time, .view = &view};
    lsf_image *image = NULL;
    if (lsf_renderer_begin_frame(renderer, &frame, &error) && lsf_renderer_run(renderer, &error))
        image = lsf_renderer_read(renderer, &error);
    if (!image)
        fail_msg("%s", error.message);
    return image;
}

/* Renders frames up to `time`, each compared with that of a new renderer; returns the last one. */
static lsf_image *run_frames(lsf_context *context, const lsf_scene *scene, const test_case *tested,
                             bool steady)
{
    lsf_renderer *renderer = create(context, scene, tested);
    const lsf_plan *plan = lsf_renderer_plan(renderer);
    lsf_image *image = NULL, *before = NULL;
    const size_t bytes = (size_t)SIZE * SIZE * 3 * sizeof(float);
    for (int k = 0; k < FRAMES; k++) {
        double time = 0.5 * k;
        lsf_image_destroy(before);
        before = image;
        image = run_frame(renderer, time);
        lsf_renderer *fresh = create(context, scene, tested);
        lsf_image *expected = run_frame(fresh, time);
        if (memcmp(image->pixels, expected->pixels, bytes) != 0)
            fail_msg("%s: frame %d differs from that of a new renderer", tested->technique, k);
        if (before && steady && k < FRAMES - 1)
            assert_memory_not_equal(image->pixels, before->pixels, bytes);
        lsf_image_destroy(expected);
        lsf_renderer_destroy(fresh);
    }
    /* Past the last key nothing changes any more. */
    assert_memory_equal(image->pixels, before->pixels, bytes);
    if (steady)
        assert_ptr_equal(plan, lsf_renderer_plan(renderer));
    lsf_image_destroy(before);
    lsf_renderer_destroy(renderer);
    return image;
}

/* What is animated, at its end, by edits of another scene. */
static void edit(const world *w)
{
    lsf_error error = {0};
    lsf_material_desc desc;
    lsf_light_desc light;
    assert_true(lsf_scene_get_material(w->scene, w->box, &desc, &error));
    memcpy(desc.base_color, (float[]){0.1f, 0.4f, 1, 1}, sizeof desc.base_color);
    desc.roughness = 0.5f;
    assert_true(lsf_scene_set_material(w->scene, w->box, &desc, &error));
    assert_true(lsf_scene_get_material(w->scene, w->lamp, &desc, &error));
    for (int c = 0; c < 3; c++)
        desc.emission[c] = 4.0f;
    assert_true(lsf_scene_set_material(w->scene, w->lamp, &desc, &error));
    assert_true(lsf_scene_get_light(w->scene, 0, &light, &error));
    for (int c = 0; c < 3; c++)
        light.intensity[c] = 1.0f;
    assert_true(lsf_scene_set_light(w->scene, 0, &light, &error));
}

static void materials_and_lights(void **unused)
{
    (void)unused;
    world animated = build_world(), edited = build_world();
    animate(&animated);
    finish_gl_scene(animated.scene);
    finish_gl_scene(edited.scene);
    edit(&edited);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    for (size_t t = 0; t < LSF_COUNT(cases); t++) {
        lsf_image *image = run_frames(context, animated.scene, &cases[t], true);
        lsf_renderer *renderer = create(context, edited.scene, &cases[t]);
        lsf_image *expected = run_frame(renderer, 0.0);
        assert_same_pixels(image, expected);
        lsf_renderer_destroy(renderer);
        lsf_image_destroy(expected);
        lsf_image_destroy(image);
    }
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(animated.scene);
    lsf_scene_destroy(edited.scene);
}

/* A lamp of which a mask cuts out more and more: paths join points of it that lie in voxels which
 * held it a frame before. */
static void masks(void **unused)
{
    (void)unused;
    world w = build_world();
    lsf_scene *scene = w.scene;
    scene->vertices.color = lsf_alloc(scene->vertices.count, 4 * sizeof(float));
    assert_non_null(scene->vertices.color);
    for (uint64_t i = 0; i < scene->vertices.count; i++) {
        float *color = scene->vertices.color + 4 * i;
        color[0] = color[1] = color[2] = 1.0f;
        color[3] = scene->vertices.position[3 * i] < -0.5f ? 0.0f : 1.0f;
    }
    lsf_material *lamp = &scene->materials[w.lamp];
    lamp->alpha_mode = LSF_ALPHA_MASK;
    lamp->double_sided = true;
    for (int c = 0; c < 3; c++)
        lamp->emissive_factor[c] = 1.0f;
    build_value(scene, LSF_KIND_MATERIAL, w.lamp, "alphaCutoff", (float[]){0.2f, 0.9f});
    build_value(scene, LSF_KIND_MATERIAL, w.lamp, EMISSIVE_STRENGTH, (float[]){40, 4});
    finish_gl_scene(scene);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    const test_case paths = {"voxel_path", false};
    lsf_image_destroy(run_frames(context, scene, &paths, true));
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(scene);
}

/* A box and a lamp that come, and a quad that goes at the last key. */
static void visibility(void **unused)
{
    (void)unused;
    world w = build_world();
    const char name[] = "extensions/KHR_node_visibility/visible";
    build_value(w.scene, LSF_KIND_NODE, w.box_node, name, (float[]){0, 1});
    build_value(w.scene, LSF_KIND_NODE, w.quad_node, name, (float[]){1, 0});
    build_value(w.scene, LSF_KIND_NODE, w.lamp_node, name, (float[]){0, 1});
    w.scene->materials[w.lamp].emission[1] = 4.0f;
    finish_gl_scene(w.scene);
    assert_true(w.scene->requirements.moving);
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    for (size_t t = 0; t < LSF_COUNT(cases); t++)
        lsf_image_destroy(run_frames(context, w.scene, &cases[t], false));
    gl_test_check(context);
    lsf_context_destroy(context);
    lsf_scene_destroy(w.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_and_lights),
        cmocka_unit_test(masks),
        cmocka_unit_test(visibility),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
