#include "passes/upsample_search.h"

#include <string.h>

#include "base/base.h"

const lsf_option_row lsf_upsample_search_options[LSF_UPSAMPLE_SEARCH_OPTION_COUNT] = {
    {"upsample_search.radius", LSF_OPTION_INT, offsetof(lsf_upsample_search_params, radius), 1, 16,
     NULL, "texels", "how far to search for traced light of the surface that a pixel shows"},
    {"upsample_search.min_cosine", LSF_OPTION_FLOAT,
     offsetof(lsf_upsample_search_params, min_cosine), 0.0, 1.0, NULL, "",
     "between normals that count as alike"},
    {"upsample_search.slope", LSF_OPTION_FLOAT, offsetof(lsf_upsample_search_params, slope), 0.0,
     1.0, NULL, "", "how far a place of the same surface may rise from it for its distance"},
};

#define AT(member) offsetof(lsf_upsample_search, member)

/* Of the grid's size. */
static const lsf_texture_row coarse[] = {
    {"upsample_search.depth", GL_R32F, AT(coarse.depth), 0, "what the grid sees"},
    {"upsample_search.surface", GL_RGBA32UI, AT(coarse.surface), 0, "what the grid sees"},
    {"upsample_search.gloss", GL_NONE, AT(coarse.gloss), 0, "what the grid sees"},
};

/* Of the picture's size. */
static const lsf_texture_row fine[] = {
    {"upsample_search.irradiance", GL_RGBA32F, AT(light.irradiance), 0, "upsampled"},
    {"upsample_search.specular", GL_RGBA32F, AT(light.specular), LSF_TEXTURE_SPECULAR, "upsampled"},
};

static void plan_split(lsf_plan *plan, uint32_t width, uint32_t height)
{
    lsf_plan_pass_add(plan, "upsample_search_split", "what %u x %u places of the picture see",
                      width, height);
    lsf_plan_reads(plan, "view gbuffer");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_coarse_grid_switch(plan, width, height);
    lsf_plan_switch_add(plan, "LSF_GLOSS", lsf_gbuffer_gloss(plan) != GL_NONE,
                        "roughness or metallic vary");
    lsf_plan_textures_add(plan, coarse, LSF_COUNT(coarse), 0, width, height);
}

void lsf_upsample_search_plan(lsf_plan *plan, const lsf_upsample_search_params *params,
                              uint32_t width, uint32_t height)
{
    (void)params; /* its values are uniforms */
    if (!lsf_coarse_grid_is_coarse(plan, width, height)) {
        lsf_plan_omit(plan, "upsample_search", "light is traced for every pixel");
        return;
    }
    plan_split(plan, width, height);
    lsf_plan_pass_add(plan, "upsample_search", "light of the grid for every pixel");
    lsf_plan_reads(plan, "view gbuffer blur|cone_trace|voxel_path");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_coarse_grid_switch(plan, width, height);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_textures_add(plan, fine, LSF_COUNT(fine), 0, plan->width, plan->height);
}

bool lsf_upsample_search_create(lsf_upsample_search *pass, lsf_context *context,
                                const lsf_plan *plan, const lsf_upsample_search_params *params,
                                lsf_error *error)
{
    static const char *const split_files[5] = {"lib/fullscreen.vert.glsl",
                                               "passes/upsample_search_split.frag.glsl"};
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/upsample_search.frag.glsl"};
    *pass = (lsf_upsample_search){.context = context, .params = *params};
    if (!lsf_plan_find_pass(plan, "upsample_search"))
        return true;
    if (!lsf_plan_create_textures(plan, context, coarse, LSF_COUNT(coarse), pass, error) ||
        !lsf_plan_create_textures(plan, context, fine, LSF_COUNT(fine), pass, error))
        return false;
    const lsf_plan_resource *depth = lsf_plan_find(plan, "upsample_search.depth");
    pass->grid.width = depth->texture.width;
    pass->grid.height = depth->texture.height;
    lsf_framebuffer_desc points = {
        .label = "upsample_search_split",
        .color_count = 3,
        .colors = {pass->coarse.depth, pass->coarse.surface, pass->coarse.gloss},
        .layer = -1};
    lsf_framebuffer_desc light = {.label = "upsample_search",
                                  .color_count = 2,
                                  .colors = {pass->light.irradiance, pass->light.specular},
                                  .layer = -1};
    pass->split_framebuffer = lsf_framebuffer_create(context, &points, error);
    pass->light_framebuffer = lsf_framebuffer_create(context, &light, error);
    if (!pass->split_framebuffer || !pass->light_framebuffer)
        return false;
    pass->split_program =
        lsf_plan_program(plan, context, "upsample_search_split", split_files, error);
    pass->program = lsf_plan_program(plan, context, "upsample_search", files, error);
    if (!pass->split_program || !pass->program)
        return false;
    pass->split_timer = lsf_timer_create(context, "upsample_search_split", error);
    pass->timer = lsf_timer_create(context, "upsample_search", error);
    return pass->split_timer && pass->timer;
}

void lsf_upsample_search_split(lsf_upsample_search *pass, const lsf_iteration *iteration,
                               const lsf_surface_maps *seen)
{
    lsf_timer_begin(pass->split_timer);
    pass->grid = lsf_coarse_grid_at(iteration, pass->grid.width, pass->grid.height);
    lsf_begin_fullscreen(pass->split_framebuffer, pass->grid.width, pass->grid.height,
                         pass->split_program);
    lsf_coarse_grid_set(&pass->grid);
    lsf_surface_maps_bind(seen);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->split_timer);
}

void lsf_upsample_search_run(lsf_upsample_search *pass, const lsf_iteration *iteration,
                             const lsf_surface_maps *seen, const lsf_split_light *coarse_light)
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->light_framebuffer, iteration->plan->width, iteration->plan->height,
                         pass->program);
    lsf_coarse_grid_set(&pass->grid);
    const GLuint textures[6] = {seen->depth,
                                seen->surface,
                                pass->coarse.depth,
                                pass->coarse.surface,
                                coarse_light->irradiance,
                                coarse_light->specular};
    for (GLuint unit = 0; unit < LSF_COUNT(textures); unit++)
        lsf_bind_texture(unit, textures[unit]);
    glUniform3f(0, (float)pass->params.radius, pass->params.min_cosine,
                pass->params.slope * pass->params.slope);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_upsample_search_destroy(lsf_upsample_search *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, coarse, LSF_COUNT(coarse), pass);
    lsf_textures_destroy(pass->context, fine, LSF_COUNT(fine), pass);
    lsf_framebuffer_destroy(pass->context, &pass->split_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->light_framebuffer);
    lsf_timer_destroy(pass->split_timer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
