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

/* Texels along a face's side: a small picture still deserves a shadow of the right shape, and
 * GL 4.5 promises this much. */
#define MIN_SIDE 128
#define MAX_SIDE 16384

/* A spot wider than this half angle gets a cube: one face would spend its texels on the rim. */
#define WIDE_SPOT_COSINE 0.5f

const lsf_option_row lsf_shadow_map_options[LSF_SHADOW_MAP_OPTION_COUNT] = {
    {"shadow.filter", LSF_OPTION_ENUM, offsetof(lsf_shadow_map_params, filter), 0, 0, "none|pcf",
     "", "pcf: 16-tap percentage-closer filter, for single frames"},
    {"shadow.texels_per_pixel", LSF_OPTION_FLOAT, offsetof(lsf_shadow_map_params, texels_per_pixel),
     0.01, 64.0, NULL, "",
     "texels of a shadow map, all its faces together, for each pixel of the picture"},
};

/* Each cascade sees this many times farther than the one before. */
#define CASCADE_RATIO 3.0f

static const struct {
    const char *name;
    uint32_t faces;
    const char *omitted;
} kinds[LSF_SHADOW_MAP_KINDS] = {
    {"cube", 6, "no point light and no wide spot"},
    {"spot", 1, "no narrow spot"},
    {"cascades", 4, "no directional light"},
};

static lsf_shadow_map_kind kind_of(const lsf_light_state *light)
{
    if (light->type == LSF_LIGHT_DIRECTIONAL)
        return LSF_SHADOW_MAP_CASCADES;
    bool narrow = light->type == LSF_LIGHT_SPOT && light->cos_outer >= WIDE_SPOT_COSINE;
    return narrow ? LSF_SHADOW_MAP_SPOT : LSF_SHADOW_MAP_CUBE;
}

static void plan_map(lsf_plan *plan, const lsf_shadow_map_params *params, const char *name,
                     uint32_t faces)
{
    double texels = (double)plan->width * plan->height * params->texels_per_pixel;
    uint32_t side = (uint32_t)ceil(sqrt(texels / faces));
    side = side < MIN_SIDE ? MIN_SIDE : side > MAX_SIDE ? MAX_SIDE : side;
    lsf_texture_desc desc = {NULL, GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, side, side, faces,
                             1};
    char full_name[64];
    snprintf(full_name, sizeof full_name, "shadow_map.%s_depth", name);
    lsf_plan_texture_desc_add(plan, full_name, &desc, "%g texels a pixel",
                              (double)params->texels_per_pixel);
    snprintf(full_name, sizeof full_name, "shadow_map.%s_gradient", name);
    desc.internal_format = GL_RG16F;
    if (params->filter == LSF_SHADOW_FILTER_NONE)
        lsf_plan_texture_desc_add(plan, full_name, &desc, "the plane of each texel's surface");
    else
        lsf_plan_omit(plan, full_name, "shadow.filter is pcf");
}

void lsf_shadow_map_plan(lsf_plan *plan, const lsf_shadow_map_params *params,
                         const lsf_state *state)
{
    bool needed[LSF_SHADOW_MAP_KINDS] = {false};
    for (uint32_t i = 0; i < state->light_count; i++)
        needed[kind_of(&state->lights[i])] = true;
    lsf_plan_pass_add(plan, "shadow_map", "what %u punctual light%s see", state->light_count,
                      state->light_count == 1 ? "" : "s");
    lsf_plan_switch_add(plan, "LSF_GRADIENT", params->filter == LSF_SHADOW_FILTER_NONE,
                        "shadow.filter is none: planes are compared");
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
                        "masked primitives have vertex colours");
    for (int kind = 0; kind < LSF_SHADOW_MAP_KINDS; kind++) {
        char name[64];
        snprintf(name, sizeof name, "shadow_map.%s", kinds[kind].name);
        if (needed[kind])
            plan_map(plan, params, kinds[kind].name, kinds[kind].faces);
        else
            lsf_plan_omit(plan, name, "%s", kinds[kind].omitted);
    }
    lsf_plan_buffer_add(plan, "shadow_map.light", sizeof(struct lsf_light_data),
                        "the light in turn and its map's projection");
}

