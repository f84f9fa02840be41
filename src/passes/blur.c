#include "passes/blur.h"

#include <math.h>
#include <string.h>

#include "base/base.h"

const lsf_option_row lsf_blur_options[LSF_BLUR_OPTION_COUNT] = {
    {"blur.phases", LSF_OPTION_INT, offsetof(lsf_blur_params, phases), 0, 8, NULL, "",
     "of a blur of what few paths or cones find, in each iteration, each phase for rougher "
     "surfaces than the one before; 0: no blur, 5: as in the frames of the papers"},
    {"blur.step", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, step), 1.0, 64.0, NULL, "texels",
     "between the taps of the first phase, at the viewer"},
    {"blur.ratio", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, ratio), 1.0, 4.0, NULL, "",
     "of a phase's step to that of the phase before"},
    {"blur.growth", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, growth), 0.0, 100.0, NULL, "",
     "growth of the last phase's step for each half extent of the scene from the viewer"},
    {"blur.min_roughness", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, min_roughness), 0.0, 1.0,
     NULL, "", "below it specular light is not blurred"},
    {"blur.cutoff", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, cutoff), 1.0, 1e3, NULL, "steps",
     "neighbours further in space than this many steps of the phase are left out"},
    {"blur.slope", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, slope), 0.0, 1.0, NULL, "",
     "neighbours that rise from the surface by more than this for their distance are left out"},
    {"blur.normal_weight", LSF_OPTION_FLOAT, offsetof(lsf_blur_params, normal_weight), 0.0, 1e4,
     NULL, "", "exponent of the cosine between the normals of neighbours"},
};

#define AT(member) offsetof(lsf_blur, member)

static const lsf_texture_row textures[] = {
    {"blur.guide", GL_RGBA32UI, AT(guide), 0, "positions, normals and phases"},
    {"blur.irradiance", GL_RGBA32F, AT(light.irradiance), 0, "blurred"},
    {"blur.specular", GL_RGBA32F, AT(light.specular), LSF_TEXTURE_SPECULAR, "blurred"},
    {"blur.between_irradiance", GL_RGBA32F, AT(between.irradiance), 0, "blurred along x"},
    {"blur.between_specular", GL_RGBA32F, AT(between.specular), LSF_TEXTURE_SPECULAR,
     "blurred along x"},
};

bool lsf_blur_wanted(const lsf_blur_params *params)
{
    return params->phases > 0;
}

void lsf_blur_remark(lsf_plan *plan, const lsf_blur_params *params)
{
    if (lsf_blur_wanted(params) && plan->samples > 1)
        lsf_plan_remark(plan, "blur.phases blurs each iteration: the picture converges to a "
                              "blurred one");
}

void lsf_blur_plan(lsf_plan *plan, const lsf_blur_params *params, uint32_t width, uint32_t height)
{
    const lsf_requirements *r = &plan->requirements;
    if (!lsf_blur_wanted(params)) {
        lsf_plan_omit(plan, "blur", "blur.phases is 0");
        return;
    }
    bool gloss = lsf_gbuffer_gloss(plan) != GL_NONE;
    lsf_plan_pass_add(plan, "blur_guide", "what the blur compares, once for all phases");
    lsf_plan_reads(plan, "view upsample_search|gbuffer");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_coarse_grid_switch(plan, width, height);
    lsf_plan_switch_add(plan, "LSF_GLOSS", gloss, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", gloss && r->anisotropic,
                        "some material is anisotropic");
    lsf_plan_pass_add(plan, "blur", "removes the noise of few samples, the rougher the wider");
    lsf_plan_reads(plan, "view cone_trace|voxel_path");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, width, height);
}

static GLuint create_framebuffer(lsf_context *context, const char *label, GLuint first,
                                 GLuint second, lsf_error *error)
{
    lsf_framebuffer_desc desc = {
        .label = label, .layer = -1, .color_count = 2, .colors = {first, second}};
    return lsf_framebuffer_create(context, &desc, error);
}

bool lsf_blur_create(lsf_blur *pass, lsf_context *context, const lsf_plan *plan,
                     const lsf_blur_params *params, lsf_error *error)
{
    static const char *const guide_files[5] = {"lib/fullscreen.vert.glsl",
                                               "passes/blur_guide.frag.glsl"};
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/blur.frag.glsl"};
    *pass = (lsf_blur){.context = context, .params = *params};
    if (params->phases == 0)
        return true;
    const lsf_split_light *out = &pass->light, *between = &pass->between;
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error))
        return false;
    pass->guide_framebuffer = create_framebuffer(context, "blur_guide", pass->guide, 0, error);
    pass->framebuffer = create_framebuffer(context, "blur", out->irradiance, out->specular, error);
    pass->between_framebuffer =
        create_framebuffer(context, "blur_between", between->irradiance, between->specular, error);
    if (!pass->guide_framebuffer || !pass->framebuffer || !pass->between_framebuffer)
        return false;
    pass->guide_program = lsf_plan_program(plan, context, "blur_guide", guide_files, error);
    pass->program = lsf_plan_program(plan, context, "blur", files, error);
    pass->timer = lsf_timer_create(context, "blur", error);
    return pass->guide_program && pass->program && pass->timer;
}

static void make_guide(lsf_blur *pass, const lsf_blur_inputs *inputs)
{
    lsf_begin_fullscreen(pass->guide_framebuffer, inputs->grid->width, inputs->grid->height,
                         pass->guide_program);
    lsf_coarse_grid_set(inputs->grid);
    lsf_surface_maps_bind(inputs->seen);
    glUniform2f(0, pass->params.min_roughness, (float)pass->params.phases);
    lsf_draw_fullscreen(pass->context);
}

static void blur_along(lsf_blur *pass, const lsf_coarse_grid *grid, int phase, int x, int y,
                       GLuint framebuffer, const lsf_split_light *light)
{
    const lsf_blur_params *p = &pass->params;
    lsf_begin_fullscreen(framebuffer, grid->width, grid->height, pass->program);
    lsf_bind_texture(3, light->irradiance);
    lsf_bind_texture(4, light->specular);
    glUniform3i(0, x, y, phase);
    glUniform4f(1, p->step * powf(p->ratio, (float)(phase - 1)), p->growth,
                1.0f / (float)(x ? grid->width : grid->height), p->normal_weight);
    /* The first phase's taps stay adjacent, so that no texel is skipped; the last grows fully. */
    float share = p->phases > 1 ? (float)(phase - 1) / (float)(p->phases - 1) : 0.0f;
    glUniform3f(2, p->cutoff * p->cutoff, p->slope * p->slope, share);
    lsf_draw_fullscreen(pass->context);
}

void lsf_blur_run(lsf_blur *pass, const lsf_iteration *iteration, const lsf_blur_inputs *inputs)
{
    (void)iteration; /* its view is bound */
    const lsf_split_light *light = inputs->light;
    lsf_timer_begin(pass->timer);
    make_guide(pass, inputs);
    lsf_bind_texture(0, pass->guide);
    for (int phase = 1; phase <= pass->params.phases; phase++) {
        blur_along(pass, inputs->grid, phase, 1, 0, pass->between_framebuffer, light);
        blur_along(pass, inputs->grid, phase, 0, 1, pass->framebuffer, &pass->between);
        light = &pass->light;
    }
    lsf_timer_end(pass->timer);
}

void lsf_blur_destroy(lsf_blur *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->between_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->guide_framebuffer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
