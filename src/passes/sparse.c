#include "passes/sparse.h"

#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "shared/scene_data.h"

const lsf_option_row lsf_sparse_options[LSF_SPARSE_OPTION_COUNT] = {
    {"sparse.grid", LSF_OPTION_ENUM, offsetof(lsf_sparse_params, grid), 0, 0, "auto|1|2|4|8|16",
     "pixels",
     "initial distance between the points at which indirect light is gathered, halved each time "
     "all pixels have been points; 1: every pixel; auto: 1, or with a time limit and cone, "
     "substitute_tree or voxel_path as fine as the first iteration allows"},
    {"interleave.size", LSF_OPTION_INT, offsetof(lsf_sparse_params, interleave), 0, 8, NULL,
     "points",
     "side of the pattern in which neighbouring pixels take different samples; 1: all take the "
     "same; 0: 4 up to 4 iterations, and without a time limit in pictures of 131072 pixels and "
     "more; 3 up to 8; else 2; but 1 with --raw, beyond 128 iterations without a time limit, and "
     "where the environment, and no lamp, lights more than 1024 triangles that the camera sees "
     "from "
     "outside"},
    {"sparse.radius", LSF_OPTION_INT, offsetof(lsf_sparse_params, radius), 1, 16, NULL, "points",
     "distance up to which points on a pixel's surface are searched for"},
    {"sparse.slope", LSF_OPTION_FLOAT, offsetof(lsf_sparse_params, slope), 1e-3, 10.0, NULL, "",
     "a point has half its weight where its height above the pixel's plane is this times its "
     "distance"},
    {"sparse.normal_weight", LSF_OPTION_FLOAT, offsetof(lsf_sparse_params, normal_weight), 0.0, 1e4,
     NULL, "", "exponent of the cosine between the normals of a pixel and a point"},
    {"sparse.outliers", LSF_OPTION_BOOL, offsetof(lsf_sparse_params, outliers), 0, 0, NULL, "",
     "scales the light of points that is two standard deviations off their neighbours' to the "
     "neighbours' mean"},
};

const char *const lsf_sparse_count_names[LSF_SPARSE_COUNTS] = {"alone", "borrowed"};

/* Along an axis of `length` points: those of a tile, and where they begin. */
static int32_t tile_length(uint32_t length, uint32_t size, uint32_t tile)
{
    return (int32_t)(length / size + (tile < length % size));
}

static int32_t tile_corner(uint32_t length, uint32_t size, uint32_t tile)
{
    uint32_t longer = length % size;
    return (int32_t)(tile * (length / size) + (tile < longer ? tile : longer));
}

lsf_region lsf_sparse_region(const lsf_sparse_grid *grid, uint32_t size, uint32_t index)
{
    uint32_t x = index % size, y = index / size;
    int32_t layers = (int32_t)grid->layers;
    return (lsf_region){.x = tile_corner(grid->width, size, x),
                        .y = layers * tile_corner(grid->height, size, y),
                        .width = tile_length(grid->width, size, x),
                        .height = layers * tile_length(grid->height, size, y),
                        .tile_x = (int32_t)x,
                        .tile_y = (int32_t)y};
}

/* Conditions of textures, beside LSF_TEXTURE_SPECULAR. */
enum { SPLIT = 2, GATHER = 4, SPARSE = 8, SHARED = 16 };

#define AT(member) offsetof(lsf_sparse, member)

/* Of the size of all places. */
static const lsf_texture_row point_textures[] = {
    {"points.depth", GL_R32F, AT(split.depth), SPLIT, "what points see"},
    {"points.surface", GL_RGBA32UI, AT(split.surface), SPLIT, "what points see"},
    {"points.specular_params", GL_NONE, AT(split.specular_params), SPLIT, "what points see"},
    {"points.pixels", GL_R32UI, AT(split.pixels), SPARSE, "which pixel's a point is"},
    {"sparse.gathered_irradiance", GL_RGBA32F, AT(gathered.irradiance), GATHER, "of points"},
    {"sparse.gathered_specular", GL_RGBA32F, AT(gathered.specular), GATHER | LSF_TEXTURE_SPECULAR,
     "of points"},
};

