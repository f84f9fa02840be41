#include "passes/gbuffer.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "frame/texture_upload.h"
#include "shared/scene_data.h"

const lsf_option_row lsf_gbuffer_options[LSF_GBUFFER_OPTION_COUNT] = {
    {"gbuffer.texture_lod_bias", LSF_OPTION_FLOAT, offsetof(lsf_gbuffer_params, texture_lod_bias),
     -16.0, 16.0, NULL, "levels",
     "added to the mipmap level of color textures; below 0 sharper and noisier, above 0 blurrier"},
    {"gbuffer.frame_time", LSF_OPTION_FLOAT, offsetof(lsf_gbuffer_params, frame_time), 0.0, 1e6,
     NULL, "s", "time between a frame and the one before it, for motion vectors"},
    {"gbuffer.side", LSF_OPTION_ENUM, offsetof(lsf_gbuffer_params, side), 0, 0, "auto|1|2|4",
     "points",
     "points sampled along each side of a pixel in an iteration: all get direct light, one of "
     "them indirect light; auto: 1, or more under an environment while its shadow maps draw twice "
     "as many triangles as there are points; 2 or more in pictures of up to 1048576 pixels for up "
     "to 2 iterations, and with cone, substitute_tree or voxel_path for up to 8 and with a time "
     "limit"},
};

static void plan_switches(lsf_plan *plan)
{
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    bool emission = lsf_plan_surfaces_shine(plan);
    bool motion = lsf_plan_find(plan, "gbuffer.motion") != NULL;
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_scene_gpu_material_switches(plan, specular_params, emission);
    lsf_plan_switch_add(plan, "LSF_MOTION", motion, "motion is asked for");
    if (plan->temporal)
        lsf_plan_switch_add(plan, "LSF_HISTORY", true, "light is kept from frame to frame");
    if (lsf_plan_find(plan, "scene.previous_positions"))
        lsf_plan_switch_add(plan, "LSF_DEFORMED_MOTION", true, "vertices are deformed");
    /* Colour attachments are numbered without gaps. */
    int target = 1;
    if (specular_params)
        lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS_TARGET", target++,
                            "its colour attachment is numbered");
    if (emission)
        lsf_plan_switch_add(plan, "LSF_EMISSION_TARGET", target++,
                            "its colour attachment is numbered");
    if (motion)
        lsf_plan_switch_add(plan, "LSF_MOTION_TARGET", target++,
                            "its colour attachment is numbered");
    lsf_scene_gpu_seen_through_switch(plan);
    if (plan->seen_through) {
        lsf_plan_switch_add(plan, "LSF_TINT_TARGET", target++, "its colour attachment is numbered");
        lsf_plan_switch_add(plan, "LSF_ABSORPTION", lsf_plan_media_absorb(plan),
                            "there are media, which are looked through");
        lsf_plan_switch_add(plan, "LSF_REFRACTED", plan->refracted || !plan->straight,
                            "refracted paths show what is behind media");
    }
}

/* The light that is absorbed and emitted between the visible surface and the eye. */
static void plan_transmittance(lsf_plan *plan)
{
    uint32_t w = plan->seen_width, h = plan->seen_height;
    if (!plan->seen_through)
        return;
    lsf_plan_texture_add(plan, "gbuffer.tint", GL_RGBA16F, w, h,
                         "light comes through materials that transmit");
    if (lsf_plan_media_absorb(plan))
        lsf_plan_texture_add(plan, "gbuffer.absorption", GL_RGBA32F, w, h,
                             "optical depth of media");
}

