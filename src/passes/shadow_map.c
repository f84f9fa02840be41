#include "passes/shadow_map.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/light.h"
#include "shared/scene_data.h"

/* Nearest occluder of a perspective map, in half extents of the scene. With reverse-Z and 32-bit
 * floats a small near plane costs no precision. */
#define NEAR_PLANE 1e-5f

/* A spot wider than this half angle gets a cube: one face would spend its texels on the rim. */
#define WIDE_SPOT_COSINE 0.5f

const lsf_option_row lsf_shadow_map_options[LSF_SHADOW_MAP_OPTION_COUNT] = {
    {"shadow.filter", LSF_OPTION_ENUM, offsetof(lsf_shadow_map_params, filter), 0, 0, "none|pcf",
     "", "pcf: 16-tap percentage-closer filter, for single frames"},
    {"shadow.texels_per_pixel", LSF_OPTION_FLOAT,
     offsetof(lsf_shadow_map_params, texels_per_pixel), 0.01, 64.0, NULL, "",
     "texels of a shadow map, all its faces together, for each pixel of the picture"},
};

static bool needs_cube(const lsf_light_state *light)
{
    return light->type == LSF_LIGHT_POINT ||
           (light->type == LSF_LIGHT_SPOT && light->cos_outer < WIDE_SPOT_COSINE);
}

static void plan_map(lsf_plan *plan, const lsf_shadow_map_params *params, const char *name,
                     uint32_t faces)
{
    double texels = (double)plan->width * plan->height * params->texels_per_pixel;
    uint32_t side = (uint32_t)ceil(sqrt(texels / faces));
    side = side < 16 ? 16 : side > 16384 ? 16384 : side;
    lsf_texture_desc desc = {NULL,  GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, side, side,
                             faces, 1};
    char full_name[64];
    snprintf(full_name, sizeof full_name, "shadow_map.%s_depth", name);
    lsf_plan_texture_desc_add(plan, full_name, &desc, "%g texels a pixel",
                              (double)params->texels_per_pixel);
    snprintf(full_name, sizeof full_name, "shadow_map.%s_gradient", name);
    desc.internal_format = GL_RG32F;
    if (params->filter == LSF_SHADOW_FILTER_NONE)
        lsf_plan_texture_desc_add(plan, full_name, &desc, "the plane of each texel's surface");
    else
        lsf_plan_omit(plan, full_name, "shadow.filter is pcf");
}

void lsf_shadow_map_plan(lsf_plan *plan, const lsf_shadow_map_params *params,
                         const lsf_state *state)
{
    bool cube = false, single = false;
    for (uint32_t i = 0; i < state->light_count; i++)
        *(needs_cube(&state->lights[i]) ? &cube : &single) = true;
    lsf_plan_pass_add(plan, "shadow_map", "what %u punctual light%s see", state->light_count,
                      state->light_count == 1 ? "" : "s");
    lsf_plan_switch_add(plan, "LSF_GRADIENT", params->filter == LSF_SHADOW_FILTER_NONE,
                        "planes are compared, not depths");
    lsf_plan_switch_add(plan, "LSF_MASK", plan->requirements.masked,
                        "some material is alpha-masked");
    lsf_plan_switch_add(plan, "LSF_TEXTURED",
                        plan->requirements.masked && plan->requirements.base_color_textured,
                        "masks are textures");
    lsf_plan_switch_add(plan, "LSF_SECOND_UV",
                        plan->requirements.masked && plan->requirements.second_uv,
                        "some texture reads TEXCOORD_1");
    lsf_plan_switch_add(plan, "LSF_VERTEX_COLOR",
                        plan->requirements.masked && plan->requirements.vertex_colored,
                        "vertex colours have alpha");
    if (cube)
        plan_map(plan, params, "cube", 6);
    else
        lsf_plan_omit(plan, "shadow_map.cube_depth", "no point light and no wide spot");
    if (single)
        plan_map(plan, params, "single", 1);
    else
        lsf_plan_omit(plan, "shadow_map.single_depth", "no directional light and no narrow spot");
    lsf_plan_buffer_add(plan, "shadow_map.light", sizeof(struct lsf_light_data),
                        "the light in turn and its map's projection");
}

static bool create_target(lsf_shadow_map_target *target, lsf_context *context,
                          const lsf_plan *plan, const char *name, lsf_error *error)
{
    char depth_name[64], gradient_name[64];
    snprintf(depth_name, sizeof depth_name, "shadow_map.%s_depth", name);
    snprintf(gradient_name, sizeof gradient_name, "shadow_map.%s_gradient", name);
    const lsf_plan_resource *resource = lsf_plan_find(plan, depth_name);
    if (!resource)
        return true;
    target->faces = resource->texture.depth;
    target->resolution = resource->texture.width;
    if (!lsf_plan_create_texture(plan, context, depth_name, &target->depth, error) ||
        !lsf_plan_create_texture(plan, context, gradient_name, &target->gradient, error))
        return false;
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_desc desc = {.label = depth_name,
                                     .color_count = target->gradient ? 1 : 0,
                                     .colors = {target->gradient},
                                     .depth = target->depth,
                                     .layer = (int32_t)face};
        target->framebuffers[face] = lsf_framebuffer_create(context, &desc, error);
        if (!target->framebuffers[face])
            return false;
    }
    return true;
}