static bool create_target(lsf_shadow_map_target *target, lsf_context *context, const lsf_plan *plan,
                          const char *name, lsf_error *error)
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
    for (int kind = 0; kind < LSF_SHADOW_MAP_KINDS; kind++)
        if (!create_target(&pass->targets[kind], context, plan, kinds[kind].name, error))
            return false;
    if (!lsf_plan_create_buffer(plan, context, "shadow_map.light", NULL, GL_DYNAMIC_STORAGE_BIT,
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
    for (uint32_t face = 0; face < 6; face++)
        data->map_window[face] = (lsf_vec4){0.0f, 0.0f, 1.0f, 1.0f};
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

typedef struct box {
    float low[3], high[3];
} box;

static void box_add(box *b, const lsf_float3 axes[3], lsf_float3 p)
{
    for (int axis = 0; axis < 3; axis++) {
        float at = lsf_f3_dot(p, axes[axis]);
        b->low[axis] = fminf(b->low[axis], at);
        b->high[axis] = fmaxf(b->high[axis], at);
    }
}

static const box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* Bounds of the scene along the axes; the unit box when it is empty. */
static box scene_box(const lsf_state *state, const lsf_float3 axes[3])
{
    box b = empty_box;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_instance_state *instance = &state->instances[i];
        for (int corner = 0; corner < 8 && !instance->skipped; corner++)
            box_add(&b, axes,
                    lsf_f3((corner & 1 ? instance->bounds_max : instance->bounds_min)[0],
                           (corner & 2 ? instance->bounds_max : instance->bounds_min)[1],
                           (corner & 4 ? instance->bounds_max : instance->bounds_min)[2]));
    }
    return b.low[0] <= b.high[0] ? b : (box){{-1, -1, -1}, {1, 1, 1}};
}

/* Bounds, along the axes, of what the camera sees up to `depth`. */
static box view_box(const lsf_camera_state *camera, const lsf_float3 axes[3], float depth)
{
    box b = empty_box;
    for (int corner = 0; corner < 8; corner++) {
        float x = corner & 1 ? 1.0f : -1.0f, y = corner & 2 ? 1.0f : -1.0f;
        float z = corner & 4 ? depth : 0.0f;
        lsf_float3 p = lsf_f3_load(camera->origin);
        p = lsf_f3_mad(p, lsf_f3_load(camera->origin_dx), x);
        p = lsf_f3_mad(p, lsf_f3_load(camera->origin_dy), y);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward), z);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward_dx), z * x);
        p = lsf_f3_mad(p, lsf_f3_load(camera->forward_dy), z * y);
        box_add(&b, axes, p);
    }
    return b;
}

/* View depths between which the scene lies, from the viewer on. */
static void scene_depths(const lsf_state *state, float *nearest, float *farthest)
{
    const lsf_camera_state *camera = &state->camera;
    *nearest = INFINITY;
    *farthest = 0.0f;
    for (int corner = 0; corner < 8; corner++) {
        lsf_float3 p = lsf_f3((corner & 1 ? state->bounds_max : state->bounds_min)[0],
                              (corner & 2 ? state->bounds_max : state->bounds_min)[1],
                              (corner & 4 ? state->bounds_max : state->bounds_min)[2]);
        float depth =
            lsf_f3_dot(lsf_f3_sub(p, lsf_f3_load(camera->origin)), lsf_f3_load(camera->forward));
        *nearest = fminf(*nearest, depth);
        *farthest = fmaxf(*farthest, depth);
    }
    *nearest = fminf(fmaxf(*nearest, 0.0f), *farthest); /* an empty scene: nothing to see */
}

/* Nested windows: each reaches a third as deep into the scene as the next one, so that a texel is
 * everywhere about as wide as a pixel is there; the last holds all that is seen. Along the
 * light, each holds the whole scene, which may cast its shadow from outside the view. */
