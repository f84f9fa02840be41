#include "passes/interleave.h"

#include <string.h>

#include "base/base.h"

const lsf_option_row lsf_interleave_options[LSF_INTERLEAVE_OPTION_COUNT] = {
    {"interleave.size", LSF_OPTION_INT, offsetof(lsf_interleave_params, size), 0, 8, NULL, "pixels",
     "side of the pattern in which neighbouring pixels take different samples; 1: all the same; 0: "
     "4 up to 4 iterations, and up to 128 in pictures of 131072 pixels and more; 2 up to 128 and "
     "with a time limit; else 1"},
    {"interleave.periods", LSF_OPTION_INT, offsetof(lsf_interleave_params, periods), 0, 8, NULL,
     "patterns", "width of the filter that removes the pattern; 0: no filter"},
    {"interleave.depth_weight", LSF_OPTION_FLOAT, offsetof(lsf_interleave_params, depth_weight),
     1e-3, 1e3, NULL, "pixels",
     "how far neighbours may be off the pixel's plane, for each pixel that they are away"},
    {"interleave.normal_weight", LSF_OPTION_FLOAT, offsetof(lsf_interleave_params, normal_weight),
     0.0, 1e4, NULL, "", "exponent of the cosine between the normals of neighbours"},
};

/* Pixels of a picture's axis that fall to a tile, and where they begin; see lib/interleave.glsl. */
static int32_t tile_length(uint32_t length, uint32_t size, uint32_t tile)
{
    return (int32_t)(length / size + (tile < length % size));
}

static int32_t tile_corner(uint32_t length, uint32_t size, uint32_t tile)
{
    uint32_t longer = length % size;
    return (int32_t)(tile * (length / size) + (tile < longer ? tile : longer));
}

lsf_region lsf_interleave_region(const lsf_plan *plan, uint32_t size, uint32_t index)
{
    uint32_t x = index % size, y = index / size;
    return (lsf_region){.x = tile_corner(plan->width, size, x),
                        .y = tile_corner(plan->height, size, y),
                        .width = tile_length(plan->width, size, x),
                        .height = tile_length(plan->height, size, y),
                        .tile_x = (int32_t)x,
                        .tile_y = (int32_t)y};
}

/* Condition of textures, beside LSF_TEXTURE_SPECULAR. */
enum { FILTERED = 2 };

#define AT(member) offsetof(lsf_interleave, member)

static const lsf_texture_row textures[] = {
    {"interleave.depth", GL_R32F, AT(split.depth), 0, "in split order"},
    {"interleave.surface", GL_RGBA32UI, AT(split.surface), 0, "in split order"},
    {"interleave.gloss", GL_NONE, AT(split.gloss), 0, "in split order"},
    {"interleave.irradiance", GL_RGBA32F, AT(light.irradiance), 0, "gathered, and filtered"},
    {"interleave.specular", GL_RGBA32F, AT(light.specular), LSF_TEXTURE_SPECULAR,
     "gathered, and filtered"},
    {"interleave.between_irradiance", GL_RGBA32F, AT(between.irradiance), FILTERED,
     "filtered along x"},
    {"interleave.between_specular", GL_RGBA32F, AT(between.specular),
     FILTERED | LSF_TEXTURE_SPECULAR, "filtered along x"},
};

void lsf_interleave_plan(lsf_plan *plan, const lsf_interleave_params *params)
{
    bool gloss = lsf_gbuffer_gloss(plan) != GL_NONE;
    bool specular = plan->requirements.specular;
    lsf_plan_pass_add(plan, "interleave_split",
                      "pixels that take the same samples side by side, %d x %d of them in %u "
                      "iteration%s",
                      params->size, params->size, plan->samples, lsf_plural(plan->samples));
    lsf_plan_reads(plan, "gbuffer");
    lsf_plan_switch_add(plan, "LSF_INTERLEAVE", params->size, "interleave.size");
    lsf_plan_switch_add(plan, "LSF_GLOSS", gloss, "roughness or metallic vary");
    lsf_plan_pass_add(plan, "interleave_gather", "light back into the picture's order");
    lsf_plan_reads(plan, "bidirectional_shade");
    lsf_plan_switch_add(plan, "LSF_INTERLEAVE", params->size, "interleave.size");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", specular, "materials have a specular lobe");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), params->periods > 0 ? FILTERED : 0,
                          plan->width, plan->height);
    if (params->periods == 0) {
        lsf_plan_omit(plan, "interleave_filter", "interleave.periods is 0");
        return;
    }
    lsf_plan_pass_add(plan, "interleave_filter", "removes the pattern, and noise with it");
    lsf_plan_reads(plan, "view gbuffer");
    lsf_plan_switch_add(plan, "LSF_INTERLEAVE", params->size, "interleave.size");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_GLOSS", gloss, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", specular, "materials have a specular lobe");
}

