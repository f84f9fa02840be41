#include "passes/reflective_shadow_map.h"
#include "frame/purpose.h"

#include <stdio.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "shared/scene_data.h"

/* Local size of the rows' shader: one invocation a row. */
#define GROUP_SIZE 64

/* Storage buffers of the shaders that sum importance. */
#define BINDING_SUMS 1
#define BINDING_LIGHT 2

const lsf_option_row lsf_reflective_shadow_map_options[LSF_REFLECTIVE_SHADOW_MAP_OPTION_COUNT] = {
    {"rsm.resolution", LSF_OPTION_INT, offsetof(lsf_reflective_shadow_map_params, resolution), 0,
     4096, NULL, "texels",
     "width and height of each face of a reflective shadow map, from which VPLs are drawn; 0: 256, "
     "and for a point light's six faces 64 to 256, more for more iterations"},
    {"rsm.pdf", LSF_OPTION_ENUM, offsetof(lsf_reflective_shadow_map_params, pdf), 0, 0,
     "auto|uniform|adaptive", "",
     "how VPLs are drawn; uniform: by the light's own distribution; adaptive: by the light that "
     "they reflect to visible points; auto: adaptive for directional lights if VPLs are few, else "
     "uniform"},
};

static const struct {
    const char *name;
    uint32_t faces;
    const char *omitted;
} kinds[LSF_LIGHT_PROJECTION_KINDS] = {
    {"cube", 6, "no point light and no wide spot"},
    {"spot", 1, "no narrow spot"},
    {"window", 1, "no directional light"},
};

/* The layers of a map. */
enum { GRADIENT, SURFACE, SPECULAR_PARAMS, IMPORTANCE, TINT, DEPTH, LAYERS };

static const struct {
    const char *name;
    GLenum format;
    const char *why;
} layers[LAYERS] = {
    [GRADIENT] = {"gradient", GL_RG16F, "the plane of each texel's surface"},
    [SURFACE] = {"surface", GL_RGBA32UI, "normals, base colour, metallic"},
    [SPECULAR_PARAMS] = {"specular_params", GL_R32UI, "roughness and f0"},
    [IMPORTANCE] = {"importance", GL_R32F, "the flux that each texel reflects to what is seen"},
    [TINT] = {"tint", GL_RGB10_A2, "light passes thin walls"},
    [DEPTH] = {"depth", GL_DEPTH_COMPONENT32F, "distances, for shadows (rsm.resolution)"},
};

static void name_layer(char name[64], int kind, int layer)
{
    snprintf(name, 64, "reflective_shadow_map.%s_%s", kinds[kind].name, layers[layer].name);
}

/* Densities that follow what a texel shows would, with surfaces that are there by chance, go along
 * with which of them is: the shares of both ways to find a path would no longer add up to one. */
static bool is_adaptive(const lsf_plan *plan, const lsf_reflective_shadow_map_params *params,
                        int kind)
{
    return !plan->requirements.blended && !lsf_light_walls_needed(plan) &&
           (params->pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_ADAPTIVE ||
            (params->pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_AUTO &&
             kind == LSF_LIGHT_PROJECTION_WINDOWS));
}

static uint32_t side_of(const lsf_reflective_shadow_map_params *params, int kind)
{
    if (params->resolution > 0)
        return (uint32_t)params->resolution;
    return kinds[kind].faces > 1 ? (uint32_t)params->cube_resolution
                                 : LSF_REFLECTIVE_SHADOW_MAP_RESOLUTION;
}

