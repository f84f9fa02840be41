#include "passes/gbuffer.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "plan/texture_upload.h"

const lsf_option_row lsf_gbuffer_options[LSF_GBUFFER_OPTION_COUNT] = {
    {"gbuffer.texture_lod_bias", LSF_OPTION_FLOAT, offsetof(lsf_gbuffer_params, texture_lod_bias),
     -16.0, 16.0, NULL, "levels",
     "added to the mipmap level; below 0 sharper and noisier, above 0 blurrier"},
    {"gbuffer.frame_time", LSF_OPTION_FLOAT, offsetof(lsf_gbuffer_params, frame_time), 0.0, 1e6,
     NULL, "s", "motion is measured from this much earlier"},
};

static void plan_switches(lsf_plan *plan)
{
    bool gloss = lsf_plan_find(plan, "gbuffer.gloss") != NULL;
    bool emission = lsf_plan_find(plan, "gbuffer.emission") != NULL;
    bool motion = lsf_plan_find(plan, "gbuffer.motion") != NULL;
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_scene_gpu_material_switches(plan, gloss, emission);
    lsf_plan_switch_add(plan, "LSF_MOTION", motion, "motion is asked for");
    /* Colour attachments are numbered without gaps. */
    int target = 1;
    if (gloss)
        lsf_plan_switch_add(plan, "LSF_GLOSS_TARGET", target++,
                            "its colour attachment is numbered");
    if (emission)
        lsf_plan_switch_add(plan, "LSF_EMISSION_TARGET", target++,
                            "its colour attachment is numbered");
    if (motion)
        lsf_plan_switch_add(plan, "LSF_MOTION_TARGET", target++,
                            "its colour attachment is numbered");
}

void lsf_gbuffer_plan(lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    uint32_t w = plan->width, h = plan->height;
    lsf_plan_pass_add(plan, "gbuffer", "what each pixel sees");
    lsf_plan_texture_add(plan, "gbuffer.depth", GL_DEPTH_COMPONENT32F, w, h,
                         "reverse-Z; positions are made from it");
    lsf_plan_texture_add(plan, "gbuffer.surface", GL_RGBA32UI, w, h,
                         "normals, base colour, metallic");
    if (plan->transmission)
        lsf_plan_texture_add(plan, "gbuffer.gloss", GL_RGBA32UI, w, h,
                             "roughness, f0, anisotropy and transmission");
    else if (r->specular && r->anisotropic)
        lsf_plan_texture_add(plan, "gbuffer.gloss", GL_RG32UI, w, h,
                             "roughness, f0 and anisotropy");
    else if (r->specular && (r->glossy || r->variable_ior))
        lsf_plan_texture_add(plan, "gbuffer.gloss", GL_R32UI, w, h, "roughness and f0");
    else
        lsf_plan_omit(plan, "gbuffer.gloss",
                      r->specular ? "every material has roughness 1, metallic 0 and ior 1.5"
                                  : "diffuse only");
    if (r->emissive || r->unlit)
        lsf_plan_texture_add(plan, "gbuffer.emission", GL_RGBA32F, w, h, "%s",
                             r->emissive ? "some material emits" : "some material is unlit");
    else
        lsf_plan_omit(plan, "gbuffer.emission", "nothing emits");
    if (plan->aovs & LSF_AOV_MOTION)
        lsf_plan_texture_add(plan, "gbuffer.motion", GL_RG32F, w, h, "motion is asked for");
    else
        lsf_plan_omit(plan, "gbuffer.motion", "nothing reads it");
    plan_switches(plan);
}

bool lsf_gbuffer_create(lsf_gbuffer *pass, lsf_context *context, const lsf_plan *plan,
                        const lsf_gbuffer_params *params, const lsf_scene_gpu *scene,
                        lsf_error *error)
{
    static const char *const files[5] = {"passes/gbuffer.vert.glsl", "passes/gbuffer.frag.glsl"};
    lsf_gbuffer_outputs *out = &pass->outputs;
    *pass = (lsf_gbuffer){.context = context};
    if (!lsf_plan_create_texture(plan, context, "gbuffer.depth", &out->depth, error) ||
        !lsf_plan_create_texture(plan, context, "gbuffer.surface", &out->surface, error) ||
        !lsf_plan_create_texture(plan, context, "gbuffer.gloss", &out->gloss, error) ||
        !lsf_plan_create_texture(plan, context, "gbuffer.emission", &out->emission, error) ||
        !lsf_plan_create_texture(plan, context, "gbuffer.motion", &out->motion, error))
        return false;
    lsf_framebuffer_desc desc = {.label = "gbuffer",
                                 .color_count = 4,
                                 .colors = {out->surface, out->gloss, out->emission, out->motion},
                                 .depth = out->depth,
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

void lsf_gbuffer_run(lsf_gbuffer *pass, const lsf_iteration *iteration)
{
    static const GLuint zero_uint[4] = {0};
    static const GLfloat zero[4] = {0};
    lsf_timer_begin(pass->timer);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->framebuffer);
    lsf_begin_surfaces(iteration->plan->width, iteration->plan->height, pass->program);
    GLint at = 0;
    glClearNamedFramebufferfv(pass->framebuffer, GL_DEPTH, 0, zero);
    glClearNamedFramebufferuiv(pass->framebuffer, GL_COLOR, at++, zero_uint);
    if (pass->outputs.gloss)
        glClearNamedFramebufferuiv(pass->framebuffer, GL_COLOR, at++, zero_uint);
    if (pass->outputs.emission)
        glClearNamedFramebufferfv(pass->framebuffer, GL_COLOR, at++, zero);
    if (pass->outputs.motion)
        glClearNamedFramebufferfv(pass->framebuffer, GL_COLOR, at++, zero);
    lsf_draw_region region;
    lsf_iteration_region(iteration, &region);
    lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_SHADING, &region, pass->counts);
    lsf_timer_end(pass->timer);
}

void lsf_gbuffer_destroy(lsf_gbuffer *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    GLuint *textures[] = {&pass->outputs.depth, &pass->outputs.surface, &pass->outputs.gloss,
                          &pass->outputs.emission, &pass->outputs.motion};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        lsf_texture_destroy(pass->context, textures[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