static bool create_filter(lsf_interleave *pass, const lsf_plan *plan, lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/interleave_filter.frag.glsl"};
    lsf_framebuffer_desc desc = {.label = "interleave_filter",
                                 .color_count = 2,
                                 .colors = {pass->between.irradiance, pass->between.specular},
                                 .layer = -1};
    pass->between_framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    pass->filter_program = lsf_plan_program(plan, pass->context, "interleave_filter", files, error);
    pass->filter_timer = lsf_timer_create(pass->context, "interleave_filter", error);
    return pass->between_framebuffer && pass->filter_program && pass->filter_timer;
}

bool lsf_interleave_create(lsf_interleave *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_interleave_params *params, lsf_error *error)
{
    static const char *const split_files[5] = {"lib/fullscreen.vert.glsl",
                                               "passes/interleave_split.frag.glsl"};
    static const char *const gather_files[5] = {"lib/fullscreen.vert.glsl",
                                                "passes/interleave_gather.frag.glsl"};
    *pass = (lsf_interleave){.context = context, .params = *params};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error))
        return false;
    lsf_framebuffer_desc points = {
        .label = "interleave_split",
        .color_count = 3,
        .colors = {pass->split.depth, pass->split.surface, pass->split.gloss},
        .layer = -1};
    lsf_framebuffer_desc light = {.label = "interleave_gather",
                                  .color_count = 2,
                                  .colors = {pass->light.irradiance, pass->light.specular},
                                  .layer = -1};
    pass->split_framebuffer = lsf_framebuffer_create(context, &points, error);
    pass->light_framebuffer = lsf_framebuffer_create(context, &light, error);
    if (!pass->split_framebuffer || !pass->light_framebuffer)
        return false;
    pass->split_program = lsf_plan_program(plan, context, "interleave_split", split_files, error);
    pass->gather_program =
        lsf_plan_program(plan, context, "interleave_gather", gather_files, error);
    if (!pass->split_program || !pass->gather_program)
        return false;
    pass->split_timer = lsf_timer_create(context, "interleave_split", error);
    pass->gather_timer = lsf_timer_create(context, "interleave_gather", error);
    return pass->split_timer && pass->gather_timer &&
           (params->periods == 0 || create_filter(pass, plan, error));
}

static void begin_draw(const lsf_iteration *iteration, GLuint framebuffer, GLuint program)
{
    const lsf_plan *plan = iteration->plan;
    lsf_begin_fullscreen(framebuffer, plan->width, plan->height, program);
}

void lsf_interleave_split(lsf_interleave *pass, const lsf_iteration *iteration,
                          const lsf_surface_maps *seen)
{
    lsf_timer_begin(pass->split_timer);
    begin_draw(iteration, pass->split_framebuffer, pass->split_program);
    lsf_surface_maps_bind(seen);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->split_timer);
}

static void filter_along(lsf_interleave *pass, const lsf_iteration *iteration, GLuint framebuffer,
                         const lsf_split_light *light, int x, int y)
{
    int width = pass->params.size * pass->params.periods;
    begin_draw(iteration, framebuffer, pass->filter_program);
    lsf_bind_texture(3, light->irradiance);
    lsf_bind_texture(4, light->specular);
    glUniform2i(0, x, y);
    glUniform2i(1, width / 2, width % 2 == 0);
    glUniform2f(2, pass->params.depth_weight, pass->params.normal_weight);
    lsf_draw_fullscreen(pass->context);
}

void lsf_interleave_gather(lsf_interleave *pass, const lsf_iteration *iteration,
                           const lsf_surface_maps *seen, const lsf_split_light *split_light)
{
    lsf_timer_begin(pass->gather_timer);
    begin_draw(iteration, pass->light_framebuffer, pass->gather_program);
    lsf_bind_texture(0, split_light->irradiance);
    lsf_bind_texture(1, split_light->specular);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->gather_timer);
    if (!pass->filter_program)
        return;
    lsf_timer_begin(pass->filter_timer);
    lsf_surface_maps_bind(seen);
    filter_along(pass, iteration, pass->between_framebuffer, &pass->light, 1, 0);
    filter_along(pass, iteration, pass->light_framebuffer, &pass->between, 0, 1);
    lsf_timer_end(pass->filter_timer);
}

void lsf_interleave_destroy(lsf_interleave *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_framebuffer_destroy(pass->context, &pass->split_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->light_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->between_framebuffer);
    lsf_timer_destroy(pass->split_timer);
    lsf_timer_destroy(pass->gather_timer);
    lsf_timer_destroy(pass->filter_timer);
    memset(pass, 0, sizeof *pass);
}
