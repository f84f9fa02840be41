/* What a plan says that its passes read is what their programs are given to read. */
#include "plan/flow.h"

#include "base/base.h"
#include "net_rig.h"
#include "render_gl.h"

#include <string.h>
#include <unistd.h>

enum { SIZE = 16, UNITS = 64, TOUCHES = 4096 };

static GLuint textures[UNITS], images[UNITS];

typedef struct touch {
    char pass[64], resource[64];
} touch;

static touch touches[TOUCHES];
static size_t touch_count;

/* --- what GL is told ---------------------------------------------------------------------------
 */

static PFNGLBINDTEXTUREUNITPROC bind_texture_unit;
static PFNGLBINDIMAGETEXTUREPROC bind_image;
static PFNGLDISPATCHCOMPUTEPROC dispatch;
static PFNGLDISPATCHCOMPUTEINDIRECTPROC dispatch_indirect;
static PFNGLDRAWARRAYSPROC draw_arrays;
static PFNGLDRAWARRAYSINDIRECTPROC draw_arrays_indirect;
static PFNGLDRAWELEMENTSINDIRECTPROC draw_elements_indirect;
static PFNGLDRAWELEMENTSINSTANCEDBASEINSTANCEPROC draw_elements;

static void add_touch(const char *pass, GLenum kind, GLuint name)
{
    char label[64] = "";
    if (name)
        glGetObjectLabel(kind, name, sizeof label, NULL, label);
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0 && strcmp(touches[i].resource, label) == 0)
            return;
    assert_true(touch_count < TOUCHES);
    snprintf(touches[touch_count].pass, sizeof touches->pass, "%s", pass);
    snprintf(touches[touch_count++].resource, sizeof touches->resource, "%s", label);
}

static bool is_image(GLint type)
{
    return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY;
}

static bool is_sampler(GLint type)
{
    return (type >= GL_SAMPLER_1D && type <= GL_SAMPLER_2D_RECT_SHADOW) ||
           (type >= GL_SAMPLER_1D_ARRAY && type <= GL_SAMPLER_CUBE_SHADOW) ||
           (type >= GL_INT_SAMPLER_1D && type <= GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
           (type >= GL_SAMPLER_CUBE_MAP_ARRAY && type <= GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY);
}

static void look_at_uniforms(GLuint program, const char *pass)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        static const GLenum asked[] = {GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE};
        GLint told[3], unit;
        glGetProgramResourceiv(program, GL_UNIFORM, (GLuint)i, 3, asked, 3, NULL, told);
        for (GLint k = 0; told[1] >= 0 && k < told[2]; k++) {
            if (!is_image(told[0]) && !is_sampler(told[0]))
                break;
            glGetUniformiv(program, told[1] + k, &unit);
            assert_true(unit < UNITS);
            add_touch(pass, GL_TEXTURE, (is_image(told[0]) ? images : textures)[unit]);
        }
    }
}

static void look_at_blocks(GLuint program, const char *pass, GLenum interface, GLenum binding)
{
    GLint count = 0;
    glGetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; i++) {
        static const GLenum asked = GL_BUFFER_BINDING;
        GLint at, buffer;
        glGetProgramResourceiv(program, interface, (GLuint)i, 1, &asked, 1, NULL, &at);
        glGetIntegeri_v(binding, (GLuint)at, &buffer);
        add_touch(pass, GL_BUFFER, (GLuint)buffer);
    }
}

static void look_at_vertices(const char *pass)
{
    for (GLuint i = 0; i < 16; i++) {
        GLint enabled = 0, buffer = 0;
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &enabled);
        glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &buffer);
        if (enabled)
            add_touch(pass, GL_BUFFER, (GLuint)buffer);
    }
}