static void plan_map(lsf_plan *plan, int kind, const lsf_reflective_shadow_map_params *params,
                     bool specular_params)
{
    uint32_t side = side_of(params, kind);
    const bool present[LAYERS] = {
        [GRADIENT] = true,
        [SURFACE] = true,
        [SPECULAR_PARAMS] = specular_params,
        [IMPORTANCE] = is_adaptive(plan, params, kind),
        [TINT] = lsf_light_walls_needed(plan),
        [DEPTH] = true,
    };
    for (int layer = 0; layer < LAYERS; layer++) {
        if (!present[layer])
            continue;
        char name[64];
        name_layer(name, kind, layer);
        lsf_texture_desc desc = {
            NULL, GL_TEXTURE_2D_ARRAY, layers[layer].format, side, side, kinds[kind].faces, 1};
        if (layer == SPECULAR_PARAMS && plan->requirements.anisotropic)
            desc.internal_format = GL_RG32UI;
        if (layer == SPECULAR_PARAMS && plan->transmission)
            desc.internal_format = GL_RGBA32UI;
        if (layer == TINT)
            desc.internal_format = lsf_light_tint_format(plan);
        lsf_plan_texture_desc_add(plan, name, &desc, "%s", layers[layer].why);
    }
}

static void plan_pdf(lsf_plan *plan, uint64_t sums)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_pass_add(plan, "reflective_shadow_map_pdf", "where VPLs light what is seen (rsm.pdf)");
    lsf_light_switches(plan);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_buffer_add(plan, "reflective_shadow_map.sums", sums * sizeof(float),
                        "running sums of importance");
}

static const char *why_uniform(const lsf_plan *plan, const lsf_reflective_shadow_map_params *params)
{
    if (params->pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM)
        return "VPLs are many or none, or rsm.pdf is uniform";
    if (plan->requirements.blended || lsf_light_walls_needed(plan))
        return "some material is blended, or transmits: VPLs are drawn uniformly";
    return "rsm.pdf is auto, and no light is directional";
}

void lsf_reflective_shadow_map_plan(lsf_plan *plan, const lsf_reflective_shadow_map_params *params,
                                    const lsf_state *state,
                                    const lsf_reflective_shadow_map_use *use)
{
    lsf_reflective_shadow_map_params chosen = *params;
    if (chosen.pdf == LSF_REFLECTIVE_SHADOW_MAP_PDF_AUTO && !use->few_vpls)
        chosen.pdf = LSF_REFLECTIVE_SHADOW_MAP_PDF_UNIFORM;
    params = &chosen;
    bool needed[LSF_LIGHT_PROJECTION_KINDS];
    lsf_light_projection_kinds(plan, state, needed);
    if (use->sky)
        needed[LSF_LIGHT_PROJECTION_WINDOWS] = true;
    bool specular_params = lsf_plan_surfaces_differ(plan);
    uint64_t most_sums = 0;
    lsf_plan_pass_add(plan, "reflective_shadow_map",
                      "the surfaces that %u punctual light%s%s light", state->light_count,
                      lsf_plural(state->light_count),
                      use->sky ? " and directions of the environment" : "");
    lsf_plan_reads(plan, "scene");
    lsf_scene_gpu_material_switches(plan, specular_params, false);
    lsf_scene_gpu_fold_lobes(plan);
    lsf_plan_switch_add(plan, "LSF_THIN_WALLS", lsf_light_walls_needed(plan),
                        "light passes thin walls");
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++) {
        char name[64];
        snprintf(name, sizeof name, "reflective_shadow_map.%s", kinds[kind].name);
        if (!needed[kind]) {
            lsf_plan_omit(plan, name, "%s", kinds[kind].omitted);
            continue;
        }
        plan_map(plan, kind, params, specular_params);
        uint64_t side = side_of(params, kind), sums = kinds[kind].faces * side * (side + 1);
        if (is_adaptive(plan, params, kind) && sums > most_sums)
            most_sums = sums;
    }
    lsf_plan_buffer_add(plan, "reflective_shadow_map.light", sizeof(struct lsf_light_data),
                        "the light in turn and its map's projection");
    lsf_light_walls_plan(plan, "reflective_shadow_map_walls", false);
    if (most_sums > 0)
        plan_pdf(plan, most_sums);
    else
        lsf_plan_omit(plan, "reflective_shadow_map_pdf", "%s", why_uniform(plan, params));
}

