/* Directions drawn from the BRDF: their density is what brdf_pdf says, and the mean of the weights
 * is what the surface reflects. */
#include <math.h>

#include "../gl/shader_folder.h"
#include "shared/brdf.h"

/* Draws on a lattice of u and v, and of w for the lobe; cells of the hemisphere, in equal steps of
 * the cosine and of the angle; points in a cell, along each side, that the density is summed over.
 */
enum { SIDE = 128, LAYERS = 16, DRAWS = SIDE * SIDE * LAYERS };
enum { RINGS = 12, SECTORS = 16, CELLS = RINGS * SECTORS, FINE = 24 };

typedef struct material {
    const char *name;
    float roughness, metallic, anisotropy, turn;
    float view[3];
    float coat, coat_roughness;
    float weight; /* of the dielectric's reflection, which is tinted then; 0: 1, without a tint */
} material;

static const material materials[] = {
    {"plastic", 1.0f, 0.0f, 0.0f, 0.0f, {0.3f, 0.2f, 0.8f}, 0.0f, 0.0f, 0.0f},
    {"rough metal", 0.7f, 1.0f, 0.0f, 0.0f, {-0.5f, 0.3f, 0.6f}, 0.0f, 0.0f, 0.0f},
    {"mixed", 0.5f, 0.5f, 0.0f, 0.0f, {0.7f, -0.1f, 0.5f}, 0.0f, 0.0f, 0.0f},
    {"brushed", 0.5f, 0.8f, 0.7f, 0.15f, {0.4f, 0.4f, 0.7f}, 0.0f, 0.0f, 0.0f},
    {"grazing", 0.8f, 0.3f, 0.4f, 0.6f, {0.9f, 0.1f, 0.12f}, 0.0f, 0.0f, 0.0f},
    {"tinted", 0.8f, 0.2f, 0.0f, 0.0f, {0.3f, 0.3f, 0.7f}, 0.0f, 0.0f, 0.6f},
    {"coated", 0.8f, 0.4f, 0.0f, 0.0f, {0.3f, 0.4f, 0.6f}, 0.8f, 0.5f, 0.0f},
};

/* Of each draw the cell, -1 below the horizon, and the weights of both lobes; or of each point the
 * density and both lobes. */
static const char shader[] =
    "#define LSF_SPECULAR 1\n"
    "#define LSF_ANISOTROPY 1\n"
    "#define LSF_SPECULAR_TINT 1\n"
    "#define LSF_COAT 1\n"
    "#include \"lib/brdf_sample.glsl\"\n"
    "#include \"lib/path_random.glsl\"\n"
    "layout(local_size_x = 64) in;\n"
    "layout(location = 0) uniform vec4 gloss;\n"
    "layout(location = 1) uniform vec3 view_direction;\n"
    "layout(location = 2) uniform ivec2 counts; /* rings, sectors */\n"
    "layout(location = 3) uniform bool density;\n"
    "layout(location = 4) uniform float weight;\n"
    "layout(location = 5) uniform vec2 coat;\n"
    "layout(std430, binding = 0) writeonly buffer block { vec4 result[]; };\n"
    "void main()\n"
    "{\n"
    "    surface s;\n"
    "    s.normal = s.geometric_normal = normalize(vec3(0.3, -0.5, 0.7));\n"
    "    s.base_color = vec3(0.6);\n"
    "    s.f0 = 0.04;\n"
    "    lobes_none(s);\n"
    "    s.coat = coat.x;\n"
    "    s.coat_roughness = coat.y;\n"
    "    s.coat_normal = normalize(vec3(0.4, -0.5, 0.7));\n"
    "    if (weight > 0.0) {\n"
    "        s.f0 = 0.4;\n"
    "        s.f0_tint = vec3(1.0, 0.2, 0.4);\n"
    "        s.specular_weight = weight;\n"
    "    }\n"
    "    s.roughness = gloss.x;\n"
    "    s.metallic = gloss.y;\n"
    "    s.anisotropy = gloss.z;\n"
    "    s.anisotropy_angle = gloss.w;\n"
    "    s.unlit = false;\n"
    "    vec3 t, b;\n"
    "    orthonormal_basis(s.normal, t, b);\n"
    "    mat3 frame = mat3(t, b, s.normal);\n"
    "    vec3 view = frame * normalize(view_direction);\n"
    "    brdf_sampler p = brdf_sampler_of(s, view, true);\n"
    "    int i = int(gl_GlobalInvocationID.x);\n"
    "    if (density) {\n"
    "        ivec2 cell = ivec2(i / counts.y, i % counts.y);\n"
    "        float z = (float(cell.x) + 0.5) / float(counts.x);\n"
    "        float phi = 2.0 * LSF_PI * (float(cell.y) + 0.5) / float(counts.y);\n"
    "        vec3 d = vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z);\n"
    "        brdf_value f = brdf_evaluate(s, view, frame * d, 0.0);\n"
    "        result[i] = vec4(brdf_pdf(p, frame * d), f.diffuse * z, f.specular.r * z, 1.0);\n"
    "        return;\n"
    "    }\n"
    "    vec3 u = path_random(path_random_key(7u, 3u, ivec2(0)), uint(i), 1u);\n"
    "    vec3 direction = brdf_draw(p, u);\n"
    "    vec3 local = transpose(frame) * direction;\n"
    "    if (local.z <= 0.0) {\n"
    "        result[i] = vec4(-1.0, 0.0, 0.0, 0.0);\n"
    "        return;\n"
    "    }\n"
    "    int ring = min(int(local.z * float(counts.x)), counts.x - 1);\n"
    "    float turned = fract(atan(local.y, local.x) / (2.0 * LSF_PI));\n"
    "    int sector = min(int(turned * float(counts.y)), counts.y - 1);\n"
    "    brdf_value f = brdf_evaluate(s, view, direction, 0.0);\n"
    "    float weight = local.z / brdf_pdf(p, direction);\n"
    "    result[i] = vec4(float(ring * counts.y + sector), f.diffuse * weight, f.specular.r * "
    "weight, 1.0);\n"
    "}\n";

