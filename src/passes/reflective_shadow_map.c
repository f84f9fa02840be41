#include "passes/reflective_shadow_map.h"

#include <stdio.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "shared/scene_data.h"

/* Of its random numbers: past those of shadow maps. */
#define FIRST_PURPOSE 0x20000

const lsf_option_row lsf_reflective_shadow_map_options[LSF_REFLECTIVE_SHADOW_MAP_OPTION_COUNT] = {
    {"rsm.resolution", LSF_OPTION_INT, offsetof(lsf_reflective_shadow_map_params, resolution), 16,
     4096, NULL, "texels", "side of each face of the maps that VPLs are drawn from"},
    {"rsm.pdf", LSF_OPTION_ENUM, offsetof(lsf_reflective_shadow_map_params, pdf), 0, 0,
     "uniform|adaptive", "", "VPLs are drawn as the light shines, or as surfaces reflect it"},
};

static const struct {
    const char *name;
    uint32_t faces;
    const char *omitted;
} kinds[LSF_LIGHT_MAP_KINDS] = {
    {"cube", 6, "no point light and no wide spot"},
    {"spot", 1, "no narrow spot"},
    {"window", 1, "no directional light"},
};

/* The layers of a map and how they are attached: colours in this order, then depth. */
enum { GRADIENT, SURFACE, GLOSS, DEPTH, LAYERS };

static const struct {
    const char *name;
    GLenum format;
    const char *why;
} layers[LAYERS] = {
    [GRADIENT] = {"gradient", GL_RG16F, "the plane of each texel's surface"},
    [SURFACE] = {"surface", GL_RGBA32UI, "normals, base colour, metallic"},
    [GLOSS] = {"gloss", GL_R32UI, "roughness and f0"},
    [DEPTH] = {"depth", GL_DEPTH_COMPONENT32F, "rsm.resolution texels a side"},
};

static void name_layer(char name[64], int kind, int layer)
{
    snprintf(name, 64, "reflective_shadow_map.%s_%s", kinds[kind].name, layers[layer].name);
}

static void plan_map(lsf_plan *plan, int kind, uint32_t side, bool gloss)
{
    for (int layer = 0; layer < LAYERS; layer++) {
        if (layer == GLOSS && !gloss)
            continue;
        char name[64];
        name_layer(name, kind, layer);
        lsf_texture_desc desc = {
            NULL, GL_TEXTURE_2D_ARRAY, layers[layer].format, side, side, kinds[kind].faces, 1};
        if (layer == GLOSS && plan->requirements.anisotropic)
            desc.internal_format = GL_RG32UI;
        lsf_plan_texture_desc_add(plan, name, &desc, "%s", layers[layer].why);
    }
}

void lsf_reflective_shadow_map_plan(lsf_plan *plan, const lsf_reflective_shadow_map_params *params,
                                    const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    bool needed[LSF_LIGHT_MAP_KINDS] = {false};
    for (uint32_t i = 0; i < state->light_count; i++)
        needed[lsf_light_map_kind_of(&state->lights[i])] = true;
    bool gloss = r->specular && (r->anisotropic || r->glossy || r->variable_ior);
    lsf_plan_pass_add(plan, "reflective_shadow_map", "the surfaces that %u punctual light%s light",
                      state->light_count, state->light_count == 1 ? "" : "s");
    lsf_scene_gpu_material_switches(plan, gloss, false);
    for (int kind = 0; kind < LSF_LIGHT_MAP_KINDS; kind++) {
        char name[64];
        snprintf(name, sizeof name, "reflective_shadow_map.%s", kinds[kind].name);
        if (needed[kind])
            plan_map(plan, kind, (uint32_t)params->resolution, gloss);
        else
            lsf_plan_omit(plan, name, "%s", kinds[kind].omitted);
    }
    lsf_plan_buffer_add(plan, "reflective_shadow_map.light", sizeof(struct lsf_light_data),
                        "the light in turn and its map's projection");
}

