#include "passes/shadow_map.h"
#include "frame/purpose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

/* Texels along a face's side: a small picture still deserves a shadow of the right shape, and
 * GL 4.5 promises this much. */
#define MIN_SIDE 128
#define MAX_SIDE 16384

const lsf_option_row lsf_shadow_map_options[LSF_SHADOW_MAP_OPTION_COUNT] = {
    {"shadow.filter", LSF_OPTION_ENUM, offsetof(lsf_shadow_map_params, filter), 0, 0, "none|pcf",
     "", "pcf: 16-tap percentage-closer filter, for single frames"},
    {"shadow.texels_per_pixel", LSF_OPTION_FLOAT, offsetof(lsf_shadow_map_params, texels_per_pixel),
     0.0, 64.0, NULL, "",
     "texels of a shadow map, all its faces together, for each pixel of the picture; 0: 16, or 4 "
     "where a time limit is short for the picture's size"},
};

#define CASCADES 4

static const struct {
    const char *name;
    uint32_t faces;
    const char *omitted;
} kinds[LSF_LIGHT_PROJECTION_KINDS] = {
    {"cube", 6, "no point light and no wide spot"},
    {"spot", 1, "no narrow spot"},
    {"cascades", CASCADES, "no directional light"},
};

static double texels_per_pixel(const lsf_plan *plan, const lsf_shadow_map_params *params)
{
    if (params->texels_per_pixel > 0.0f)
        return (double)params->texels_per_pixel;
    return plan->hurried ? LSF_SHADOW_MAP_TEXELS_HURRIED : LSF_SHADOW_MAP_TEXELS;
}

/* `parts`: faces that share the texels of a map. */
static uint32_t face_side(const lsf_plan *plan, const lsf_shadow_map_params *params, uint32_t parts)
{
    double texels = (double)plan->width * plan->height * texels_per_pixel(plan, params);
    uint32_t side = (uint32_t)ceil(sqrt(texels / parts));
    return side < MIN_SIDE ? MIN_SIDE : side > MAX_SIDE ? MAX_SIDE : side;
}

uint32_t lsf_shadow_map_cascade_side(const lsf_plan *plan, const lsf_shadow_map_params *params)
{
    return face_side(plan, params, CASCADES);
}

static void plan_map(lsf_plan *plan, const lsf_shadow_map_params *params, const char *name,
                     uint32_t faces, uint32_t side, const char *why)
{
    lsf_texture_desc desc = {NULL, GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, side, side, faces,
                             1};
    char full_name[64];
    snprintf(full_name, sizeof full_name, "shadow_map.%s_depth", name);
    lsf_plan_texture_desc_add(plan, full_name, &desc, "%s", why);
    snprintf(full_name, sizeof full_name, "shadow_map.%s_gradient", name);
    desc.internal_format = GL_RG16F;
    if (params->filter == LSF_SHADOW_FILTER_NONE)
        lsf_plan_texture_desc_add(plan, full_name, &desc, "the plane of each texel's surface");
    else
        lsf_plan_omit(plan, full_name, "shadow.filter is pcf");
    if (!lsf_light_walls_needed(plan))
        return;
    snprintf(full_name, sizeof full_name, "shadow_map.%s_tint", name);
    desc.internal_format = lsf_light_tint_format(plan);
    lsf_plan_texture_desc_add(plan, full_name, &desc, "light passes thin walls");
}

static void needed_kinds(const lsf_state *state, bool needed[LSF_LIGHT_PROJECTION_KINDS])
{
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        needed[kind] = false;
    for (uint32_t i = 0; i < state->light_count; i++)
        needed[lsf_light_projection_kind_of(&state->lights[i])] = true;
}