typedef struct rig {
    shader_folder folder;
    lsf_context *context;
    GLuint program, buffer;
    float (*result)[4];
} rig;

static void rig_begin(rig *r)
{
    shader_folder_create(&r->folder);
    shader_folder_write(&r->folder, "draws.comp.glsl", shader);
    r->context = gl_test_context(gl_test_backend(), r->folder.path);
    lsf_error error = {0};
    lsf_program_desc desc = {.label = "draws", .files = {"draws.comp.glsl"}};
    r->program = lsf_program_get(r->context, &desc, &error);
    if (!r->program)
        fail_msg("%s", error.message);
    glCreateBuffers(1, &r->buffer);
    glNamedBufferStorage(r->buffer, DRAWS * sizeof *r->result, NULL, 0);
    r->result = calloc(DRAWS, sizeof *r->result);
}

static void rig_end(rig *r)
{
    glDeleteBuffers(1, &r->buffer);
    gl_test_check(r->context);
    lsf_context_destroy(r->context);
    shader_folder_destroy(&r->folder);
    free(r->result);
}

static void ask(rig *r, const material *m, int rings, int sectors, bool density, uint32_t count)
{
    glUseProgram(r->program);
    glUniform4f(0, m->roughness, m->metallic, m->anisotropy, m->turn);
    glUniform3fv(1, 1, m->view);
    glUniform2i(2, rings, sectors);
    glUniform1i(3, density);
    glUniform1f(4, m->weight);
    glUniform2f(5, m->coat, m->coat_roughness);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, r->buffer);
    glDispatchCompute(count / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(r->buffer, 0, (GLsizeiptr)(count * sizeof *r->result), r->result);
}

static void test_draws(void **state)
{
    (void)state;
    static rig r;
    rig_begin(&r);
    for (size_t k = 0; k < LSF_COUNT(materials); k++) {
        const material *m = &materials[k];
        double expected[CELLS] = {0}, reflected[2] = {0}, drawn[2] = {0}, sum = 0.0;
        uint32_t counts[CELLS] = {0}, above = 0;
        /* The density over each cell; the hemisphere has 2 pi steradians in equal parts. */
        enum { POINTS = CELLS * FINE * FINE };
        ask(&r, m, RINGS * FINE, SECTORS * FINE, true, POINTS);
        for (int i = 0; i < POINTS; i++) {
            int ring = i / (SECTORS * FINE) / FINE, sector = i % (SECTORS * FINE) / FINE;
            const double solid_angle = 2.0 * (double)LSF_PI / POINTS;
            double part = (double)r.result[i][0] * solid_angle;
            expected[ring * SECTORS + sector] += part;
            sum += part;
            for (int lobe = 0; lobe < 2; lobe++)
                reflected[lobe] += (double)r.result[i][1 + lobe] * solid_angle;
        }
        ask(&r, m, RINGS, SECTORS, false, DRAWS);
        for (int i = 0; i < DRAWS; i++) {
            if (r.result[i][0] < 0.0f)
                continue;
            counts[(int)r.result[i][0]]++;
            above++;
            for (int lobe = 0; lobe < 2; lobe++)
                drawn[lobe] += (double)r.result[i][1 + lobe] / DRAWS;
        }
        /* Points of low discrepancy are closer to it than random ones are. */
        for (int cell = 0; cell < CELLS; cell++) {
            double p = counts[cell] / (double)DRAWS;
            double sigma = sqrt(expected[cell] / DRAWS);
            if (fabs(p - expected[cell]) > 5.0 * sigma + 0.01 * expected[cell])
                fail_msg("%s: cell %d gets %g of the draws instead of %g", m->name, cell, p,
                         expected[cell]);
        }
        assert_true(fabs(above / (double)DRAWS - sum) <= 0.003);
        print_message("%s: %.4f above the horizon, reflects %.4f and %.4f (%.4f %.4f)\n", m->name,
                      sum, drawn[0] / (double)LSF_PI, drawn[1], reflected[0] / (double)LSF_PI,
                      reflected[1]);
        for (int lobe = 0; lobe < 2; lobe++)
            assert_true(fabs(drawn[lobe] / reflected[lobe] - 1.0) <= 0.003);
    }
    rig_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_draws)};
    return cmocka_run_group_tests_name("brdf_sample", tests, NULL, NULL);
}
