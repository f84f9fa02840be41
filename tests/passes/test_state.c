/* No pass depends on what the pass before it left in the context, or on what fresh memory holds. */
#include "base/base.h"
#include "render_gl.h"
#include "shared/scene_data.h"

enum { SIZE = 16 };

static const char *const techniques[] = {"direct", "bidirectional", "voxel_path", "cone",
                                         "substitute_tree"};

/* --- scenes -------------------------------------------------------------------------------------
 */

/* 2 x 2 colours whose every channel is at least 100 of 255. */
static uint32_t bright_texture(lsf_scene *scene, bool srgb)
{
    static const uint8_t texels[4 * 3] = {255, 180, 120, 100, 200, 255,
                                          220, 255, 140, 128, 128, 255};
    return build_texture(scene, 2, 2, 3, texels, srgb);
}

/* Texture coordinates by position, and tangents. */
static void build_frames(lsf_scene *scene)
{
    lsf_vertices *v = &scene->vertices;
    v->uv0 = calloc(v->count, 2 * sizeof *v->uv0);
    v->tangent = calloc(v->count, 4 * sizeof *v->tangent);
    assert_true(v->uv0 && v->tangent);
    for (uint64_t i = 0; i < v->count; i++) {
        lsf_float3 p = lsf_f3_load(v->position + 3 * i), n = lsf_f3_load(v->normal + 3 * i);
        lsf_float3 t = lsf_f3_normalize(lsf_f3_cross(n, lsf_f3(0.2f, 0.5f, 0.8f)));
        memcpy(v->uv0 + 2 * i, (float[]){p.x + 0.3f * p.y, p.z - 0.4f * p.y}, 8);
        memcpy(v->tangent + 4 * i, (float[]){t.x, t.y, t.z, 1.0f}, 16);
    }
}

static void build_lights(lsf_scene *scene)
{
    lsf_material *lamp = build_material(scene, 0.5f, 0.5f, 0.5f);
    lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 4.0f;
    lamp->anisotropy_strength = 0.5f;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    build_glass(scene, 0.9f, 0.2f, 0.0f);
    build_quad(scene, lsf_f3(-1.5f, 0, 0.5f), lsf_f3(0, 0, 0.5f), lsf_f3(0, 1, 0.5f),
               lsf_f3(-1.5f, 1, 0.5f));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
    build_light(scene, LSF_LIGHT_SPOT, lsf_f3(-1, 2.5f, 1), lsf_f3(0, -1, -0.5f), 8.0f);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
}

/* A corner with a box, every material with textures, under a uniform environment; with a lamp, a
 * pane and a light of each kind where `lit`. */
static lsf_scene *textured_scene(bool lit)
{
    lsf_scene *scene = build_scene();
    build_corner(scene);
    if (lit)
        build_lights(scene);
    build_frames(scene);
    uint32_t color = bright_texture(scene, true), bumps = bright_texture(scene, false);
    for (uint32_t i = 0; i < scene->material_count; i++) {
        lsf_material *material = &scene->materials[i];
        material->base_color_texture.texture = color;
        material->metallic_roughness_texture.texture = bumps;
        material->normal_texture.texture = bumps;
        material->normal_scale = 0.3f;
        material->emissive_texture.texture = color;
        material->anisotropy_texture.texture = bumps;
        material->transmission_texture.texture = bumps;
    }
    build_environment(scene, 1.0f);
    return scene;
}

/* Small maps and grids, and then up to three options more. */
static lsf_render_params params_of(const char *technique, const char *const more[3])
{
    static const char *options[] = {"voxel.resolution=32",
                                    "rsm.resolution=32",
                                    "vpl.shadow_resolution=32",
                                    "bundle.resolution=32",
                                    "cloud.count=8192",
                                    NULL,
                                    NULL,
                                    NULL};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = technique;
    params.samples = 2;
    params.aovs = LSF_AOV_ALBEDO | LSF_AOV_NORMAL;
    params.options = options;
    params.option_count = 5;
    for (int i = 0; more && i < 3 && more[i]; i++)
        options[params.option_count++] = more[i];
    return params;
}

/* --- textures under an environment alone --------------------------------------------------------
 */

/* What visible points are does not depend on the technique. */
static void techniques_see_one_surface(void **unused)
{
    (void)unused;
    lsf_scene *scene = textured_scene(false);
    finish_gl_scene(scene);
    static const char *const one_point[3] = {"gbuffer.side=1"};
    lsf_image *expected = render_corner(scene, params_of(techniques[0], one_point), SIZE);
    for (size_t t = 1; t < LSF_COUNT(techniques); t++) {
        lsf_image *image = render_corner(scene, params_of(techniques[t], one_point), SIZE);
        double lit = 0.0;
        for (uint32_t i = 0; i < SIZE * SIZE; i++) {
            const float *got = image->pixels + (size_t)9 * i,
                        *want = expected->pixels + (size_t)9 * i;
            for (int c = 3; c < 9; c++)
                if (got[c] != want[c])
                    fail_msg("%s, pixel %u, channel %d: %g, not %g", techniques[t], i, c,
                             (double)got[c], (double)want[c]);
            lit += want[3] > 0.0f && got[0] > 0.0f;
        }
        print_message("%s: %g of %d pixels lit\n", techniques[t], lit, SIZE * SIZE);
        assert_true(lit > 0.7 * SIZE * SIZE);
        lsf_image_destroy(image);
    }
    lsf_image_destroy(expected);
    destroy_scene(scene);
}