static void look(bool draws)
{
    GLint program = 0;
    char pass[64] = "";
    glGetIntegerv(GL_CURRENT_PROGRAM, &program);
    glGetObjectLabel(GL_PROGRAM, (GLuint)program, sizeof pass, NULL, pass);
    look_at_uniforms((GLuint)program, pass);
    look_at_blocks((GLuint)program, pass, GL_UNIFORM_BLOCK, GL_UNIFORM_BUFFER_BINDING);
    look_at_blocks((GLuint)program, pass, GL_SHADER_STORAGE_BLOCK,
                   GL_SHADER_STORAGE_BUFFER_BINDING);
    if (draws)
        look_at_vertices(pass);
}

static void spy_bind_texture_unit(GLuint unit, GLuint texture)
{
    textures[unit] = texture;
    bind_texture_unit(unit, texture);
}

static void spy_bind_image(GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer,
                           GLenum access, GLenum format)
{
    images[unit] = texture;
    bind_image(unit, texture, level, layered, layer, access, format);
}

static void spy_dispatch(GLuint x, GLuint y, GLuint z)
{
    look(false);
    dispatch(x, y, z);
}

static void spy_dispatch_indirect(GLintptr offset)
{
    look(false);
    dispatch_indirect(offset);
}

static void spy_draw_arrays(GLenum mode, GLint first, GLsizei count)
{
    look(true);
    draw_arrays(mode, first, count);
}

static void spy_draw_arrays_indirect(GLenum mode, const void *indirect)
{
    look(true);
    draw_arrays_indirect(mode, indirect);
}

static void spy_draw_elements_indirect(GLenum mode, GLenum type, const void *indirect)
{
    look(true);
    draw_elements_indirect(mode, type, indirect);
}

static void spy_draw_elements(GLenum mode, GLsizei count, GLenum type, const void *indices,
                              GLsizei instances, GLuint base)
{
    look(true);
    draw_elements(mode, count, type, indices, instances, base);
}

#define SPY(member, original, spy)                                                                 \
    do {                                                                                           \
        original = glad_current->member;                                                           \
        glad_current->member = spy;                                                                \
    } while (0)

static void start_spying(void)
{
    touch_count = 0;
    SPY(BindTextureUnit, bind_texture_unit, spy_bind_texture_unit);
    SPY(BindImageTexture, bind_image, spy_bind_image);
    SPY(DispatchCompute, dispatch, spy_dispatch);
    SPY(DispatchComputeIndirect, dispatch_indirect, spy_dispatch_indirect);
    SPY(DrawArrays, draw_arrays, spy_draw_arrays);
    SPY(DrawArraysIndirect, draw_arrays_indirect, spy_draw_arrays_indirect);
    SPY(DrawElementsIndirect, draw_elements_indirect, spy_draw_elements_indirect);
    SPY(DrawElementsInstancedBaseInstance, draw_elements, spy_draw_elements);
}

/* --- scenes ------------------------------------------------------------------------------------
 */

static lsf_scene *rich_scene(void)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    lsf_material *lamp = build_material(scene, 0.5f, 0.5f, 0.5f);
    lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 4.0f;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    build_glass(scene, 0.9f, 0.2f, 0.0f);
    build_quad(scene, lsf_f3(-1.5f, 0, 0.5f), lsf_f3(0, 0, 0.5f), lsf_f3(0, 1, 0.5f),
               lsf_f3(-1.5f, 1, 0.5f));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
    build_environment(scene, 1.0f);
    finish_gl_scene(scene);
    return scene;
}

static bool touches_stem(const char *pass, const char *resource)
{
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0 && lsf_plan_same_stem(touches[i].resource, resource))
            return true;
    return false;
}

static bool has_run(const char *pass)
{
    for (size_t i = 0; i < touch_count; i++)
        if (strcmp(touches[i].pass, pass) == 0)
            return true;
    return false;
}

static int wrong;

