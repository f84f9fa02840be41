#include "passes/compose.h"

#include <string.h>

#include "shared/scene_data.h"

enum { RADIANCE, SEEN, INDIRECT_DIFFUSE, DIRECT, INDIRECT_SPECULAR, COVERAGE, TEXTURES };

#define AT(member) offsetof(lsf_compose, own.member)

static const lsf_texture_row textures[TEXTURES] = {
    [RADIANCE] = {"compose.radiance", GL_RGBA32F, AT(picture), 0, "the iteration's picture"},
    [SEEN] = {"compose.seen", GL_RGBA32F, AT(emission), 0, "the emission layer is asked for"},
    [INDIRECT_DIFFUSE] = {"compose.indirect_diffuse", GL_RGBA32F, AT(indirect_diffuse), 0,
                          "the indirect_diffuse layer is asked for"},
    [DIRECT] = {"compose.direct", GL_RGBA32F, AT(direct), 0, "the direct layer is asked for"},
    [INDIRECT_SPECULAR] = {"compose.indirect_specular", GL_RGBA32F, AT(indirect_specular), 0,
                           "the indirect_specular layer is asked for, behind what transmits"},
    [COVERAGE] = {"compose.coverage", GL_RGBA32F, AT(coverage), 0, "the background is transparent"},
};

/* Layers beside the picture: attachments are numbered without gaps, and a layer's switch is its
 * number, 0 without it. */
static void plan_layer(lsf_plan *plan, bool wanted, const char *define, int layer, int *target)
{
    const lsf_texture_row *row = &textures[layer];
    lsf_plan_switch_add(plan, define, wanted ? (*target)++ : 0, "%s; its attachment's number",
                        row->why);
    if (wanted)
        lsf_plan_textures_add(plan, row, 1, 0, plan->seen_width, plan->seen_height);
}

void lsf_compose_plan(lsf_plan *plan, const lsf_compose_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_pass_add(plan, "compose", "adds up what is seen itself and what is reflected");
    lsf_plan_reads(plan, "view gbuffer direct_light scene.environment");
    lsf_plan_reads(plan, LSF_PLAN_INDIRECT);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_DIRECT", use->direct,
                        "there are punctual lights, or directions of the environment");
    lsf_plan_switch_add(plan, "LSF_INDIRECT", use->indirect, "light comes by VPLs or bundles");
    lsf_plan_switch_add(plan, "LSF_SKY_LIGHT", plan->sky_split,
                        "light of the environment's directions is filtered");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", (use->indirect || plan->sky_split) && r->specular,
                        "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", 0, "never: lobes were evaluated before");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION",
                        (use->indirect || plan->sky_split) && plan->transmission,
                        "light passes materials that transmit");
    if (use->indirect || plan->sky_split)
        lsf_scene_gpu_scatter_switch(plan);
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", use->split_direct,
                        "direct light is asked for apart");
    lsf_scene_gpu_seen_through_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", lsf_plan_media_absorb(plan),
                        "there are media, which are looked through");
    lsf_scene_gpu_environment_switches(plan, "an environment is seen");
    lsf_plan_switch_add(plan, "LSF_BACKGROUND", !plan->background.environment,
                        "something else is seen instead of the environment");
    lsf_plan_textures_add(plan, &textures[RADIANCE], 1, 0, plan->seen_width, plan->seen_height);
    int target = 1;
    plan_layer(plan, (plan->aovs & LSF_AOV_EMISSION) != 0, "LSF_SEEN", SEEN, &target);
    plan_layer(plan, use->indirect && (plan->aovs & LSF_AOV_INDIRECT_DIFFUSE),
               "LSF_INDIRECT_DIFFUSE", INDIRECT_DIFFUSE, &target);
    plan_layer(plan,
               (use->split_direct || plan->seen_through || plan->sky_split) &&
                   (plan->aovs & LSF_AOV_DIRECT),
               "LSF_ALL_DIRECT", DIRECT, &target);
    plan_layer(plan,
               plan->seen_through && use->indirect && r->specular &&
                   (plan->aovs & LSF_AOV_INDIRECT_SPECULAR),
               "LSF_INDIRECT_SPECULAR", INDIRECT_SPECULAR, &target);
    plan_layer(plan, plan->background.coverage, "LSF_COVERAGE", COVERAGE, &target);
}

bool lsf_compose_create(lsf_compose *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/compose.frag.glsl"};
    *pass = (lsf_compose){.context = context};
    if (!lsf_plan_create_textures(plan, context, textures, TEXTURES, pass, error))
        return false;
    const lsf_composed *own = &pass->own;
    lsf_framebuffer_desc desc = {.label = "compose",
                                 .color_count = 6,
                                 .colors = {own->picture, own->emission, own->indirect_diffuse,
                                            own->direct, own->indirect_specular, own->coverage},
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "compose", files, error);
    pass->timer = lsf_timer_create(context, "compose", error);
    return pass->framebuffer && pass->program && pass->timer;
}

void lsf_compose_run(lsf_compose *pass, const lsf_iteration *iteration,
                     const lsf_light_parts *parts)
{
    const lsf_gbuffer_maps *gbuffer = parts->gbuffer;
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->seen_width,
                         iteration->plan->seen_height, pass->program);
    lsf_bind_texture(0, gbuffer->seen.depth);
    lsf_bind_texture(1, gbuffer->emission);
    lsf_bind_texture(2, parts->direct);
    lsf_bind_texture(3, gbuffer->seen.surface);
    lsf_bind_texture(4, parts->indirect.irradiance);
    lsf_bind_texture(6, parts->indirect.specular);
    lsf_bind_texture(7, parts->split_direct.irradiance);
    lsf_bind_texture(8, parts->split_direct.specular);
    lsf_bind_texture(9, gbuffer->seen.specular_params);
    lsf_bind_texture(10, gbuffer->tint);
    lsf_bind_texture(11, gbuffer->absorption);
    lsf_bind_texture(12, parts->sky.irradiance);
    lsf_bind_texture(13, parts->sky.specular);
    lsf_scene_gpu_bind_environment(iteration->scene);
    glUniform3fv(0, 1, iteration->plan->background.radiance);
    lsf_draw_fullscreen(pass->context);
    pass->outputs = pass->own;
    if (!pass->own.direct)
        pass->outputs.direct = parts->direct;
    if (!pass->own.indirect_specular)
        pass->outputs.indirect_specular = parts->indirect.specular;
    lsf_timer_end(pass->timer);
}

void lsf_compose_destroy(lsf_compose *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_textures_destroy(pass->context, textures, TEXTURES, pass);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
