/* What a shader is given of a scene, against closed forms: a floor of two metres a side in y = 0
 * with a box on it, a point light above. */
#include "sandbox_rig.h"

#include <math.h>

#include "base/base.h"
#include "plan/plan.h"

#define IMAGE "void mainImage(out vec4 c, in vec2 p)\n"

/* Half extent 1: normalised space is the scene's, but for its centre, (0, 0.25, 0). */
static lsf_scene *make_scene(void)
{
    lsf_scene *scene = build_scene();
    build_material(scene, 0.75f, 0.5f, 0.25f);
    build_floor(scene, 0, 1);
    build_material(scene, 0.25f, 0.5f, 0.75f);
    build_box(scene, lsf_f3(-0.25f, 0.125f, -0.25f), lsf_f3(0.25f, 0.5f, 0.25f), false);
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(0, 1.25f, 0), lsf_f3(0, -1, 0), 3);
    finish_gl_scene(scene);
    return scene;
}

/* One pixel of a picture that looks down on it at a slant. */
static void check(const char *text, uint32_t x, uint32_t y, float r, float g, float b,
                  float tolerance)
{
    static const float eye[3] = {0, 2, 2}, target[3] = {0, 0, 0};
    const float expected[3] = {r, g, b};
    lsf_scene *scene = make_scene();
    lsf_sandbox_params params = sandbox_params(text);
    params.render.camera_position = eye;
    params.render.camera_target = target;
    params.render.technique = "direct";
    lsf_image *image = sandbox_picture(scene, &params, 1);
    const float *rgb = image->pixels + 3 * ((63 - y) * 64 + x);
    for (int c = 0; c < 3; c++)
        if (!(fabsf(rgb[c] - expected[c]) <= tolerance))
            fail_msg("%s\n%g %g %g is not %g %g %g", text, (double)rgb[0], (double)rgb[1],
                     (double)rgb[2], (double)r, (double)g, (double)b);
    lsf_image_destroy(image);
    destroy_scene(scene);
}

static void test_gbuffer(void **state)
{
    (void)state;
    /* On the floor, before the box. */
    check(IMAGE "{ c = vec4(lsf_position(p).y, lsf_normal(p).y, float(lsf_seen(p)), 1.0); }", 32,
          10, -0.25f, 1, 1, 1e-4f);
    check(IMAGE "{ c = vec4(lsf_albedo(p), 1.0); }", 32, 10, 0.75f, 0.5f, 0.25f, 1e-4f);
    check(IMAGE "{ surface s = lsf_surface(p); c = vec4(s.roughness, s.metallic, s.f0, 1.0); }", 32,
          10, 1, 0, 0.04f, 1e-4f);
    /* The camera's ray comes to the same point; the view's axis is (0, -1, -1) / sqrt(2). */
    check(IMAGE
          "{ vec3 d = lsf_camera_direction(p), o = lsf_camera_position(p);\n"
          "vec3 q = o + d * (-0.25 - o.y) / d.y;\n"
          "c = vec4(length(q - lsf_position(p)), lsf_depth(p) - dot(q - vec3(0.0, 1.75, 2.0), "
          "vec3(0.0, -1.0, -1.0)) * inversesqrt(2.0), lsf_metres(2.0), 1.0); }",
          32, 10, 0, 0, 2, 1e-4f);
    /* Beside the floor. */
    check(IMAGE "{ c = vec4(float(lsf_seen(p)), isinf(lsf_depth(p)) ? 1.0 : 0.0, 0.0, 1.0); }", 0,
          0, 0, 1, 0, 0);
}