/* Of the size of what is seen. */
static const lsf_texture_row pixels[] = {
    {"sparse.source", GL_R32UI, AT(source), SHARED, "points that a pixel takes light of"},
    {"upsampled.irradiance", GL_RGBA32F, AT(light.irradiance), SPARSE, "of all pixels"},
    {"upsampled.specular", GL_RGBA32F, AT(light.specular), SPARSE | LSF_TEXTURE_SPECULAR,
     "of all pixels"},
};

/* The switches of the pass added last. */
static void plan_switches(lsf_plan *plan, uint32_t interleave, bool tint)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    lsf_sparse_grid_switch(plan);
    lsf_sparse_grid_pixel_switch(plan);
    lsf_interleave_switch(plan, interleave);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    if (!tint)
        return;
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", 0, "never: lobes were evaluated before");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_REFRACTED", plan->refracted,
                        "refracted paths show what is behind media");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_scene_gpu_lobe_switches(plan, specular_params);
}

/* The conditions of textures that hold. */
static uint32_t given(const lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave)
{
    bool sparse = lsf_sparse_grid_is_sparse(plan), split = sparse || interleave > 1;
    bool shared = sparse && !lsf_sparse_grid_is_of_pixels(plan);
    return (split ? SPLIT : 0) | (split || params->outliers ? GATHER : 0) | (sparse ? SPARSE : 0) |
           (shared ? SHARED : 0);
}

void lsf_sparse_plan_split(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave)
{
    uint32_t there = given(plan, params, interleave);
    if (there == 0)
        lsf_plan_omit(plan, "sparse", "light is gathered at every pixel, all by the same samples");
    if (there & SHARED) {
        lsf_plan_pass_add(plan, "sparse_fit", "pixels whose surface every %u-th of them shows",
                          plan->stride);
        lsf_plan_remark(plan,
                        "indirect light is gathered at every %u-th pixel along both sides, others "
                        "in each iteration%s (sparse.grid)",
                        plan->stride,
                        params->chosen ? ", so that the first fits into the time limit" : "");
        lsf_plan_reads(plan, "view gbuffer");
        plan_switches(plan, 1, false);
    }
    if (there & SPLIT) {
        lsf_plan_pass_add(plan, "sparse_split", "what points see%s",
                          interleave > 1 ? ", those side by side that take the same samples" : "");
        lsf_plan_fills(plan, "points");
        lsf_plan_reads(plan, there & SHARED ? "view gbuffer sparse.source" : "view gbuffer");
        plan_switches(plan, interleave, false);
    }
}

void lsf_sparse_plan_gather(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave)
{
    uint32_t there = given(plan, params, interleave), size[2];
    bool tint = there & SHARED || params->outliers;
    if (there & GATHER) {
        lsf_plan_pass_add(plan, "sparse_gather", "light back into the order of points");
        lsf_plan_reads(plan, "view bidirectional_shade|cone_trace|light_tree_sample|voxel_path");
        if (tint)
            lsf_plan_reads(plan, "gbuffer points.pixels");
        plan_switches(plan, interleave, tint);
        lsf_plan_switch_add(plan, "LSF_OUTLIERS", params->outliers, "sparse.outliers");
    }
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_textures_add(plan, point_textures, LSF_COUNT(point_textures), there, size[0], size[1]);
}

