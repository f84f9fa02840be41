/* The way down the tree over a cloud: how often it ends where, against the probabilities that it
 * states. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "light_tree_rig.h"
#include "techniques/setup.h"

enum { VPLS = 400, DRAWS = 1 << 17 };

/* For each draw where it ended, and the probability of that. */
static const char shader[] =
    "#define LSF_SPECULAR 1\n"
    "#define LSF_LIGHT_TREE_SAMPLES 1\n"
    "#include \"passes/light_tree_sample_cut.glsl\"\n"
    "#include \"passes/light_tree_sample_walk.glsl\"\n"
    "layout(local_size_x = 64) in;\n"
    "layout(location = 5) uniform bool specular;\n"
    "layout(location = 6) uniform vec3 position;\n"
    "layout(std430, binding = 7) writeonly buffer block { uvec2 result[]; };\n"
    "void main()\n"
    "{\n"
    "    surface s;\n"
    "    s.normal = s.geometric_normal = normalize(vec3(0.2, 0.9, -0.1));\n"
    "    s.base_color = vec3(0.6);\n"
    "    s.f0 = 0.04;\n"
    "    s.roughness = 0.4;\n"
    "    s.metallic = s.anisotropy = s.anisotropy_angle = 0.0;\n"
    "    s.unlit = false;\n"
    "    lobes_none(s);\n"
    "    light_receiver r = light_receiver_of(position, normalize(vec3(-0.5, 0.6, 0.3)), s);\n"
    "    uint i = gl_GlobalInvocationID.x;\n"
    "    path_random_key key = path_random_key(i, 11u, ivec2(0));\n"
    "    picks[0] = light_pick(int(specular), LSF_LIGHT_TREE_NONE,\n"
    "                          path_random(key, 0u, 0u).x, 0.0);\n"
    "    light_cut(r, bvec2(!specular, specular));\n"
    "    float share = picks[0].weight / weight_sums[int(specular)];\n"
    "    light_walk_end end = light_walk(r, specular, picks[0].link, share, picks[0].u, key, 0u);\n"
    "    result[i] = uvec2(end.link, floatBitsToUint(end.probability));\n"
    "}\n";

typedef struct draw {
    uint32_t link;
    float probability;
} draw;

typedef struct rig {
    shader_folder folder;
    lsf_context *context;
    lsf_scene *scene;
    lsf_setup setup;
    lsf_iteration iteration;
    lsf_light_tree tree;
    lsf_light_tree_fetch fetch;
    GLuint cloud, result;
    draw *draws;
} rig;