static void check_plan(const lsf_plan *plan)
{
    for (size_t i = 0; i < touch_count; i++) {
        const lsf_plan_pass *pass = lsf_plan_find_pass(plan, touches[i].pass);
        const char *resource = touches[i].resource;
        if (pass && lsf_plan_find(plan, resource) && !lsf_plan_pass_reads(plan, pass, resource) &&
            !lsf_plan_pass_fills(pass, resource)) {
            print_message("%s: %s reads %s\n", plan->technique, pass->name, resource);
            wrong++;
        }
    }
    for (uint64_t p = 0; p < plan->pass_count; p++)
        for (uint64_t r = 0; r < plan->resource_count; r++) {
            const lsf_plan_pass *pass = &plan->passes[p];
            const char *resource = plan->resources[r].name;
            if (has_run(pass->name) && lsf_plan_pass_reads(plan, pass, resource) &&
                !touches_stem(pass->name, resource)) {
                print_message("%s: %s does not read %s\n", plan->technique, pass->name, resource);
                wrong++;
            }
        }
}

static const struct plan_case {
    const char *technique;
    bool raw, temporal;
    uint32_t aovs;
    const char *options[3];
} cases[] = {
    {"direct", .aovs = LSF_AOV_NORMAL | LSF_AOV_MOTION},
    {"bidirectional", .aovs = LSF_AOV_DIRECT},
    {"bidirectional", .temporal = true},
    {"bidirectional", .raw = true, .options = {"interleave.size=2", "sparse.blur=1"}},
    {"bidirectional", .options = {"sparse.grid=4", "interleave.size=2"}},
    {"bidirectional", .raw = true, .options = {"rsm.pdf=adaptive", "bidirectional.strategy=vpl"}},
    {"voxel_path", .aovs = LSF_AOV_VOXEL_ALBEDO, .options = {"sparse.grid=2"}},
    {"voxel_path", .raw = true, .options = {"voxel.method=raster", "environment.directions=0"}},
    {"cone", .options = {"sparse.grid=2", "sparse.blur=1"}},
    {"cone", .raw = true, .options = {"cone.sealed=off", "sparse.outliers=on"}},
    {"cone", .temporal = true,
     .options = {"light_filter.kind=network", "denoise.processor=gl",
                 "temporal.denoised_frames=4"}},
    {"substitute_tree", .options = {"sparse.grid=2", "cloud.count=8192"}},
    {"substitute_tree", .raw = true, .options = {"rsm.pdf=adaptive", "cloud.count=8192"}},
};

static void check(const struct plan_case *c)
{
    const char *options[] = {
        "voxel.resolution=32",  "rsm.resolution=32", "vpl.shadow_resolution=32",
        "bundle.resolution=32", c->options[0],       c->options[1],
        c->options[2]};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = c->technique;
    params.samples = 2;
    params.raw = c->raw;
    params.temporal = c->temporal;
    params.aovs = c->aovs;
    params.options = options;
    params.option_count =
        4u + (c->options[0] != NULL) + (c->options[1] != NULL) + (c->options[2] != NULL);
    params = corner_params(params, SIZE);
    lsf_scene *scene = rich_scene();
    lsf_error error = {0};
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    start_spying();
    lsf_renderer *renderer = lsf_renderer_create(context, scene, &params, &error);
    if (!renderer || !lsf_renderer_run(renderer, &error))
        fail_msg("%s", error.message);
    lsf_image *image = lsf_renderer_read(renderer, &error);
    check_plan(lsf_renderer_plan(renderer));
    lsf_image_destroy(image);
    lsf_renderer_destroy(renderer);
    lsf_context_destroy(context);
    destroy_scene(scene);
}

static void passes_read_what_the_plan_says(void **state)
{
    (void)state;
    char path[64];
    snprintf(path, sizeof path, "/tmp/lightsheaf-plan-reads-%d.lsfd", (int)getpid());
    net_rig_write(path, 2, 0.0f, 1.0f, 1.0f, 1);
    setenv("LIGHTSHEAF_DENOISER_WEIGHTS", path, 1);
    for (size_t i = 0; i < LSF_COUNT(cases); i++)
        check(&cases[i]);
    unlink(path);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(passes_read_what_the_plan_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