void lsf_shadow_map_plan(lsf_plan *plan, const lsf_shadow_map_params *params,
                         const lsf_state *state)
{
    bool needed[LSF_LIGHT_PROJECTION_KINDS];
    needed_kinds(state, needed);
    lsf_plan_pass_add(plan, "shadow_map", "what %u punctual light%s see%s", state->light_count,
                      lsf_plural(state->light_count), state->light_count == 1 ? "s" : "");
    lsf_plan_reads(plan, "scene");
    lsf_plan_switch_add(plan, "LSF_GRADIENT", params->filter == LSF_SHADOW_FILTER_NONE,
                        "shadow.filter is none: planes are compared");
    lsf_scene_gpu_mask_switches(plan);
    char why[64];
    lsf_print(why, sizeof why, "%g texels a pixel", texels_per_pixel(plan, params));
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++) {
        char name[64];
        snprintf(name, sizeof name, "shadow_map.%s", kinds[kind].name);
        if (needed[kind])
            plan_map(plan, params, kinds[kind].name, kinds[kind].faces,
                     face_side(plan, params, kinds[kind].faces), why);
        else
            lsf_plan_omit(plan, name, "%s", kinds[kind].omitted);
    }
    lsf_plan_buffer_add(plan, "shadow_map.light", sizeof(struct lsf_light_data),
                        "the light in turn and its map's projection");
    lsf_light_walls_plan(plan, "shadow_map_walls", params->filter == LSF_SHADOW_FILTER_NONE);
}

void lsf_shadow_map_plan_scene(lsf_plan *plan, const lsf_shadow_map_params *params,
                               const lsf_state *state, uint32_t resolution)
{
    bool needed[LSF_LIGHT_PROJECTION_KINDS];
    needed_kinds(state, needed);
    if (needed[LSF_LIGHT_PROJECTION_WINDOWS])
        plan_map(plan, params, "scene", 1, resolution, "the whole scene, for voxels");
    else
        lsf_plan_omit(plan, "shadow_map.scene", "no directional light");
}

static bool create_target(lsf_shadow_map_target *target, lsf_context *context, const lsf_plan *plan,
                          const char *name, lsf_error *error)
{
    char depth_name[64], gradient_name[64], tint_name[64];
    snprintf(depth_name, sizeof depth_name, "shadow_map.%s_depth", name);
    snprintf(gradient_name, sizeof gradient_name, "shadow_map.%s_gradient", name);
    snprintf(tint_name, sizeof tint_name, "shadow_map.%s_tint", name);
    const lsf_plan_resource *resource = lsf_plan_find(plan, depth_name);
    if (!resource)
        return true;
    target->faces = resource->texture.depth;
    target->resolution = resource->texture.width;
    if (!lsf_plan_create_texture(plan, context, depth_name, &target->depth, error) ||
        !lsf_plan_create_texture_if_planned(plan, context, gradient_name, &target->gradient,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, context, tint_name, &target->tint, error))
        return false;
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_desc desc = {.label = depth_name,
                                     .color_count = 1,
                                     .colors = {target->gradient},
                                     .depth = target->depth,
                                     .layer = (int32_t)face};
        target->framebuffers[face] = lsf_framebuffer_create(context, &desc, error);
        if (!target->framebuffers[face])
            return false;
        desc = (lsf_framebuffer_desc){
            .label = tint_name, .color_count = 1, .colors = {target->tint}, .layer = (int32_t)face};
        if (target->tint &&
            !(target->tint_framebuffers[face] = lsf_framebuffer_create(context, &desc, error)))
            return false;
    }
    return true;
}

bool lsf_shadow_map_create(lsf_shadow_map *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    static const char *const files[5] = {"passes/shadow_map.vert.glsl",
                                         "passes/shadow_map.frag.glsl"};
    *pass =
        (lsf_shadow_map){.context = context, .outputs.shadow.size = sizeof(struct lsf_light_data)};
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        if (!create_target(&pass->targets[kind], context, plan, kinds[kind].name, error))
            return false;
    if (!create_target(&pass->scene, context, plan, "scene", error) ||
        !lsf_plan_create_buffer(plan, context, "shadow_map.light", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &pass->outputs.shadow.light, error))
        return false;
    pass->program = lsf_plan_program(plan, context, "shadow_map", files, error);
    pass->timer = lsf_timer_create(context, "shadow_map", error);
    return pass->program && pass->timer &&
           lsf_light_walls_create(&pass->walls, context, plan, "shadow_map_walls", true, error);
}