static void rig_begin(rig *r)
{
    lsf_error error = {0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    const lsf_light_tree_params tree = {LSF_LIGHT_TREE_PARAMS_DEFAULTS};
    shader_folder_create(&r->folder);
    shader_folder_write(&r->folder, "walks.comp.glsl", shader);
    r->context = gl_test_context(gl_test_backend(), r->folder.path);
    r->scene = build_scene();
    build_corner(r->scene);
    finish_gl_scene(r->scene);
    if (!lsf_setup_begin(&r->setup, r->scene, &params, true, &error))
        fail_msg("%s", error.message);
    lsf_light_tree_plan(r->setup.plan, &tree, VPLS, "cloud");
    r->iteration.state = &r->setup.state;
    struct lsf_vpl_record *records = cloud_make(CLOUD_DAMAGED, VPLS, 5);
    r->cloud = lsf_buffer_create(r->context, "cloud", VPLS * sizeof *records, records, 0, &error);
    r->result = lsf_buffer_create(r->context, "draws", DRAWS * sizeof *r->draws, NULL, 0, &error);
    r->draws = calloc(DRAWS, sizeof *r->draws);
    if (!r->cloud || !r->result || !r->draws ||
        !lsf_light_tree_create(&r->tree, r->context, r->setup.plan, &tree, VPLS, &error))
        fail_msg("%s", error.message);
    if (!lsf_light_tree_fetch_create(&r->fetch, r->context, &error))
        fail_msg("%s", error.message);
    lsf_light_tree_run(&r->tree, &r->iteration, r->cloud);
    free(records);
}

static void rig_end(rig *r)
{
    lsf_buffer_destroy(r->context, &r->cloud);
    lsf_buffer_destroy(r->context, &r->result);
    lsf_light_tree_fetch_destroy(&r->fetch);
    lsf_light_tree_destroy(&r->tree);
    lsf_setup_finish(&r->setup);
    gl_test_check(r->context);
    lsf_context_destroy(r->context);
    lsf_scene_destroy(r->scene);
    shader_folder_destroy(&r->folder);
    free(r->draws);
}

static int by_link(const void *a, const void *b)
{
    uint32_t x = ((const draw *)a)->link, y = ((const draw *)b)->link;
    return x < y ? -1 : x > y;
}

static void draw_all(rig *r, bool substitute, bool sites, bool specular, float cut,
                     const float position[3])
{
    lsf_error error = {0};
    const lsf_define defines[] = {{"LSF_LIGHT_TREE_SUBSTITUTE", substitute},
                                  {"LSF_LIGHT_TREE_SITES", sites},
                                  {"LSF_LIGHT_TREE_COVARIANCE", 0}};
    lsf_program_desc desc = {
        .label = "walks", .files = {"walks.comp.glsl"}, .defines = defines, .define_count = 3};
    GLuint program = lsf_program_get(r->context, &desc, &error);
    if (!program)
        fail_msg("%s", error.message);
    glUseProgram(program);
    lsf_light_tree_fetch_bind(&r->fetch, &r->tree.outputs);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 7, r->result);
    glUniform3f(0, 1.0f, 0.0f, 0.0f);
    glUniform1f(2, 1e9f);
    glUniform1f(3, cut > 0.0f ? cut * cut : INFINITY);
    glUniform1i(5, specular);
    glUniform3fv(6, 1, position);
    glDispatchCompute(DRAWS / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(r->result, 0, DRAWS * sizeof *r->draws, r->draws);
    qsort(r->draws, DRAWS, sizeof *r->draws, by_link);
}

/* Ends that are expected five times and more count one by one, and all else, dead branches among
 * them, together. */
static void check_frequencies(const rig *r, const char *name)
{
    double square = 0.0, rest = 1.0;
    uint32_t cells = 0, unlisted = DRAWS, inner = 0;
    for (uint32_t i = 0, next; i < DRAWS; i = next) {
        for (next = i; next < DRAWS && r->draws[next].link == r->draws[i].link; next++)
            assert_true(r->draws[next].link == LSF_LIGHT_TREE_NONE ||
                        r->draws[next].probability == r->draws[i].probability);
        double p = (double)r->draws[i].probability, expected = p * DRAWS;
        if (r->draws[i].link == LSF_LIGHT_TREE_NONE || expected < 5.0)
            continue;
        square += (next - i - expected) * (next - i - expected) / expected;
        rest -= p;
        unlisted -= next - i;
        inner += !(r->draws[i].link & LSF_LIGHT_TREE_LEAF);
        cells++;
    }
    assert_true(rest > -1e-5);
    double expected = fmax(rest, 0.0) * DRAWS;
    if (expected >= 5.0)
        square += (unlisted - expected) * (unlisted - expected) / expected;
    else
        assert_true(unlisted < 20);
    double freedom = expected >= 5.0 ? cells : cells - 1;
    print_message("%s: %u ends, %u of them inner nodes, chi-square %.1f with %.0f degrees of "
                  "freedom, the rest %.4g\n",
                  name, cells, inner, square, freedom, rest);
    assert_true(square < freedom + 4.0 * sqrt(2.0 * freedom));
}

static void test_frequencies(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool substitute, sites, specular;
        float cut;
    } cases[] = {
        {"substitutes, diffuse", true, true, false, 0.0f},
        {"substitutes, specular", true, true, true, 0.0f},
        {"lightcut, diffuse", false, true, false, 0.0f},
        {"by luminance", false, false, false, 0.0f},
        {"substitutes from a cut, diffuse", true, true, false, 0.5f},
        {"lightcut from a cut, diffuse", false, true, false, 0.5f},
        {"from a cut, specular", true, true, true, 0.25f},
    };
    static const float positions[2][3] = {{0.0f, -0.45f, 0.0f}, {0.7f, 0.3f, -0.55f}};
    static rig r;
    rig_begin(&r);
    for (size_t i = 0; i < 2 * LSF_COUNT(cases); i++) {
        draw_all(&r, cases[i / 2].substitute, cases[i / 2].sites, cases[i / 2].specular,
                 cases[i / 2].cut, positions[i % 2]);
        check_frequencies(&r, cases[i / 2].name);
    }
    rig_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_frequencies)};
    return cmocka_run_group_tests_name("light_tree_walk", tests, NULL, NULL);
}
