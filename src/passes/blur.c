#include "passes/blur.h"

#include <math.h>
#include <string.h>

#include "base/base.h"

const lsf_option_row lsf_blur_options[LSF_BLUR_OPTION_COUNT] = {
    {"sparse.blur", LSF_OPTION_INT, offsetof(lsf_blur_params, phases), 0, 8, NULL, "phases",
     "phases of a blur of the gathered light in each iteration, each for rougher surfaces than "
     "the one before; 0: no blur, 5: as in the frames of the papers"},
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
        lsf_plan_remark(plan, "sparse.blur blurs each iteration: the picture converges to a "
                              "blurred one");
}

void lsf_blur_plan(lsf_plan *plan, const lsf_blur_params *params)
{
    uint32_t points[2];
    const lsf_requirements *r = &plan->requirements;
    if (!lsf_blur_wanted(params)) {
        lsf_plan_omit(plan, "blur", "sparse.blur is 0");
        return;
    }
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_plan_pass_add(plan, "blur_guide", "what the blur compares, once for all phases");
    lsf_plan_reads(plan, "view gbuffer");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    lsf_plan_pass_add(plan, "blur", "removes the noise of few samples, the rougher the wider");
    lsf_plan_reads(plan, "view sparse|light_tree_sample|cone_trace|voxel_path|bidirectional_shade");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_sparse_grid_points(plan, points);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, points[0], points[1]);
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

static void make_guide(lsf_blur *pass, const lsf_iteration *iteration,
                       const lsf_blur_inputs *inputs)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_begin_fullscreen(pass->guide_framebuffer, grid->width, grid->height, pass->guide_program);
    lsf_sparse_grid_set(iteration->plan, grid);
    lsf_surface_maps_bind(inputs->seen);
    glUniform2f(0, pass->params.min_roughness, (float)pass->params.phases);
    lsf_draw_fullscreen(pass->context);
}

static void blur_along(lsf_blur *pass, const lsf_iteration *iteration, int phase, int x, int y,
                       GLuint framebuffer, const lsf_split_light *light)
{
    const lsf_blur_params *p = &pass->params;
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_begin_fullscreen(framebuffer, grid->width, grid->height, pass->program);
    lsf_sparse_grid_set(iteration->plan, grid);
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
    const lsf_split_light *light = inputs->light;
    lsf_timer_begin(pass->timer);
    make_guide(pass, iteration, inputs);
    lsf_bind_texture(0, pass->guide);
    for (int phase = 1; phase <= pass->params.phases; phase++) {
        blur_along(pass, iteration, phase, 1, 0, pass->between_framebuffer, light);
        blur_along(pass, iteration, phase, 0, 1, pass->framebuffer, &pass->between);
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