static void test_lights(void **state)
{
    (void)state;
    check(IMAGE "{ vec3 d, q = vec3(0.5, -0.25, 0.25), l = vec3(0.0, 1.0, 0.0) - q;\n"
                "vec3 e = lsf_light(0, q, d);\n"
                "c = vec4(e.g * dot(l, l), dot(d, normalize(l)), lsf_light_count(), 1.0); }",
          0, 0, 3, 1, 1, 1e-4f);
    /* The box's shadow ends 0.4167 from the middle. */
    check(IMAGE "{ vec3 up = vec3(0.0, 1.0, 0.0);\n"
                "c = vec4(lsf_visibility(vec3(0.35, -0.25, 0.0), up), lsf_visibility(vec3(0.5, "
                "-0.25, 0.0), up), lsf_visibility(vec3(0.0, 0.25, 0.1), up), 1.0); }",
          0, 0, 0, 1, 1, 0);
    /* What the light reaches lies in its surfaces: on the floor, on the box's top. */
    check("// @define rsm.resolution=32\n" IMAGE
          "{ ivec3 size = lsf_reflective_size(); int seen = 0, bad = 0;\n"
          "for (int f = 0; f < size.z; f++) for (int i = 0; i < size.x * size.y; i++) {\n"
          "    vec3 q; surface s;\n"
          "    if (!lsf_reflective(ivec3(i % size.x, i / size.x, f), q, s)) continue;\n"
          "    seen++;\n"
          "    bool floor_ = abs(q.y + 0.25) < 1e-3 && s.base_color.r > 0.7;\n"
          "    bool top = abs(q.y - 0.25) < 1e-3 && s.base_color.r < 0.3;\n"
          "    bad += floor_ || top ? 0 : 1; }\n"
          "c = vec4(size.x, float(seen > 32), float(bad), 1.0); }",
          0, 0, 32, 1, 0, 0);
    check(IMAGE "{ c = vec4(lsf_environment(vec3(0.0, 1.0, 0.0)), 1.0); }", 0, 0, 0, 0, 0, 0);
}

static void test_voxels(void **state)
{
    (void)state;
    static const char voxels[] = "// @define voxel.resolution=64\n";
    char text[1024];
    /* Down on the box's top, 0.75 below; a voxel is 2 / 62. */
    snprintf(text, sizeof text,
             "%s%s{ ivec3 cell; float d; bool met = lsf_voxel_trace(vec3(0.1, 1.0, 0.1), vec3(0.0, "
             "-1.0, 0.0), 9.0, cell, d);\nc = vec4(d, lsf_voxel_albedo(cell).b, "
             "abs(lsf_voxel_normal(cell).y), met); }",
             voxels, IMAGE);
    check(text, 0, 0, 0.75f, 0.75f, 1, 0.04f);
    /* Nothing above it, and beyond the end nothing counts. */
    snprintf(
        text, sizeof text,
        "%s%s{ ivec3 cell; float d; vec3 q = vec3(0.1, 1.0, 0.1), down = vec3(0.0, -1.0, 0.0);\n"
        "c = vec4(lsf_voxel_trace(q, -down, 9.0, cell, d), lsf_voxel_trace(q, down, 0.5, cell, "
        "d), lsf_voxel_trace(lsf_voxel_leave(vec3(0.1, 0.25, 0.1), -down), -down, 9.0, cell, "
        "d), 1.0); }",
        voxels, IMAGE);
    check(text, 0, 0, 0, 0, 0, 0);
    /* Radiance of its top: albedo / pi times 3 / 0.75^2. */
    snprintf(text, sizeof text,
             "%s%s{ ivec3 cell; float d; vec3 down = vec3(0.0, -1.0, 0.0);\n"
             "lsf_voxel_trace(vec3(0.01, 1.0, 0.01), down, 9.0, cell, d);\n"
             "vec4 seen = lsf_voxel_radiance(vec3(cell) + 0.5, down, 0.0);\n"
             "c = vec4(seen.rgb / seen.a, 1.0); }",
             voxels, IMAGE);
    check(text, 0, 0, 0.25f * 1.6977f, 0.5f * 1.6977f, 0.75f * 1.6977f, 0.06f);
}

static void test_bundle(void **state)
{
    (void)state;
    /* Through the box: its top and its bottom, and the floor; beside it the floor alone. */
    check("// @bundle 0 -1 0\n" IMAGE
          "{ c = vec4(lsf_bundle_count(ivec2(lsf_bundle_texel(vec3(0.0)))), "
          "lsf_bundle_count(ivec2(lsf_bundle_texel(vec3(0.7, 0.0, 0.6)))), "
          "-lsf_bundle_direction().y, 1.0); }",
          0, 0, 3, 1, 1, 1e-6f);
    /* In lists without places of their own as well; the depths of the three lie apart as they do.
     */
    check("// @bundle 0 -1 0\n// @define bundle.slices=0\n" IMAGE
          "{ ivec2 t = ivec2(lsf_bundle_texel(vec3(0.0))); float low = 1.0, high = 0.0; vec3 e;\n"
          "float blue = 0.0;\n"
          "for (int i = 0; i < lsf_bundle_count(t); i++) { uint n = lsf_bundle_node(t, i);\n"
          "    low = min(low, lsf_bundle_depth(n)); high = max(high, lsf_bundle_depth(n));\n"
          "    blue += lsf_bundle_surface(n, lsf_bundle_direction(), e).base_color.b; }\n"
          "c = vec4(lsf_bundle_count(t), (high - low) * bundle.range.y, blue, 1.0); }",
          0, 0, 3, 0.5f, 0.75f + 0.75f + 0.25f, 0.02f);
    /* From the floor up there is nothing; from there along it neither. */
    check("// @bundle 0 -1 0\n" IMAGE
          "{ float d; uint n; c = vec4(lsf_bundle_hit(p, d, n), 0.0, 0.0, 1.0); }",
          32, 6, 0, 0, 0, 0);
}