void lsf_gbuffer_plan(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    uint32_t w = plan->seen_width, h = plan->seen_height;
    lsf_plan_pass_add(plan, "gbuffer", "what each pixel sees");
    lsf_plan_reads(plan, "view scene");
    lsf_plan_texture_add(plan, "gbuffer.depth", GL_DEPTH_COMPONENT32F, w, h,
                         "reverse-Z; positions are made from it");
    lsf_plan_texture_add(plan, "gbuffer.surface", GL_RGBA32UI, w, h,
                         "normals, base colour, metallic");
    if (plan->transmission || (r->specular && (r->specular_varied || r->coated || r->sheened)))
        lsf_plan_texture_add(plan, "gbuffer.specular_params", GL_RGBA32UI, w, h,
                             "roughness, f0, anisotropy, transmission, tint of f0, coat, sheen");
    else if (r->specular && r->anisotropic)
        lsf_plan_texture_add(plan, "gbuffer.specular_params", GL_RG32UI, w, h,
                             "roughness, f0 and anisotropy");
    else if (r->specular && (r->glossy || r->variable_ior))
        lsf_plan_texture_add(plan, "gbuffer.specular_params", GL_R32UI, w, h, "roughness and f0");
    else
        lsf_plan_omit(plan, "gbuffer.specular_params",
                      r->specular ? "every material has roughness 1, metallic 0 and ior 1.5"
                                  : "diffuse only");
    if (lsf_plan_surfaces_shine(plan))
        lsf_plan_texture_add(plan, "gbuffer.emission", GL_RGBA32F, w, h, "%s",
                             r->emissive ? "some material emits" : "some material is unlit");
    else
        lsf_plan_omit(plan, "gbuffer.emission", "nothing emits");
    if (plan->temporal)
        lsf_plan_texture_add(plan, "gbuffer.motion", GL_RGBA32F, w, h,
                             "where light of the frame before is, how deep, of which instance");
    else if (lsf_plan_measures_motion(plan))
        lsf_plan_texture_add(plan, "gbuffer.motion", GL_RG32F, w, h, "motion is asked for");
    else
        lsf_plan_omit(plan, "gbuffer.motion", "nothing reads it");
    plan_transmittance(plan);
    if (plan->refracted) {
        lsf_plan_texture_add(plan, "gbuffer.far_side", GL_DEPTH_COMPONENT32F, w, h,
                             "refracted paths pass thin walls of media");
        lsf_plan_texture_add(plan, "gbuffer.far_color", GL_RGBA16F, w, h,
                             "base colour and transmission of their far sides");
    }
    plan_switches(plan);
}

static bool create_transmittance(lsf_gbuffer *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/gbuffer.vert.glsl",
                                         "passes/gbuffer_tint.frag.glsl"};
    lsf_gbuffer_maps *out = &pass->outputs;
    if (!lsf_plan_create_texture_if_planned(plan, pass->context, "gbuffer.tint", &out->tint,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, pass->context, "gbuffer.absorption",
                                            &out->absorption, error))
        return false;
    if (!out->tint)
        return true;
    lsf_framebuffer_desc desc = {.label = "gbuffer.tint",
                                 .color_count = 2,
                                 .colors = {out->tint, out->absorption},
                                 .layer = -1};
    pass->tint_framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    pass->tint_program = lsf_plan_program(plan, pass->context, "gbuffer", files, error);
    return pass->tint_framebuffer && pass->tint_program;
}

static bool create_far_side(lsf_gbuffer *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"passes/gbuffer.vert.glsl",
                                         "passes/gbuffer_far_side.frag.glsl"};
    lsf_gbuffer_maps *out = &pass->outputs;
    if (!lsf_plan_create_texture_if_planned(plan, pass->context, "gbuffer.far_side", &out->far_side,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, pass->context, "gbuffer.far_color",
                                            &out->far_color, error))
        return false;
    if (!out->far_side)
        return true;
    lsf_framebuffer_desc desc = {.label = "gbuffer.far_side",
                                 .color_count = 1,
                                 .colors = {out->far_color},
                                 .depth = out->far_side,
                                 .layer = -1};
    pass->far_framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    pass->far_program = lsf_plan_program(plan, pass->context, "gbuffer", files, error);
    return pass->far_framebuffer && pass->far_program;
}

bool lsf_gbuffer_create(lsf_gbuffer *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_gbuffer_params *params, const lsf_scene_gpu *scene,
                        lsf_error *error)
{
    static const char *const files[5] = {"passes/gbuffer.vert.glsl", "passes/gbuffer.frag.glsl"};
    lsf_gbuffer_maps *out = &pass->outputs;
    *pass = (lsf_gbuffer){.context = context};
    if (!lsf_plan_create_texture(plan, context, "gbuffer.depth", &out->seen.depth, error) ||
        !lsf_plan_create_texture(plan, context, "gbuffer.surface", &out->seen.surface, error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "gbuffer.specular_params",
                                            &out->seen.specular_params, error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "gbuffer.emission", &out->emission,
                                            error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "gbuffer.motion", &out->motion, error) ||
        !create_transmittance(pass, plan, error) || !create_far_side(pass, plan, error))
        return false;
    lsf_framebuffer_desc desc = {.label = "gbuffer",
                                 .color_count = 5,
                                 .colors = {out->seen.surface, out->seen.specular_params,
                                            out->emission, out->motion, out->tint},
                                 .depth = out->seen.depth,
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "gbuffer", files, error);
    pass->timer = lsf_timer_create(context, "gbuffer", error);
    /* N iterations sample a pixel N times: the footprint of one sample is sqrt(N) narrower, which
     * is log2(sqrt(N)) levels of the mipmap pyramid. The mean then converges to the unfiltered
     * texture under the pixel's box, as ground truth has it. */
    float bias = params->texture_lod_bias - 0.5f * log2f((float)plan->samples);
    lsf_texture_upload_set_lod_bias(scene, fmaxf(bias, -16.0f));
    return pass->framebuffer && pass->program && pass->timer;
}