static void project_cascades(struct lsf_light_data *data, const lsf_state *state, uint32_t faces,
                             lsf_float3 right, lsf_float3 up, lsf_float3 forward)
{
    const lsf_float3 axes[3] = {right, up, forward};
    box scene = scene_box(state, axes);
    float half_range = fmaxf(0.5f * (scene.high[2] - scene.low[2]), 1e-3f);
    float start = 0.5f * (scene.high[2] + scene.low[2]) - 1.01f * half_range;
    data->map_origin = vec4_from(lsf_f3_scale(forward, start), (float)faces);
    data->map_shape.x = 0.0f;
    data->map_shape.y = 2.02f * half_range;
    float nearest, farthest;
    scene_depths(state, &nearest, &farthest);
    float reach = farthest - nearest;
    for (uint32_t i = 0; i < faces; i++, reach /= CASCADE_RATIO) {
        uint32_t face = faces - 1 - i;
        box view = view_box(&state->camera, axes, nearest + reach);
        float center[2], extent[2];
        for (int axis = 0; axis < 2; axis++) {
            float low = fmaxf(view.low[axis], scene.low[axis]);
            float high = fminf(view.high[axis], scene.high[axis]);
            bool outside = !(low <= high); /* nothing of the scene is in view */
            center[axis] = outside ? scene.low[axis] : 0.5f * (low + high);
            /* One texel more on each side is room for the offset. */
            extent[axis] = fmaxf(outside ? 0.0f : 0.5f * (high - low), 1e-4f) *
                           (1.0f + 2.0f * data->map_shape.w);
        }
        set_face(data, face, right, up, forward);
        data->map_window[face] = (lsf_vec4){center[0], center[1], extent[0], extent[1]};
    }
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
    data->map_offset.x = (2.0f * shift[0] - 1.0f) / texels;
    data->map_offset.y = (2.0f * shift[1] - 1.0f) / texels;
    if (light->type == LSF_LIGHT_DIRECTIONAL) {
        project_cascades(data, iteration->state, target->faces, right, up, forward);
    } else {
        float tangent = sqrtf(1.0f - light->cos_outer * light->cos_outer) / light->cos_outer;
        float extent = fmaxf(tangent, 1e-4f) * (1.0f + 2.0f / texels);
        set_face(data, 0, right, up, forward);
        data->map_window[0] = (lsf_vec4){0.0f, 0.0f, extent, extent};
    }
}

/* The half spaces of one face's sides: x, y = +-1 on the map. */
static void face_region(const struct lsf_light_data *data, uint32_t face, lsf_draw_region *region)
{
    const float window[4] = {data->map_window[face].x, data->map_window[face].y,
                             data->map_window[face].z, data->map_window[face].w};
    const float offset[2] = {data->map_offset.x, data->map_offset.y};
    const float *axes[3] = {&data->map_right[face].x, &data->map_up[face].x,
                            &data->map_forward[face].x};
    const float *origin = &data->map_origin.x;
    bool perspective = data->map_shape.y == 0.0f;
    region->plane_count = 4;
    for (int i = 0; i < 4; i++) {
        int side = i / 2;
        float sign = i % 2 ? -1.0f : 1.0f;
        /* 1 - sign ((q - center) / extent + offset) >= 0; when perspective, times q.z */
        float along = perspective ? 1.0f - sign * offset[side] : 0.0f;
        float *plane = region->planes[i];
        plane[3] =
            perspective ? 0.0f : 1.0f - sign * (offset[side] - window[side] / window[2 + side]);
        for (int axis = 0; axis < 3; axis++) {
            plane[axis] = along * axes[2][axis] - sign * axes[side][axis] / window[2 + side];
            plane[3] -= plane[axis] * origin[axis];
        }
    }
}

void lsf_shadow_map_run(lsf_shadow_map *pass, const lsf_iteration *iteration, uint32_t light_index)
{
    static const GLfloat zero[4] = {0};
    const lsf_light_state *light = &iteration->state->lights[light_index];
    const lsf_shadow_map_target *target = &pass->targets[kind_of(light)];
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
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_POSITIONS, &region,
                           pass->counts);
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
    for (int kind = 0; kind < LSF_SHADOW_MAP_KINDS; kind++)
        destroy_target(pass->context, &pass->targets[kind]);
    lsf_buffer_destroy(pass->context, &pass->outputs.light_buffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