void lsf_sparse_plan_upsample(lsf_plan *plan, const lsf_sparse_params *params, uint32_t interleave)
{
    uint32_t there = given(plan, params, interleave);
    if (there & SPARSE && !(there & SHARED)) {
        lsf_plan_pass_add(plan, "sparse_spread", "light of points at their places in pixels");
        lsf_plan_fills(plan, "upsampled");
        lsf_plan_reads(plan, "sparse");
        plan_switches(plan, interleave, false);
    } else if (there & SPARSE) {
        lsf_plan_pass_add(plan, "sparse_upsample", "light of points for every pixel");
        lsf_plan_fills(plan, "upsampled");
        lsf_plan_reads(plan, "view gbuffer points.pixels sparse blur");
        plan_switches(plan, interleave, true);
        lsf_plan_buffer_add(plan, "sparse.counts", LSF_SPARSE_COUNTS * sizeof(GLuint),
                            "pixels that no point fits");
    }
    lsf_plan_textures_add(plan, pixels, LSF_COUNT(pixels), there, plan->seen_width,
                          plan->seen_height);
}

/* A stage: its framebuffer, program and timer. */
typedef struct stage {
    const char *name, *file;
    lsf_framebuffer_desc targets;
    GLuint *framebuffer, *program;
    lsf_timer **timer;
} stage;

static bool create_stage(const stage *s, lsf_context *context, const lsf_plan *plan,
                         lsf_error *error)
{
    const char *const files[5] = {"lib/fullscreen.vert.glsl", s->file};
    if (!lsf_plan_find_pass(plan, s->name))
        return true;
    lsf_framebuffer_desc targets = s->targets;
    targets.label = s->name;
    targets.layer = -1;
    *s->framebuffer = lsf_framebuffer_create(context, &targets, error);
    *s->program = *s->framebuffer ? lsf_plan_program(plan, context, s->name, files, error) : 0;
    *s->timer = *s->program ? lsf_timer_create(context, s->name, error) : NULL;
    return *s->timer != NULL;
}

bool lsf_sparse_create(lsf_sparse *pass, lsf_context *context, const lsf_plan *plan,
                       const lsf_sparse_params *params, lsf_error *error)
{
    static const GLuint zero = 0;
    *pass = (lsf_sparse){.context = context, .params = *params};
    if (!lsf_plan_create_textures(plan, context, point_textures, LSF_COUNT(point_textures), pass,
                                  error) ||
        !lsf_plan_create_textures(plan, context, pixels, LSF_COUNT(pixels), pass, error) ||
        !lsf_plan_create_buffer_if_planned(plan, context, "sparse.counts", NULL,
                                           GL_DYNAMIC_STORAGE_BIT, &pass->count_buffer, error))
        return false;
    if (pass->count_buffer)
        glClearNamedBufferData(pass->count_buffer, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                               &zero);
    const lsf_surface_maps *split = &pass->split;
    bool spread = lsf_plan_find_pass(plan, "sparse_spread") != NULL;
    const stage stages[] = {
        {"sparse_fit",
         "passes/sparse_fit.frag.glsl",
         {.color_count = 1, .colors = {pass->source}},
         &pass->source_framebuffer,
         &pass->fit_program,
         &pass->fit_timer},
        {"sparse_split",
         "passes/sparse_split.frag.glsl",
         {.color_count = 4,
          .colors = {split->depth, split->surface, split->specular_params, split->pixels}},
         &pass->split_framebuffer,
         &pass->split_program,
         &pass->split_timer},
        {"sparse_gather",
         "passes/sparse_gather.frag.glsl",
         {.color_count = 2, .colors = {pass->gathered.irradiance, pass->gathered.specular}},
         &pass->gathered_framebuffer,
         &pass->gather_program,
         &pass->gather_timer},
        {spread ? "sparse_spread" : "sparse_upsample",
         spread ? "passes/sparse_spread.frag.glsl" : "passes/sparse_upsample.frag.glsl",
         {.color_count = 2, .colors = {pass->light.irradiance, pass->light.specular}},
         &pass->light_framebuffer,
         &pass->upsample_program,
         &pass->upsample_timer},
    };
    for (size_t i = 0; i < LSF_COUNT(stages); i++)
        if (!create_stage(&stages[i], context, plan, error))
            return false;
    return true;
}