bool lsf_shadow_map_create(lsf_shadow_map *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"passes/shadow_map.vert.glsl",
                                         "passes/shadow_map.frag.glsl"};
    *pass = (lsf_shadow_map){.context = context};
    if (!create_target(&pass->cube, context, plan, "cube", error) ||
        !create_target(&pass->single, context, plan, "single", error) ||
        !lsf_plan_create_buffer(plan, context, "shadow_map.light", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &pass->outputs.light_buffer, error))
        return false;
    pass->program = lsf_plan_program(plan, context, "shadow_map", files, error);
    pass->timer = lsf_timer_create(context, "shadow_map", error);
    return pass->program && pass->timer;
}

static lsf_vec4 vec4_from(lsf_float3 v, float w)
{
    return (lsf_vec4){v.x, v.y, v.z, w};
}

static void set_face(struct lsf_light_data *data, uint32_t face, lsf_float3 right, lsf_float3 up,
                     lsf_float3 forward)
{
    data->map_right[face] = vec4_from(right, 0.0f);
    data->map_up[face] = vec4_from(up, 0.0f);
    data->map_forward[face] = vec4_from(forward, 0.0f);
}

/* Six faces about three axes, turned at random, so that no texel border stays in place. */
static void project_cube(struct lsf_light_data *data, const float rotation[9])
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        lsf_float3 forward = lsf_f3_load(rotation + 3 * axis);
        lsf_float3 right = lsf_f3_load(rotation + 3 * ((axis + 1) % 3));
        lsf_float3 up = lsf_f3_load(rotation + 3 * ((axis + 2) % 3));
        set_face(data, 2 * axis, right, up, forward);
        set_face(data, 2 * axis + 1, right, up, lsf_f3_scale(forward, -1.0f));
    }
    data->map_extent = (lsf_vec4){1.0f, 1.0f, 0.0f, 0.0f};
}

/* right and up of a map that looks along `forward`, turned by `angle` about it. */
static void turned_axes(const lsf_light_state *light, float angle, lsf_float3 *right,
                        lsf_float3 *up)
{
    lsf_float3 forward = lsf_f3_load(light->direction), t = lsf_f3_load(light->tangent);
    lsf_float3 b = lsf_f3_cross(forward, t);
    *right = lsf_f3_mad(lsf_f3_scale(t, cosf(angle)), b, sinf(angle));
    *up = lsf_f3_cross(forward, *right);
}

/* The window that holds the whole scene; rays start outside of its bounds. */
static void project_directional(struct lsf_light_data *data, const lsf_state *state,
                                lsf_float3 right, lsf_float3 up, lsf_float3 forward)
{
    lsf_float3 axes[3] = {right, up, forward};
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        for (int corner = 0; corner < 8 && !instance->skipped; corner++) {
            lsf_float3 p = lsf_f3(
                (corner & 1 ? instance->bounds_max : instance->bounds_min)[0],
                (corner & 2 ? instance->bounds_max : instance->bounds_min)[1],
                (corner & 4 ? instance->bounds_max : instance->bounds_min)[2]);
            for (int axis = 0; axis < 3; axis++) {
                float at = lsf_f3_dot(p, axes[axis]);
                low[axis] = fminf(low[axis], at);
                high[axis] = fmaxf(high[axis], at);
            }
        }
    }
    lsf_float3 origin = lsf_f3(0.0f, 0.0f, 0.0f);
    float half[3] = {1.0f, 1.0f, 1.0f};
    for (int axis = 0; axis < 3 && low[0] <= high[0]; axis++) {
        /* A flat scene still needs a window. */
        half[axis] = fmaxf(0.5f * (high[axis] - low[axis]), 1e-3f);
        float start = axis < 2 ? 0.5f * (high[axis] + low[axis])
                               : 0.5f * (high[axis] + low[axis]) - 1.01f * half[axis];
        origin = lsf_f3_mad(origin, axes[axis], start);
    }
    /* One texel more on each side is room for the sub-texel offset. */
    float room = 1.0f + 2.0f * data->map_shape.w;
    data->map_origin = vec4_from(origin, 1.0f);
    data->map_shape.x = 0.0f;
    data->map_shape.y = 2.02f * half[2];
    data->map_extent.x = half[0] * room;
    data->map_extent.y = half[1] * room;
}

static void set_light(struct lsf_light_data *data, const lsf_light_state *light)
{
    float spot_scale = 0.0f, spot_offset = 1.0f;
    if (light->type == LSF_LIGHT_SPOT) {
        spot_scale = lsf_spot_scale(light->cos_inner, light->cos_outer);
        spot_offset = -light->cos_outer * spot_scale;
    }
    memset(data, 0, sizeof *data);
    data->position = vec4_from(lsf_f3_load(light->position), 0.0f);
    data->direction = vec4_from(lsf_f3_load(light->direction), 0.0f);
    data->intensity = vec4_from(lsf_f3_load(light->intensity), 0.0f);
    data->attenuation = (lsf_vec4){1.0f / (light->range * light->range), spot_scale, spot_offset,
                                   (float)light->type};
}

