/* Lobes that VPLs shed light in: their energy, directions drawn from them, how they are kept in a
 * record; and where light from metal goes. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "base/base.h"
#include "render_gl.h"

enum { SIDE = 256, GROUPS = SIDE / 8 };

/* Of each invocation's direction: what of the flux goes there by the lobe, on the side of the axis
 * and in all; the same of the one drawn by its numbers; what packing takes. */
static const char shader[] =
    "#include \"lib/vpl_lobe.glsl\"\n"
    "layout(local_size_x = 8, local_size_y = 8) in;\n"
    "layout(location = 0) uniform vec2 shape;\n"
    "layout(std430, binding = 7) writeonly buffer block { vec4 result[]; };\n"
    "void main()\n"
    "{\n"
    "    vec3 n = normalize(vec3(0.3, -0.5, 0.8)), t, b;\n"
    "    orthonormal_basis(n, t, b);\n"
    "    vec3 from = sqrt(1.0 - shape.y * shape.y) * normalize(t + 0.3 * b) + shape.y * n;\n"
    "    vpl_lobe lobe = vpl_lobe(from, shape.x);\n"
    "    vec3 axis = vpl_lobe_axis(n, lobe);\n"
    "    vec2 u = (vec2(gl_GlobalInvocationID.xy) + 0.5) / SIDE;\n"
    "    vec3 local = cosine_direction(disc_draw(u));\n"
    "    vec3 direction = normalize(local.x * t + local.y * b + local.z * n);\n"
    "    float alpha = lsf_alpha_from_roughness(shape.x), weight;\n"
    "    float there = vpl_lobe_towards(n, from, direction, alpha);\n"
    "    vec3 drawn = vpl_lobe_draw(n, lobe, u, weight);\n"
    "    uint i = gl_GlobalInvocationID.y * SIDE + gl_GlobalInvocationID.x;\n"
    "    result[i] = vec4(there, dot(direction, axis) > 0.9 ? there : 0.0, weight,\n"
    "                     dot(drawn, axis) > 0.9 ? weight : 0.0);\n"
    "    lsf_vpl_record v;\n"
    "    v.normal = octahedral_encode(n);\n"
    "    v.depth_and_lobe = 5u | vpl_lobe_pack(lobe);\n"
    "    vpl_lobe kept = vpl_lobe_unpack(v);\n"
    "    if (i == 0u)\n"
    "        result[SIDE * SIDE] = vec4(length(cross(kept.from, from)), kept.roughness,\n"
    "                                   float(v.depth_and_lobe & LSF_VPL_DEPTH_MASK),\n"
    "                                   float(vpl_has_lobe(v)));\n"
    "}\n";

static void check_lobe(const float (*found)[4], float roughness, float cosine)
{
    double sums[4] = {0, 0, 0, 0};
    for (int i = 0; i < SIDE * SIDE; i++)
        for (int k = 0; k < 4; k++)
            sums[k] += (double)found[i][k] / (SIDE * SIDE);
    const float *kept = found[SIDE * SIDE];
    print_message("roughness %.2f, cosine %.2f: flux %.4f, drawn %.4f; about the axis %.4f, drawn "
                  "%.4f; kept within %.1e rad\n",
                  (double)roughness, (double)cosine, sums[0], sums[2], sums[1], sums[3],
                  (double)kept[0]);
    /* The albedo is of a table; directions by the cosine miss a narrow lobe. */
    assert_true(fabs(sums[2] - 1.0) <= 0.02);
    if (roughness >= 0.4f) {
        assert_true(fabs(sums[0] - 1.0) <= 0.02);
        assert_true(fabs(sums[1] - sums[3]) <= 0.02);
    }
    assert_true(kept[0] <= 0.005f && fabsf(kept[1] - roughness) <= 0.5f / 62.0f + 1e-6f);
    assert_true(kept[2] == 5.0f && kept[3] == 1.0f);
}