static void begin(const lsf_sparse *pass, const lsf_iteration *iteration, GLuint framebuffer,
                  GLuint program, uint32_t width, uint32_t height)
{
    lsf_begin_fullscreen(framebuffer, width, height, program);
    lsf_sparse_grid_set(iteration->plan, &iteration->grid);
    if (pass->fit_program || pass->params.outliers)
        glUniform3f(0, (float)pass->params.radius, 1.0f / (pass->params.slope * pass->params.slope),
                    pass->params.normal_weight);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_SPARSE_COUNTS, pass->count_buffer);
}

static void fit(lsf_sparse *pass, const lsf_iteration *iteration, const lsf_surface_maps *seen)
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->fit_timer);
    begin(pass, iteration, pass->source_framebuffer, pass->fit_program, plan->seen_width,
          plan->seen_height);
    lsf_surface_maps_bind(seen);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->fit_timer);
}

void lsf_sparse_split(lsf_sparse *pass, const lsf_iteration *iteration,
                      const lsf_surface_maps *seen)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    if (pass->fit_program)
        fit(pass, iteration, seen);
    lsf_timer_begin(pass->split_timer);
    begin(pass, iteration, pass->split_framebuffer, pass->split_program, grid->width,
          grid->layers * grid->height);
    lsf_surface_maps_bind(seen);
    lsf_bind_texture(3, pass->source);
    if (pass->fit_program)
        glUniform1ui(1, lsf_iteration_seed(iteration, LSF_PURPOSE_SPARSE_GRID) + iteration->index);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->split_timer);
}

void lsf_sparse_gather(lsf_sparse *pass, const lsf_iteration *iteration,
                       const lsf_surface_maps *seen, const lsf_split_light *split_light)
{
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_timer_begin(pass->gather_timer);
    begin(pass, iteration, pass->gathered_framebuffer, pass->gather_program, grid->width,
          grid->layers * grid->height);
    lsf_surface_maps_bind(seen);
    lsf_bind_texture(LSF_UNIT_POSITION_PIXELS, pass->split.pixels);
    lsf_bind_texture(3, split_light->irradiance);
    lsf_bind_texture(4, split_light->specular);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->gather_timer);
}

void lsf_sparse_upsample(lsf_sparse *pass, const lsf_iteration *iteration,
                         const lsf_surface_maps *seen, const lsf_split_light *points)
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->upsample_timer);
    begin(pass, iteration, pass->light_framebuffer, pass->upsample_program, plan->seen_width,
          plan->seen_height);
    lsf_surface_maps_bind(seen);
    lsf_bind_texture(LSF_UNIT_POSITION_PIXELS, pass->split.pixels);
    lsf_bind_texture(3, pass->source);
    lsf_bind_texture(4, points->irradiance);
    lsf_bind_texture(5, points->specular);
    lsf_bind_texture(6, pass->gathered.irradiance);
    lsf_bind_texture(7, pass->gathered.specular);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->upsample_timer);
}

const uint64_t *lsf_sparse_counts(lsf_sparse *pass)
{
    GLuint counts[LSF_SPARSE_COUNTS];
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(pass->count_buffer, 0, sizeof counts, counts);
    for (size_t i = 0; i < LSF_SPARSE_COUNTS; i++)
        pass->counts[i] = counts[i];
    return pass->counts;
}

void lsf_sparse_destroy(lsf_sparse *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, point_textures, LSF_COUNT(point_textures), pass);
    lsf_textures_destroy(pass->context, pixels, LSF_COUNT(pixels), pass);
    GLuint *framebuffers[] = {&pass->source_framebuffer, &pass->split_framebuffer,
                              &pass->gathered_framebuffer, &pass->light_framebuffer};
    for (size_t i = 0; i < LSF_COUNT(framebuffers); i++)
        lsf_framebuffer_destroy(pass->context, framebuffers[i]);
    lsf_timer *timers[] = {pass->fit_timer, pass->split_timer, pass->gather_timer,
                           pass->upsample_timer};
    for (size_t i = 0; i < LSF_COUNT(timers); i++)
        lsf_timer_destroy(timers[i]);
    lsf_buffer_destroy(pass->context, &pass->count_buffer);
    memset(pass, 0, sizeof *pass);
}