static void set_projection(struct lsf_light_data *data, const lsf_iteration *iteration,
                           const lsf_light_state *light, uint32_t light_index,
                           const lsf_shadow_map_target *target)
{
    /* Two Sobol pairs of this light's own. */
    float turn[2], shift[2], rotation[9];
    lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, 2 * light_index + 1), turn);
    lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, 2 * light_index + 2), shift);
    float texels = (float)target->resolution;
    data->map_shape = (lsf_vec4){NEAR_PLANE, 0.0f, texels, 1.0f / texels};
    data->map_origin = vec4_from(lsf_f3_load(light->position), (float)target->faces);
    if (target->faces == 6) {
        lsf_sample_rotation(turn[0], turn[1], shift[0], rotation);
        project_cube(data, rotation);
        return;
    }
    lsf_float3 right, up, forward = lsf_f3_load(light->direction);
    turned_axes(light, turn[0] * 2.0f * LSF_PI, &right, &up);
    set_face(data, 0, right, up, forward);
    data->map_extent.z = (2.0f * shift[0] - 1.0f) / texels;
    data->map_extent.w = (2.0f * shift[1] - 1.0f) / texels;
    if (light->type == LSF_LIGHT_DIRECTIONAL) {
        project_directional(data, iteration->state, right, up, forward);
    } else {
        float tangent = sqrtf(1.0f - light->cos_outer * light->cos_outer) / light->cos_outer;
        data->map_extent.x = data->map_extent.y =
            fmaxf(tangent, 1e-4f) * (1.0f + 2.0f / texels);
    }
}

static float dot_vec4(lsf_vec4 a, lsf_vec4 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The half spaces of one face's sides: x, y = +-1 on the map. */
static void face_region(const struct lsf_light_data *data, uint32_t face, lsf_draw_region *region)
{
    bool perspective = data->map_shape.y == 0.0f;
    region->plane_count = 4;
    for (int i = 0; i < 4; i++) {
        lsf_vec4 axis = i < 2 ? data->map_right[face] : data->map_up[face];
        lsf_vec4 forward = data->map_forward[face];
        float extent = i < 2 ? data->map_extent.x : data->map_extent.y;
        float offset = i < 2 ? data->map_extent.z : data->map_extent.w;
        float sign = i % 2 ? -1.0f : 1.0f;
        /* 1 - sign (q / extent + offset) >= 0, times q.z when perspective */
        float along = perspective ? 1.0f - sign * offset : 0.0f;
        lsf_vec4 plane = {along * forward.x - sign * axis.x / extent,
                          along * forward.y - sign * axis.y / extent,
                          along * forward.z - sign * axis.z / extent, 0.0f};
        region->planes[i][0] = plane.x;
        region->planes[i][1] = plane.y;
        region->planes[i][2] = plane.z;
        region->planes[i][3] =
            (perspective ? 0.0f : 1.0f - sign * offset) - dot_vec4(plane, data->map_origin);
    }
}

void lsf_shadow_map_run(lsf_shadow_map *pass, const lsf_iteration *iteration, uint32_t light_index)
{
    static const GLfloat zero[4] = {0};
    const lsf_light_state *light = &iteration->state->lights[light_index];
    const lsf_shadow_map_target *target = needs_cube(light) ? &pass->cube : &pass->single;
    struct lsf_light_data *data = &pass->outputs.light;
    lsf_timer_begin(pass->timer);
    set_light(data, light);
    set_projection(data, iteration, light, light_index, target);
    glNamedBufferSubData(pass->outputs.light_buffer, 0, sizeof *data, data);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, pass->outputs.light_buffer);
    glViewport(0, 0, (GLsizei)target->resolution, (GLsizei)target->resolution);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_GREATER);
    glUseProgram(pass->program);
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_draw_region region;
        face_region(data, face, &region);
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[face]);
        glClearNamedFramebufferfv(target->framebuffers[face], GL_DEPTH, 0, zero);
        glUniform1i(0, (GLint)face);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_POSITIONS, &region);
    }
    pass->outputs.depth = target->depth;
    pass->outputs.gradient = target->gradient;
    lsf_timer_end(pass->timer);
}

static void destroy_target(lsf_context *context, lsf_shadow_map_target *target)
{
    for (uint32_t face = 0; face < target->faces; face++)
        lsf_framebuffer_destroy(context, &target->framebuffers[face]);
    lsf_texture_destroy(context, &target->depth);
    lsf_texture_destroy(context, &target->gradient);
}

void lsf_shadow_map_destroy(lsf_shadow_map *pass)
{
    if (!pass->context)
        return;
    destroy_target(pass->context, &pass->cube);
    destroy_target(pass->context, &pass->single);
    lsf_buffer_destroy(pass->context, &pass->outputs.light_buffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