static bool create_target(lsf_reflective_shadow_map_target *target, lsf_context *context,
                          const lsf_plan *plan, int kind, lsf_error *error)
{
    GLuint *const textures[LAYERS] = {[GRADIENT] = &target->gradient,
                                      [SURFACE] = &target->surface,
                                      [SPECULAR_PARAMS] = &target->specular_params,
                                      [IMPORTANCE] = &target->importance,
                                      [TINT] = &target->tint,
                                      [DEPTH] = &target->depth};
    char name[64];
    for (int layer = 0; layer < LAYERS; layer++) {
        name_layer(name, kind, layer);
        if (!lsf_plan_create_texture_if_planned(plan, context, name, textures[layer], error))
            return false;
    }
    const lsf_plan_resource *resource = lsf_plan_find(plan, name);
    if (!resource)
        return true;
    target->faces = resource->texture.depth;
    target->resolution = resource->texture.width;
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_desc desc = {
            .label = name,
            .color_count = 3,
            .colors = {target->gradient, target->surface, target->specular_params},
            .depth = target->depth,
            .layer = (int32_t)face};
        target->framebuffers[face] = lsf_framebuffer_create(context, &desc, error);
        if (!target->framebuffers[face])
            return false;
        desc = (lsf_framebuffer_desc){.label = "reflective_shadow_map.tint",
                                      .color_count = 1,
                                      .colors = {target->tint},
                                      .layer = (int32_t)face};
        if (target->tint &&
            !(target->tint_framebuffers[face] = lsf_framebuffer_create(context, &desc, error)))
            return false;
    }
    return true;
}

static bool create_pdf(lsf_reflective_shadow_map *pass, lsf_context *context, const lsf_plan *plan,
                       lsf_error *error)
{
    static const char *const rows_files[5] = {"passes/reflective_shadow_map_rows.comp.glsl"};
    static const char *const scan_files[5] = {"passes/reflective_shadow_map_scan.comp.glsl"};
    const char *name = "reflective_shadow_map_pdf";
    if (!lsf_plan_find_pass(plan, name))
        return true;
    if (!lsf_plan_create_buffer(plan, context, "reflective_shadow_map.sums", NULL, 0,
                                &pass->outputs.sums, error))
        return false;
    pass->rows_program = lsf_plan_program(plan, context, name, rows_files, error);
    pass->scan_program = lsf_plan_program(plan, context, name, scan_files, error);
    pass->pdf_timer = lsf_timer_create(context, name, error);
    return pass->rows_program && pass->scan_program && pass->pdf_timer;
}

bool lsf_reflective_shadow_map_create(lsf_reflective_shadow_map *pass, lsf_context *context,
                                      const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/reflective_shadow_map.vert.glsl",
                                         "passes/reflective_shadow_map.frag.glsl"};
    *pass = (lsf_reflective_shadow_map){.context = context,
                                        .outputs.shadow.size = sizeof(struct lsf_light_data)};
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        if (!create_target(&pass->targets[kind], context, plan, kind, error))
            return false;
    if (!lsf_plan_create_buffer(plan, context, "reflective_shadow_map.light", NULL,
                                GL_DYNAMIC_STORAGE_BIT, &pass->outputs.shadow.light, error))
        return false;
    pass->program = lsf_plan_program(plan, context, "reflective_shadow_map", files, error);
    pass->timer = lsf_timer_create(context, "reflective_shadow_map", error);
    return pass->program && pass->timer && create_pdf(pass, context, plan, error) &&
           lsf_light_walls_create(&pass->walls, context, plan, "reflective_shadow_map_walls", false,
                                  error);
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