static bool create_target(lsf_reflective_shadow_map_target *target, lsf_context *context,
                          const lsf_plan *plan, int kind, lsf_error *error)
{
    GLuint *const textures[LAYERS] = {[GRADIENT] = &target->gradient,
                                      [SURFACE] = &target->surface,
                                      [GLOSS] = &target->gloss,
                                      [DEPTH] = &target->depth};
    char name[64];
    for (int layer = 0; layer < LAYERS; layer++) {
        name_layer(name, kind, layer);
        if (!lsf_plan_create_texture(plan, context, name, textures[layer], error))
            return false;
    }
    const lsf_plan_resource *resource = lsf_plan_find(plan, name);
    if (!resource)
        return true;
    target->faces = resource->texture.depth;
    target->resolution = resource->texture.width;
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_desc desc = {.label = name,
                                     .color_count = target->gloss ? 3 : 2,
                                     .colors = {target->gradient, target->surface, target->gloss},
                                     .depth = target->depth,
                                     .layer = (int32_t)face};
        target->framebuffers[face] = lsf_framebuffer_create(context, &desc, error);
        if (!target->framebuffers[face])
            return false;
    }
    return true;
}

bool lsf_reflective_shadow_map_create(lsf_reflective_shadow_map *pass, lsf_context *context,
                                      const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/reflective_shadow_map.vert.glsl",
                                         "passes/reflective_shadow_map.frag.glsl"};
    *pass = (lsf_reflective_shadow_map){.context = context};
    for (int kind = 0; kind < LSF_LIGHT_MAP_KINDS; kind++)
        if (!create_target(&pass->targets[kind], context, plan, kind, error))
            return false;
    if (!lsf_plan_create_buffer(plan, context, "reflective_shadow_map.light", NULL,
                                GL_DYNAMIC_STORAGE_BIT, &pass->outputs.light_buffer, error))
        return false;
    pass->program = lsf_plan_program(plan, context, "reflective_shadow_map", files, error);
    pass->timer = lsf_timer_create(context, "reflective_shadow_map", error);
    return pass->program && pass->timer;
}

/* Materials ask which side of a triangle is seen; on a face whose axes are mirrored, windings are
 * too. */
static GLenum front_winding(const struct lsf_light_data *light, uint32_t face)
{
    lsf_float3 right = lsf_f3_load(&light->map_right[face].x);
    lsf_float3 up = lsf_f3_load(&light->map_up[face].x);
    lsf_float3 forward = lsf_f3_load(&light->map_forward[face].x);
    return lsf_f3_dot(lsf_f3_cross(right, up), forward) > 0.0f ? GL_CW : GL_CCW;
}

void lsf_reflective_shadow_map_run(lsf_reflective_shadow_map *pass, const lsf_iteration *iteration,
                                   uint32_t light_index)
{
    static const GLfloat zero[4] = {0};
    const lsf_light_state *light = &iteration->state->lights[light_index];
    const lsf_reflective_shadow_map_target *target = &pass->targets[lsf_light_map_kind_of(light)];
    const lsf_light_map_layout layout = {target->faces, target->resolution, FIRST_PURPOSE};
    lsf_reflective_shadow_map_outputs *out = &pass->outputs;
    lsf_timer_begin(pass->timer);
    lsf_light_map_project(&out->light, iteration, light_index, &layout);
    glNamedBufferSubData(out->light_buffer, 0, sizeof out->light, &out->light);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, out->light_buffer);
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
        lsf_light_map_region(&out->light, face, &region);
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[face]);
        /* Colours of texels without depth are never read. */
        glClearNamedFramebufferfv(target->framebuffers[face], GL_DEPTH, 0, zero);
        glFrontFace(front_winding(&out->light, face));
        glUniform1i(0, (GLint)face);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_SHADING, &region,
                           pass->counts);
    }
    glFrontFace(GL_CCW);
    out->depth = target->depth;
    out->gradient = target->gradient;
    out->surface = target->surface;
    out->gloss = target->gloss;
    lsf_timer_end(pass->timer);
}

static void destroy_target(lsf_context *context, lsf_reflective_shadow_map_target *target)
{
    for (uint32_t face = 0; face < target->faces; face++)
        lsf_framebuffer_destroy(context, &target->framebuffers[face]);
    lsf_texture_destroy(context, &target->depth);
    lsf_texture_destroy(context, &target->gradient);
    lsf_texture_destroy(context, &target->surface);
    lsf_texture_destroy(context, &target->gloss);
}

void lsf_reflective_shadow_map_destroy(lsf_reflective_shadow_map *pass)
{
    if (!pass->context)
        return;
    for (int kind = 0; kind < LSF_LIGHT_MAP_KINDS; kind++)
        destroy_target(pass->context, &pass->targets[kind]);
    lsf_buffer_destroy(pass->context, &pass->outputs.light_buffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