static void lobes_carry_the_flux(void **unused)
{
    (void)unused;
    static const float shapes[][2] = {{0.0f, 0.9f}, {0.2f, 0.5f}, {0.4f, 0.95f}, {0.4f, 0.3f},
                                      {0.7f, 0.8f}, {0.7f, 0.1f}, {1.0f, 0.6f}};
    static float found[SIDE * SIDE + 1][4];
    lsf_error error = {0};
    shader_folder folder;
    shader_folder_create(&folder);
    shader_folder_write(&folder, "lobes.comp.glsl", shader);
    lsf_context *context = gl_test_context(gl_test_backend(), folder.path);
    const lsf_define defines[] = {{"SIDE", SIDE}};
    lsf_program_desc desc = {
        .label = "lobes", .files = {"lobes.comp.glsl"}, .defines = defines, .define_count = 1};
    GLuint program = lsf_program_get(context, &desc, &error);
    GLuint result = lsf_buffer_create(context, "result", sizeof found, NULL, 0, &error);
    if (!program || !result)
        fail_msg("%s", error.message);
    for (size_t i = 0; i < LSF_COUNT(shapes); i++) {
        glUseProgram(program);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, result);
        glUniform2f(0, shapes[i][0], shapes[i][1]);
        glDispatchCompute(GROUPS, GROUPS, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(result, 0, sizeof found, found);
        check_lobe((const float(*)[4])found, shapes[i][0], shapes[i][1]);
    }
    lsf_buffer_destroy(context, &result);
    gl_test_check(context);
    lsf_context_destroy(context);
    shader_folder_destroy(&folder);
}

/* A spot that slants down to a floor of metal, between two walls that it does not light itself. */
static lsf_scene *metal_floor(float roughness)
{
    lsf_scene *scene = build_scene();
    lsf_material *metal = build_material(scene, 0.9f, 0.9f, 0.9f);
    metal->metallic = 1.0f;
    metal->roughness = roughness;
    build_floor(scene, 0.0f, 1.0f);
    build_material(scene, 0.5f, 0.5f, 0.5f);
    build_quad(scene, lsf_f3(1, 0, -1), lsf_f3(1, 0, 1), lsf_f3(1, 2, 1), lsf_f3(1, 2, -1));
    build_quad(scene, lsf_f3(-1, 0, 1), lsf_f3(-1, 0, -1), lsf_f3(-1, 2, -1), lsf_f3(-1, 2, 1));
    lsf_light *spot =
        build_light(scene, LSF_LIGHT_SPOT, lsf_f3(-0.7f, 0.7f, 0), lsf_f3(1, -1, 0), 3.0f);
    spot->inner_cone = 0.1f;
    spot->outer_cone = 0.2f;
    finish_gl_scene(scene);
    return scene;
}

/* Mean radiance of the wall on that side, from the middle of the room. */
static double wall(const lsf_scene *scene, float side, const char *node, uint32_t samples)
{
    const char *const options[] = {"cloud.count=16384", "voxel.resolution=64", "rsm.resolution=64",
                                   node};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS,
                                .technique = "substitute_tree",
                                .raw = true,
                                .samples = samples,
                                .bounces = 1,
                                .options = options,
                                .option_count = LSF_COUNT(options)};
    double rgb[3];
    lsf_image *image =
        render_gl_from(scene, params, 16, lsf_f3(-0.6f * side, 1.0f, 0), lsf_f3(side, 1.0f, 0));
    mean_rgb(image, 0, rgb);
    lsf_image_destroy(image);
    return rgb[1];
}

/* The wall that the floor mirrors the spot to is bright, also where VPLs are drawn by their
 * luminance alone, which knows of no lobes. */
static void metal_mirrors_light(void **unused)
{
    (void)unused;
    lsf_scene *scene = metal_floor(0.2f);
    double back = wall(scene, -1.0f, "light_tree.node=substitute", 8);
    double away = wall(scene, 1.0f, "light_tree.node=substitute", 8);
    double drawn = wall(scene, 1.0f, "light_tree.node=vpl", 8);
    print_message("away from the spot %.4g, by luminance %.4g, back to it %.4g\n", away, drawn,
                  back);
    assert_true(away > 8.0 * back);
    assert_true(fabs(away / drawn - 1.0) <= 0.1);
    lsf_scene_destroy(scene);
}

static void mirrors_are_finite(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2; i++) {
        lsf_scene *scene = metal_floor((float)i);
        double away = wall(scene, 1.0f, "light_tree.lobe_alpha=0", 1);
        print_message("roughness %d: %.4g\n", i, away);
        assert_true(isfinite(away) && away > 0.0);
        lsf_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_carry_the_flux),
        cmocka_unit_test(metal_mirrors_light),
        cmocka_unit_test(mirrors_are_finite),
    };
    return cmocka_run_group_tests_name("vpl_lobe", tests, NULL, NULL);
}