static void set_lobe_angle(const lsf_gbuffer *pass, const lsf_iteration *iteration)
{
    if (pass->outputs.tint && iteration->plan->scattered)
        glUniform1f(LSF_LOCATION_LOBE_ANGLE, pass->lobe_angle);
}

/* Surfaces that transmit or are blended are hit by chance: alike in both programs. */
static void set_chance(const lsf_gbuffer *pass, const lsf_iteration *iteration)
{
    if (pass->outputs.tint || iteration->plan->requirements.blended)
        lsf_iteration_set_chance(iteration, LSF_PURPOSE_STRAIGHT_PIXEL, 0);
    set_lobe_angle(pass, iteration);
}

/* Draws transmitting surfaces once more: all that lie before the visible surface let light pass. */
static void tint(lsf_gbuffer *pass, const lsf_iteration *iteration, const lsf_draw_region *region)
{
    static const GLfloat zero[4] = {0};
    glBindFramebuffer(GL_FRAMEBUFFER, pass->tint_framebuffer);
    lsf_begin_surfaces(iteration->plan->seen_width, iteration->plan->seen_height,
                       pass->tint_program);
    lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_PIXEL, 0);
    set_lobe_angle(pass, iteration);
    glDisable(GL_DEPTH_TEST);
    if (pass->outputs.absorption)
        glClearNamedFramebufferfv(pass->tint_framebuffer, GL_COLOR, 1, zero);
    lsf_blend_add(pass->outputs.absorption ? 2 : 1);
    glBlendFunci(0, GL_ZERO, GL_SRC_COLOR);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, pass->outputs.seen.depth);
    lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_TRANSMISSIVE, region,
                       pass->counts);
}

/* Draws media once more: backs behind the visible surface that are parallel to it. */
static void find_far_side(lsf_gbuffer *pass, const lsf_iteration *iteration,
                          const lsf_draw_region *region)
{
    static const GLfloat zero[4] = {0};
    glBindFramebuffer(GL_FRAMEBUFFER, pass->far_framebuffer);
    lsf_begin_surfaces(iteration->plan->seen_width, iteration->plan->seen_height,
                       pass->far_program);
    glClearNamedFramebufferfv(pass->far_framebuffer, GL_DEPTH, 0, zero);
    lsf_iteration_set_blend_chance(iteration, LSF_PURPOSE_STRAIGHT_PIXEL, 0);
    lsf_bind_texture(LSF_UNIT_SEEN_DEPTH, pass->outputs.seen.depth);
    lsf_bind_texture(LSF_UNIT_SEEN_SURFACE, pass->outputs.seen.surface);
    lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_TRANSMISSIVE, region,
                       pass->counts);
}

void lsf_gbuffer_run(lsf_gbuffer *pass, const lsf_iteration *iteration)
{
    static const GLuint zero_uint[4] = {0};
    static const GLfloat zero[4] = {0}, one[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    lsf_timer_begin(pass->timer);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->framebuffer);
    lsf_begin_surfaces(iteration->plan->seen_width, iteration->plan->seen_height, pass->program);
    GLint at = 0;
    glClearNamedFramebufferfv(pass->framebuffer, GL_DEPTH, 0, zero);
    glClearNamedFramebufferuiv(pass->framebuffer, GL_COLOR, at++, zero_uint);
    if (pass->outputs.seen.specular_params)
        glClearNamedFramebufferuiv(pass->framebuffer, GL_COLOR, at++, zero_uint);
    if (pass->outputs.emission)
        glClearNamedFramebufferfv(pass->framebuffer, GL_COLOR, at++, zero);
    if (pass->outputs.motion)
        glClearNamedFramebufferfv(pass->framebuffer, GL_COLOR, at++, zero);
    if (pass->outputs.tint)
        glClearNamedFramebufferfv(pass->framebuffer, GL_COLOR, at++, one);
    set_chance(pass, iteration);
    lsf_draw_region region;
    lsf_iteration_region(iteration, &region);
    lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_SEEN, &region, pass->counts);
    glDisable(GL_CULL_FACE);
    if (pass->outputs.tint)
        tint(pass, iteration, &region);
    if (pass->outputs.far_side)
        find_far_side(pass, iteration, &region);
    lsf_timer_end(pass->timer);
}

void lsf_gbuffer_destroy(lsf_gbuffer *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->tint_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->far_framebuffer);
    GLuint *textures[] = {
        &pass->outputs.seen.depth, &pass->outputs.seen.surface, &pass->outputs.seen.specular_params,
        &pass->outputs.emission,   &pass->outputs.motion,       &pass->outputs.tint,
        &pass->outputs.absorption, &pass->outputs.far_side,     &pass->outputs.far_color};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        lsf_texture_destroy(pass->context, textures[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