static void draw_map(lsf_shadow_map *pass, const lsf_shadow_map_target *target,
                     const lsf_iteration *iteration, uint32_t light_index)
{
    static const GLfloat zero[4] = {0};
    const lsf_light_projection_layout layout = {.faces = target->faces,
                                                .view = target != &pass->scene,
                                                .resolution = target->resolution,
                                                .purpose = LSF_PURPOSE_SHADOW_MAP,
                                                .use = LSF_LIGHT_STRAIGHT};
    struct lsf_light_data *data = &pass->outputs.light;
    lsf_timer_begin(pass->timer);
    lsf_light_projection_project(data, iteration, light_index, &layout);
    glNamedBufferSubData(pass->outputs.shadow.light, 0, sizeof *data, data);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, pass->outputs.shadow.light);
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_draw_region region;
        lsf_light_projection_region(data, face, &region);
        lsf_begin_surfaces(target->resolution, target->resolution, pass->program);
        lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_SHADOW_MAP, light_index);
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[face]);
        glClearNamedFramebufferfv(target->framebuffers[face], GL_DEPTH, 0, zero);
        glUniform1i(0, (GLint)face);
        lsf_scene_gpu_draw(iteration->scene, iteration->state,
                           lsf_light_passage_of(iteration, light_index).stops, &region,
                           pass->counts);
        if (!target->tint)
            continue;
        lsf_light_walls_draw(&pass->walls, iteration, (GLint)face, LSF_PURPOSE_STRAIGHT_SHADOW_MAP,
                             light_index, &region, pass->counts);
        lsf_light_walls_tint(&pass->walls, iteration, target->tint_framebuffers[face],
                             target->resolution, (GLint)face, LSF_PURPOSE_STRAIGHT_SHADOW_MAP,
                             light_index, target->depth, &region, pass->counts);
    }
    pass->outputs.shadow.depth = target->depth;
    pass->outputs.shadow.gradient = target->gradient;
    pass->outputs.shadow.tint = target->tint;
    lsf_timer_end(pass->timer);
}

static const lsf_shadow_map_target *target_of(const lsf_shadow_map *pass,
                                              const lsf_iteration *iteration, uint32_t light_index)
{
    return &pass->targets[lsf_light_projection_kind_of(&iteration->lights[light_index])];
}

void lsf_shadow_map_run(lsf_shadow_map *pass, const lsf_iteration *iteration, uint32_t light_index)
{
    draw_map(pass, target_of(pass, iteration, light_index), iteration, light_index);
}

void lsf_shadow_map_run_scene(lsf_shadow_map *pass, const lsf_iteration *iteration,
                              uint32_t light_index)
{
    bool directional = iteration->lights[light_index].type == LSF_LIGHT_DIRECTIONAL;
    draw_map(pass, directional ? &pass->scene : target_of(pass, iteration, light_index), iteration,
             light_index);
}

static void destroy_target(lsf_context *context, lsf_shadow_map_target *target)
{
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_destroy(context, &target->framebuffers[face]);
        lsf_framebuffer_destroy(context, &target->tint_framebuffers[face]);
    }
    lsf_texture_destroy(context, &target->tint);
    lsf_texture_destroy(context, &target->depth);
    lsf_texture_destroy(context, &target->gradient);
}

void lsf_shadow_map_destroy(lsf_shadow_map *pass)
{
    if (!pass->context)
        return;
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        destroy_target(pass->context, &pass->targets[kind]);
    destroy_target(pass->context, &pass->scene);
    lsf_buffer_destroy(pass->context, &pass->outputs.shadow.light);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