/* Sums importance over the map. */
static void run_pdf(lsf_reflective_shadow_map *pass, const lsf_iteration *iteration,
                    const lsf_reflective_shadow_map_target *target, const lsf_surface_maps *viewed)
{
    const lsf_reflective_shadow_map_outputs *out = &pass->outputs;
    lsf_timer_begin(pass->pdf_timer);
    lsf_bind_texture(0, target->depth);
    lsf_bind_texture(1, target->surface);
    lsf_bind_texture(2, viewed ? viewed->depth : 0);
    lsf_bind_texture(3, viewed ? viewed->surface : 0);
    glBindImageTexture(0, target->importance, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_SUMS, out->sums);
    glUseProgram(pass->rows_program);
    glUniform2ui(0, viewed != NULL, lsf_iteration_seed(iteration, LSF_PURPOSE_VPL_VIEW));
    glDispatchCompute((target->faces * target->resolution + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_LIGHT, out->shadow.light);
    glUseProgram(pass->scan_program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    lsf_timer_end(pass->pdf_timer);
}

void lsf_reflective_shadow_map_run(lsf_reflective_shadow_map *pass, const lsf_iteration *iteration,
                                   uint32_t light_index, const lsf_surface_maps *viewed)
{
    static const GLfloat zero[4] = {0};
    const lsf_light_state *light = &iteration->lights[light_index];
    const lsf_reflective_shadow_map_target *target =
        &pass->targets[lsf_light_projection_kind_of(light)];
    const lsf_light_projection_layout layout = {.faces = target->faces,
                                                .resolution = target->resolution,
                                                .purpose = LSF_PURPOSE_REFLECTIVE_SHADOW_MAP,
                                                .use = LSF_LIGHT_BOUNCED};
    lsf_reflective_shadow_map_outputs *out = &pass->outputs;
    lsf_timer_begin(pass->timer);
    lsf_light_projection_project(&out->light, iteration, light_index, &layout);
    glNamedBufferSubData(out->shadow.light, 0, sizeof out->light, &out->light);
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, out->shadow.light);
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_draw_region region;
        lsf_light_projection_region(&out->light, face, &region);
        lsf_begin_surfaces(target->resolution, target->resolution, pass->program);
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffers[face]);
        /* Colours of texels without depth are never read. */
        glClearNamedFramebufferfv(target->framebuffers[face], GL_DEPTH, 0, zero);
        glFrontFace(front_winding(&out->light, face));
        glUniform1i(0, (GLint)face);
        if (target->tint || iteration->plan->requirements.blended)
            lsf_iteration_set_chance(iteration, LSF_PURPOSE_STRAIGHT_REFLECTIVE_SHADOW_MAP,
                                     light_index);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_SHADING, &region,
                           pass->counts);
        if (target->tint)
            lsf_light_walls_tint(&pass->walls, iteration, target->tint_framebuffers[face],
                                 target->resolution, (GLint)face,
                                 LSF_PURPOSE_STRAIGHT_REFLECTIVE_SHADOW_MAP, light_index,
                                 target->depth, &region, pass->counts);
    }
    out->shadow.depth = target->depth;
    out->shadow.gradient = target->gradient;
    out->shadow.tint = target->tint;
    out->seen = (lsf_surface_maps){.depth = target->depth,
                                   .surface = target->surface,
                                   .specular_params = target->specular_params};
    out->importance = target->importance;
    lsf_timer_end(pass->timer);
    if (target->importance)
        run_pdf(pass, iteration, target, viewed);
}

static void destroy_target(lsf_context *context, lsf_reflective_shadow_map_target *target)
{
    for (uint32_t face = 0; face < target->faces; face++) {
        lsf_framebuffer_destroy(context, &target->framebuffers[face]);
        lsf_framebuffer_destroy(context, &target->tint_framebuffers[face]);
    }
    lsf_texture_destroy(context, &target->tint);
    lsf_texture_destroy(context, &target->depth);
    lsf_texture_destroy(context, &target->gradient);
    lsf_texture_destroy(context, &target->surface);
    lsf_texture_destroy(context, &target->specular_params);
    lsf_texture_destroy(context, &target->importance);
}

void lsf_reflective_shadow_map_destroy(lsf_reflective_shadow_map *pass)
{
    if (!pass->context)
        return;
    for (int kind = 0; kind < LSF_LIGHT_PROJECTION_KINDS; kind++)
        destroy_target(pass->context, &pass->targets[kind]);
    lsf_buffer_destroy(pass->context, &pass->outputs.shadow.light);
    lsf_buffer_destroy(pass->context, &pass->outputs.sums);
    lsf_timer_destroy(pass->timer);
    lsf_timer_destroy(pass->pdf_timer);
    memset(pass, 0, sizeof *pass);
}
