#include "surface_rig.h"

#include <math.h>

#include "base/base.h"
#include "octahedral.h"
#include "passes/gbuffer.h"

GLuint surface_rig_texture(surface_rig *r, GLenum format, uint32_t width, uint32_t height)
{
    lsf_error error = {0};
    lsf_texture_desc desc = {"test", GL_TEXTURE_2D, format, width, height, 1, 1};
    GLuint name = lsf_texture_create(r->context, &desc, &error);
    if (!name)
        fail_msg("%s", error.message);
    return name;
}

static lsf_scene *glossy_scene(bool orthographic)
{
    lsf_scene *scene = build_scene();
    lsf_material *material = build_material(scene, 0.8f, 0.8f, 0.8f);
    material->roughness = 0.5f;
    material->anisotropy_strength = 0.5f;
    build_floor(scene, 0.0f, 1.0f);
    scene->cameras[0].orthographic = orthographic;
    scene->cameras[0].x_magnification = scene->cameras[0].y_magnification = 1.0f;
    finish_gl_scene(scene);
    return scene;
}

void surface_rig_begin(surface_rig *r, uint32_t width, uint32_t height, bool orthographic)
{
    static const float eye[3] = {0.3f, 1.5f, 2.5f}, target[3] = {0, 0, 0};
    lsf_error error = {0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    memset(r, 0, sizeof *r);
    r->width = width;
    r->height = height;
    r->context = gl_test_context(gl_test_backend(), NULL);
    r->scene = glossy_scene(orthographic);
    params.width = width;
    params.height = height;
    params.camera_position = eye;
    params.camera_target = target;
    if (!lsf_setup_begin(&r->setup, r->scene, &params, true, &error))
        fail_msg("%s", error.message);
    lsf_gbuffer_plan(r->setup.plan);
    uint32_t pixels = width * height;
    r->depths = calloc(pixels, sizeof *r->depths);
    r->surfaces = calloc(pixels, sizeof *r->surfaces);
    r->glosses = calloc(pixels, sizeof *r->glosses);
    assert_true(r->depths && r->surfaces && r->glosses);
}

void surface_rig_start(surface_rig *r)
{
    lsf_error error = {0};
    if (!lsf_iteration_create(&r->iteration, r->context, r->setup.plan, &r->scene_gpu,
                              &r->setup.state, NULL, 1, &error))
        fail_msg("%s", error.message);
    lsf_iteration_begin(&r->iteration, 0);
    r->maps.depth = surface_rig_texture(r, GL_DEPTH_COMPONENT32F, r->width, r->height);
    r->maps.surface = surface_rig_texture(r, GL_RGBA32UI, r->width, r->height);
    r->maps.specular_params = surface_rig_texture(r, GL_RG32UI, r->width, r->height);
}

void surface_rig_end(surface_rig *r)
{
    lsf_texture_destroy(r->context, &r->maps.depth);
    lsf_texture_destroy(r->context, &r->maps.surface);
    lsf_texture_destroy(r->context, &r->maps.specular_params);
    lsf_iteration_destroy(&r->iteration);
    lsf_setup_finish(&r->setup);
    gl_test_check(r->context);
    assert_int_equal(lsf_context_get_info(r->context).gl_bytes, 0);
    lsf_context_destroy(r->context);
    lsf_scene_destroy(r->scene);
    free(r->depths);
    free(r->surfaces);
    free(r->glosses);
}

/* origin + x dx + y dy at the pixel's sample. */
static lsf_float3 at_sample(const surface_rig *r, uint32_t x, uint32_t y, const lsf_vec4 v[3])
{
    const struct lsf_view_data *view = &r->iteration.view;
    float ndc_x = ((float)x + 0.5f) * 2.0f * view->size.z - 1.0f + view->jitter.x;
    float ndc_y = ((float)y + 0.5f) * 2.0f * view->size.w - 1.0f + view->jitter.y;
    lsf_float3 p = lsf_f3_mad(lsf_f3_load(&v[0].x), lsf_f3_load(&v[1].x), ndc_x);
    return lsf_f3_mad(p, lsf_f3_load(&v[2].x), ndc_y);
}

lsf_float3 surface_rig_ray(const surface_rig *r, uint32_t x, uint32_t y)
{
    const struct lsf_view_data *view = &r->iteration.view;
    const lsf_vec4 forward[3] = {view->forward, view->forward_dx, view->forward_dy};
    return at_sample(r, x, y, forward);
}

/* Reverse-Z, as view.h says. */
static float depth_of(const surface_rig *r, uint32_t x, uint32_t y, const seen *s)
{
    const struct lsf_view_data *view = &r->iteration.view;
    const lsf_vec4 origins[3] = {view->start, view->start_dx, view->start_dy};
    float above = s->offset - lsf_f3_dot(s->plane, at_sample(r, x, y, origins));
    float z = above / lsf_f3_dot(s->plane, surface_rig_ray(r, x, y));
    float a = view->depth.x, b = view->depth.y;
    assert_true(z > r->setup.state.camera.near_plane);
    return r->setup.plan->orthographic ? a * z + b : (a * z + b) / (z + view->depth.w);
}

float surface_rig_pixel(const surface_rig *r)
{
    return 2.0f * lsf_f3_length(lsf_f3_load(&r->iteration.view.forward_dx.x)) / (float)r->width;
}

void surface_rig_see(surface_rig *r, uint32_t x, uint32_t y, const seen *s)
{
    uint32_t i = y * r->width + x;
    r->depths[i] = s->background ? 0.0f : depth_of(r, x, y, s);
    r->surfaces[i][0] = octahedral_encode(s->plane);
    r->surfaces[i][1] = octahedral_encode(s->normal);
    r->surfaces[i][2] = i * 2654435761u; /* any colour */
    r->surfaces[i][3] = s->unlit ? 0x80000000u : 0u;
    r->glosses[i][0] = (uint32_t)lrintf(s->roughness * 65535.0f);
    r->glosses[i][1] = (uint32_t)lrintf(s->anisotropy * 65535.0f);
}

void surface_rig_upload(surface_rig *r)
{
    GLsizei w = (GLsizei)r->width, h = (GLsizei)r->height;
    glTextureSubImage2D(r->maps.depth, 0, 0, 0, w, h, GL_DEPTH_COMPONENT, GL_FLOAT, r->depths);
    glTextureSubImage2D(r->maps.surface, 0, 0, 0, w, h, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                        r->surfaces);
    glTextureSubImage2D(r->maps.specular_params, 0, 0, 0, w, h, GL_RG_INTEGER, GL_UNSIGNED_INT,
                        r->glosses);
}

seen surface_rig_wall(const surface_rig *r, float distance)
{
    lsf_float3 n = lsf_f3_scale(lsf_f3_load(&r->iteration.view.forward.x), -1.0f);
    float at_eye = lsf_f3_dot(n, lsf_f3_load(&r->iteration.view.start.x));
    return (seen){.plane = n, .normal = n, .offset = at_eye - distance, .roughness = 1.0f};
}

seen surface_rig_ground(void)
{
    return (seen){.plane = {0, 1, 0}, .normal = {0, 1, 0}, .offset = -1.5f, .roughness = 1.0f};
}

void surface_rig_write(GLuint texture, uint32_t width, uint32_t height, const float *texels)
{
    glTextureSubImage2D(texture, 0, 0, 0, (GLsizei)width, (GLsizei)height, GL_RGBA, GL_FLOAT,
                        texels);
}

void surface_rig_read(GLuint texture, uint32_t width, uint32_t height, float *texels)
{
    glGetTextureImage(texture, 0, GL_RGBA, GL_FLOAT, (GLsizei)(width * height * 4 * sizeof *texels),
                      texels);
}