static void test_picture(void **state)
{
    (void)state;
    check(IMAGE "{ c = vec4(lsf_picture(p) - lsf_direct(p), 1.0); }", 32, 10, 0, 0, 0, 1e-4f);
    check(IMAGE "{ vec3 q = lsf_position(p), d, e = lsf_light(0, q, d) * d.y;\n"
                "float seen = dot(lsf_picture(p), vec3(1.0));\n"
                "c = vec4(seen > 0.0, abs(q.y + 0.25), lsf_indirect_diffuse(p).r, 1.0); }",
          32, 10, 1, 0, 0, 1e-3f);
}

#define VOXELIZE "voxelize_clear voxelize_mark voxelize_list voxelize_write voxelize_beside"

/* What is not named is not planned. */
static void test_plan(void **state)
{
    (void)state;
    static const struct {
        const char *text, *passes;
    } cases[] = {
        {IMAGE "{ c = vec4(0.0); /* lsf_depth */ // lsf_depth\n }", "sandbox"},
        {IMAGE "{ c = vec4(lsf_depth(p)); }", "gbuffer sandbox"},
        {IMAGE "{ vec3 d; c = vec4(lsf_light(0, vec3(0.0), d), 1.0); }", "sandbox"},
        {IMAGE "{ c = vec4(lsf_visibility(vec3(0.0), vec3(1.0))); }", "shadow_map sandbox"},
        {IMAGE "{ c = vec4(lsf_voxel_size(), 1.0); }", VOXELIZE " sandbox"},
        {"#include <lightsheaf/voxel_trace.glsl>\n" IMAGE "{ c = grid.size; }",
         VOXELIZE " sandbox"},
        {IMAGE "{ c = vec4(lsf_picture(p), lsf_depth(p)); }", "picture sandbox"},
    };
    lsf_scene *scene = make_scene();
    for (size_t i = 0; i < LSF_COUNT(cases); i++) {
        const lsf_sandbox_params params = sandbox_params(cases[i].text);
        lsf_error error = {0};
        lsf_plan *plan = lsf_sandbox_plan(scene, &params, &error);
        if (!plan)
            fail_msg("%s", error.message);
        lsf_string passes = {0};
        for (uint64_t k = 0; k < plan->pass_count; k++)
            lsf_string_add(&passes, "%s%s", k ? " " : "", plan->passes[k].name);
        assert_string_equal(passes.text, cases[i].passes);
        free(passes.text);
        lsf_plan_destroy(plan);
    }
    destroy_scene(scene);
}

static void test_no_such_light(void **state)
{
    (void)state;
    lsf_scene *scene = make_scene();
    const lsf_sandbox_params params =
        sandbox_params("\n// @light 1\n" IMAGE "{ c = vec4(lsf_visibility(vec3(0.0), p.xyx)); }");
    sandbox_refuse(scene, &params, "test.frag:2: @light 1: the scene has 1 light");
    destroy_scene(scene);
    const lsf_sandbox_params voxels =
        sandbox_params(IMAGE "{ c = vec4(lsf_voxel_size(), lsf_bundle_size()); }");
    scene = build_scene();
    finish_gl_scene(scene);
    sandbox_refuse(scene, &voxels, "the shader names voxels or a ray-bundle, and the scene has no");
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gbuffer),       cmocka_unit_test(test_lights),
        cmocka_unit_test(test_voxels),        cmocka_unit_test(test_bundle),
        cmocka_unit_test(test_picture),       cmocka_unit_test(test_plan),
        cmocka_unit_test(test_no_such_light),
    };
    return cmocka_run_group_tests(tests, sandbox_setup, sandbox_teardown);
}