/* --- hostile state ------------------------------------------------------------------------------
 */

static GLuint hostile_sampler, hostile_texture, hostile_framebuffer, hostile_target;
static PFNGLPUSHDEBUGGROUPPROC push_group;
static uint32_t groups, filled;

static void make_hostile_objects(void)
{
    glCreateSamplers(1, &hostile_sampler);
    glSamplerParameteri(hostile_sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glSamplerParameteri(hostile_sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glSamplerParameteri(hostile_sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glCreateTextures(GL_TEXTURE_2D, 1, &hostile_texture);
    glTextureStorage2D(hostile_texture, 2, GL_RGBA32F, 2, 2);
    glCreateTextures(GL_TEXTURE_2D, 1, &hostile_target);
    glTextureStorage2D(hostile_target, 1, GL_RGBA8, 4, 4);
    glCreateFramebuffers(1, &hostile_framebuffer);
    glNamedFramebufferTexture(hostile_framebuffer, GL_COLOR_ATTACHMENT0, hostile_target, 0);
}

/* All that a pass may have changed. */
static void set_hostile_state(void)
{
    static const GLenum on[] = {
        GL_SCISSOR_TEST,       GL_STENCIL_TEST,        GL_DEPTH_TEST,
        GL_DEPTH_CLAMP,        GL_CULL_FACE,           GL_BLEND,
        GL_COLOR_LOGIC_OP,     GL_POLYGON_OFFSET_FILL, GL_CLIP_DISTANCE0,
        GL_CLIP_DISTANCE0 + 1, GL_PRIMITIVE_RESTART,   GL_RASTERIZER_DISCARD};
    for (size_t i = 0; i < LSF_COUNT(on); i++)
        glEnable(on[i]);
    glScissor(1, 1, 1, 1);
    glViewport(1, 1, 2, 2);
    glStencilFunc(GL_NEVER, 1, 1);
    glDepthFunc(GL_NEVER);
    glDepthRange(0.9, 0.2);
    glDepthMask(GL_FALSE);
    glColorMask(GL_TRUE, GL_FALSE, GL_FALSE, GL_TRUE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glPolygonOffset(3.0f, 100.0f);
    glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
    glBlendFunc(GL_DST_COLOR, GL_ONE_MINUS_SRC_ALPHA);
    glLogicOp(GL_INVERT);
    glPrimitiveRestartIndex(0);
    for (GLuint unit = 0; unit < 32; unit++) {
        glBindTextureUnit(unit, hostile_texture);
        glBindSampler(unit, hostile_sampler);
    }
    for (GLuint unit = 0; unit < 8; unit++)
        glBindImageTexture(unit, hostile_texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    for (GLuint binding = 0; binding < 8; binding++) {
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, 0);
        if (binding != LSF_BINDING_VIEW) /* of the iteration, for all of its passes */
            glBindBufferBase(GL_UNIFORM_BUFFER, binding, 0);
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, hostile_framebuffer);
    glUseProgram(0);
}

/* A pass begins with a debug group. */
static void push_hostile_group(GLenum source, GLuint id, GLsizei length, const GLchar *message)
{
    set_hostile_state();
    groups++;
    push_group(source, id, length, message);
}

/* --- hostile memory -----------------------------------------------------------------------------
 * Software drivers give zeroes where others give what was there before. */

static PFNGLTEXTURESTORAGE2DPROC storage_2d;
static PFNGLTEXTURESTORAGE3DPROC storage_3d;
static PFNGLNAMEDBUFFERSTORAGEPROC buffer_storage;

/* Of every format a value that is neither zero nor rare: 2^13, or its nearest. */
static void fill_texture(GLuint texture, GLsizei levels)
{
    static const GLfloat number[4] = {8192.0f, 8192.0f, 8192.0f, 8192.0f};
    static const GLuint word[4] = {0x46004600u, 0x46004600u, 0x46004600u, 0x46004600u};
    for (GLint level = 0; level < levels; level++) {
        GLint depth = 0, type = 0;
        glGetTextureLevelParameteriv(texture, level, GL_TEXTURE_DEPTH_TYPE, &depth);
        glGetTextureLevelParameteriv(texture, level, GL_TEXTURE_RED_TYPE, &type);
        if (depth != GL_NONE)
            glClearTexImage(texture, level, GL_DEPTH_COMPONENT, GL_FLOAT, number);
        else if (type == GL_INT || type == GL_UNSIGNED_INT)
            glClearTexImage(texture, level, GL_RGBA_INTEGER, GL_UNSIGNED_INT, word);
        else
            glClearTexImage(texture, level, GL_RGBA, GL_FLOAT, number);
    }
    filled++;
}

static void hostile_storage_2d(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                               GLsizei height)
{
    storage_2d(texture, levels, format, width, height);
    fill_texture(texture, levels);
}

static void hostile_storage_3d(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                               GLsizei height, GLsizei depth)
{
    storage_3d(texture, levels, format, width, height, depth);
    fill_texture(texture, levels);
}

static void hostile_buffer_storage(GLuint buffer, GLsizeiptr size, const void *data,
                                   GLbitfield flags)
{
    static const GLubyte byte = 0x46;
    buffer_storage(buffer, size, data, flags);
    if (!data)
        glClearNamedBufferData(buffer, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, &byte);
    filled++;
}

static void set_hostile_memory(bool hostile)
{
    if (hostile) {
        storage_2d = glad_current->TextureStorage2D;
        storage_3d = glad_current->TextureStorage3D;
        buffer_storage = glad_current->NamedBufferStorage;
    }
    glad_current->TextureStorage2D = hostile ? hostile_storage_2d : storage_2d;
    glad_current->TextureStorage3D = hostile ? hostile_storage_3d : storage_3d;
    glad_current->NamedBufferStorage = hostile ? hostile_buffer_storage : buffer_storage;
}

static lsf_image *render_hostile(const lsf_scene *scene, const lsf_render_params *params)
{
    lsf_error error = {0};
    lsf_context *context = gl_test_context(gl_test_backend(), NULL);
    set_hostile_memory(true);
    lsf_renderer *renderer = lsf_renderer_create(context, scene, params, &error);
    set_hostile_memory(false);
    if (!renderer)
        fail_msg("%s", error.message);
    make_hostile_objects();
    push_group = glad_current->PushDebugGroup;
    glad_current->PushDebugGroup = push_hostile_group;
    bool good = lsf_renderer_run(renderer, &error);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VIEW, 0); /* as another renderer may do */
    lsf_image *image = good ? lsf_renderer_read(renderer, &error) : NULL;
    glad_current->PushDebugGroup = push_group;
    if (!image)
        fail_msg("%s", error.message);
    lsf_renderer_destroy(renderer);
    gl_test_check(context);
    lsf_context_destroy(context);
    return image;
}

static void check_hostile(const char *what, const lsf_scene *scene, lsf_render_params params)
{
    groups = filled = 0;
    lsf_image *expected = render_gl(gl_test_backend(), scene, &params);
    lsf_image *image = render_hostile(scene, &params);
    print_message("%s, %s: %u passes, %u textures and buffers\n", params.technique, what, groups,
                  filled);
    assert_true(groups > 4 && filled > 10);
    assert_same_pixels(image, expected);
    lsf_image_destroy(image);
    lsf_image_destroy(expected);
}

static void hostile_state(void **unused)
{
    (void)unused;
    lsf_scene *lit = textured_scene(true);
    finish_gl_scene(lit);
    for (size_t t = 0; t < LSF_COUNT(techniques); t++) {
        lsf_render_params params = params_of(techniques[t], NULL);
        params.bounces = 2;
        check_hostile("lamps and lights", lit, corner_params(params, SIZE));
    }
    destroy_scene(lit);
}

/* Single frames have filters and coarser grids of their own. */
static void hostile_state_of_frames(void **unused)
{
    (void)unused;
    static const struct {
        const char *technique, *options[3];
    } frames[] = {
        {"bidirectional", {"interleave.size=2"}},
        {"bidirectional", {"sparse.grid=4", "interleave.size=2", "sparse.outliers=on"}},
        {"voxel_path", {"sparse.grid=2"}},
        {"voxel_path", {"voxel.method=raster"}},
        {"cone", {"sparse.grid=2", "cone.sealed=off"}},
    };
    lsf_scene *scene = textured_scene(true);
    finish_gl_scene(scene);
    for (size_t i = 0; i < LSF_COUNT(frames); i++) {
        lsf_render_params params = params_of(frames[i].technique, frames[i].options);
        params.samples = 1;
        check_hostile(frames[i].options[0], scene, corner_params(params, SIZE));
    }
    destroy_scene(scene);
}

/* Past the edges of a room lit from outside, shadow maps show nothing. */
static void hostile_memory_beyond_walls(void **unused)
{
    (void)unused;
    static const float eye[3] = {-0.4f, 0.3f, 0.6f}, target[3] = {1, -1, -1};
    lsf_scene *scene = build_scene();
    build_material(scene, 0.8f, 0.8f, 0.8f);
    build_box(scene, lsf_f3(-1, -1, -1), lsf_f3(1, 1, 1), true);
    build_light(scene, LSF_LIGHT_DIRECTIONAL, lsf_f3(0, 0, 0), lsf_f3(-0.4f, -0.8f, -0.5f), 1.0f);
    finish_gl_scene(scene);
    lsf_render_params params = params_of("direct", NULL);
    params.width = params.height = 4 * SIZE;
    params.samples = 8;
    params.camera_position = eye;
    params.camera_target = target;
    check_hostile("edges of a room", scene, params);
    destroy_scene(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(techniques_see_one_surface),
        cmocka_unit_test(hostile_state),
        cmocka_unit_test(hostile_state_of_frames),
        cmocka_unit_test(hostile_memory_beyond_walls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
