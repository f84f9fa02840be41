#include "passes/ray_bundle.h"

#include <stdlib.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "passes/ray_bundle_parts.h"
#include "shared/scene_data.h"

/* The search walks slices in one loop of this many steps; see LSF_STEPS there. */
#define MAX_SLICES 63

#define SURFACES "LSF_BUNDLE_SURFACES"

const lsf_option_row lsf_ray_bundle_options[LSF_RAY_BUNDLE_OPTION_COUNT] = {
    {"bundle.count", LSF_OPTION_INT, offsetof(lsf_ray_bundle_params, count), 1, 4096, NULL, "",
     "ray-bundles per iteration"},
    {"bundle.resolution", LSF_OPTION_INT, offsetof(lsf_ray_bundle_params, resolution), 0, 4096,
     NULL, "texels",
     "width and height of a bundle's map, at least 16; 0: 256, and more beyond 32 iterations, up "
     "to 768"},
    {"bundle.window", LSF_OPTION_ENUM, offsetof(lsf_ray_bundle_params, window), 0, 0,
     "auto|visible|scene", "",
     "what a bundle covers; visible: the visible points; scene: the whole scene; auto: scene if "
     "paths continue from its hits, else visible"},
    {"bundle.slices", LSF_OPTION_INT, offsetof(lsf_ray_bundle_params, slices), 0, MAX_SLICES, NULL,
     "",
     "fragments of a texel that are stored at fixed positions, the others are chained; 0: all are "
     "chained"},
    {"bundle.capacity", LSF_OPTION_FLOAT, offsetof(lsf_ray_bundle_params, capacity), 0.0, 1024.0,
     NULL, "", "initial capacity for chained fragments, per texel; it grows when it is exceeded"},
    {"bundle.raster", LSF_OPTION_ENUM, offsetof(lsf_ray_bundle_params, raster), 0, 0, "compute|gl",
     "", "compute: small triangles by a compute shader, large ones by GL; gl: all by GL"},
    {"bundle.environment_offset", LSF_OPTION_FLOAT,
     offsetof(lsf_ray_bundle_params, environment_offset), 1e-3, 1e6, NULL, "",
     "radiance added to the environment map when directions of bundles are drawn from it, "
     "relative to its mean"},
};

const char *const lsf_ray_bundle_count_names[LSF_RAY_BUNDLE_COUNTS] = {"nodes", "chained",
                                                                       "regrown"};

static bool window_is_fitted(const lsf_ray_bundle_params *params, const lsf_ray_bundle_use *use)
{
    return params->window == LSF_RAY_BUNDLE_WINDOW_VISIBLE ||
           (params->window == LSF_RAY_BUNDLE_WINDOW_AUTO && !use->whole_scene);
}

void lsf_ray_bundle_gap_switch(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_BUNDLE_GAPS", plan->islands.count > 1,
                        "parts of the scene lie far apart");
}

void lsf_ray_bundle_reader_switches(lsf_plan *plan)
{
    bool specular_params = lsf_plan_surfaces_differ(plan);
    lsf_plan_switch_add(plan, "LSF_BUNDLE_SPECULAR_PARAMS", specular_params,
                        "some material is glossy");
    lsf_plan_switch_add(plan, "LSF_BUNDLE_ANISOTROPY",
                        lsf_ray_bundle_has_wide_specular_params(plan),
                        "some material is anisotropic or lets light through");
    lsf_plan_switch_add(plan, "LSF_BUNDLE_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    lsf_ray_bundle_gap_switch(plan);
}

void lsf_ray_bundle_plan(lsf_plan *plan, const lsf_ray_bundle_params *params,
                         const lsf_ray_bundle_use *use)
{
    uint32_t size[2];
    lsf_plan_buffer_add(plan, "ray_bundle.projections",
                        use->count * sizeof(struct lsf_bundle_slot_data),
                        "projections of %u bundle%s", use->count, lsf_plural(use->count));
    if (window_is_fitted(params, use))
        lsf_ray_bundle_aim_plan(plan);
    else
        lsf_plan_omit(plan, "ray_bundle_bounds", "bundles hold the whole scene");
    lsf_plan_pass_add(plan, "ray_bundle_build",
                      "every fragment of the scene along %u direction%s, on maps of %d x %d texels "
                      "with slices for %d fragments each",
                      use->count, lsf_plural(use->count), params->resolution, params->resolution,
                      lsf_ray_bundle_slices(params));
    lsf_plan_reads(plan, "scene");
    lsf_ray_bundle_reader_switches(plan);
    lsf_plan_switch_add(plan, SURFACES, !use->distances_only, "not only distances are asked for");
    lsf_scene_gpu_material_switches(plan, lsf_plan_surfaces_differ(plan) && !use->distances_only,
                                    lsf_plan_surfaces_shine(plan) && !use->distances_only);
    lsf_scene_gpu_fold_lobes(plan);
    if (!use->distances_only)
        lsf_scene_gpu_media_switch(plan);
    lsf_ray_bundle_raster_plan(plan, params);
    lsf_ray_bundle_nodes_plan(plan, params, use);
    lsf_ray_bundle_tally_plan(plan);
    lsf_plan_pass_add(plan, "ray_bundle_search", "what rays from the visible points meet");
    lsf_plan_reads(plan, "view points|gbuffer");
    if (use->deep_vertices)
        lsf_plan_reads(plan, "bidirectional_shade");
    lsf_ray_bundle_reader_switches(plan);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_interleave_switch(plan, use->interleave);
    lsf_plan_switch_add(plan, SURFACES, !use->distances_only, "not only distances are asked for");
    lsf_plan_switch_add(plan, "LSF_DEEP", use->deep_vertices, "paths go on from hits");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight,
                        "light goes straight through materials that transmit");
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_buffer_add(plan, "ray_bundle.rest", 4 + 4 * (uint64_t)size[0] * size[1],
                        "pixels whose search takes more than a look at the slices");
    lsf_plan_texture_add(plan, "ray_bundle.hits", GL_RG32UI, size[0], size[1],
                         "distance and node of each ray's hit");
}

static bool create_resources(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error)
{
    lsf_context *context = pass->context;
    pass->projections = lsf_alloc(pass->use.count, sizeof *pass->projections);
    if (!pass->projections)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u ray-bundles",
                             pass->use.count);
    if (!lsf_ray_bundle_nodes_create(pass, plan, error) ||
        !lsf_plan_create_buffer(plan, context, "ray_bundle.projections", NULL,
                                GL_DYNAMIC_STORAGE_BIT, &pass->projection_buffer, error) ||
        !lsf_ray_bundle_tally_create(pass, plan, error) ||
        !lsf_plan_create_buffer(plan, context, "ray_bundle.rest", NULL, 0, &pass->rest, error) ||
        !lsf_plan_create_texture(plan, context, "ray_bundle.hits", &pass->hits, error))
        return false;
    uint32_t side = (uint32_t)pass->params.resolution;
    lsf_framebuffer_desc build = {
        .label = "ray_bundle.build", .layer = -1, .width = side, .height = side};
    lsf_framebuffer_desc hits = {
        .label = "ray_bundle.hits", .color_count = 1, .colors = {pass->hits}, .layer = -1};
    pass->build_framebuffer = lsf_framebuffer_create(context, &build, error);
    if (!pass->build_framebuffer)
        return false;
    pass->hits_framebuffer = lsf_framebuffer_create(context, &hits, error);
    return pass->hits_framebuffer != 0;
}

bool lsf_ray_bundle_create(lsf_ray_bundle **out, lsf_context *context, const lsf_plan *plan,
                           const lsf_ray_bundle_params *params, const lsf_ray_bundle_use *use,
                           lsf_error *error)
{
    static const char *const build_files[5] = {"passes/ray_bundle_build.vert.glsl",
                                               "passes/ray_bundle_build.frag.glsl"};
    static const char *const rest_files[5] = {"passes/ray_bundle_rest.comp.glsl"};
    static const char *const search_files[5] = {"passes/ray_bundle_search.vert.glsl",
                                                "passes/ray_bundle_search.frag.glsl"};
    lsf_ray_bundle *pass = *out = lsf_alloc(1, sizeof *pass);
    if (!pass)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    pass->context = context;
    pass->params = *params;
    pass->use = *use;
    pass->fitted = window_is_fitted(params, use);
    pass->side = (uint32_t)params->resolution;
    if (!create_resources(pass, plan, error) || !lsf_ray_bundle_raster_create(pass, plan, error) ||
        (pass->fitted && !lsf_ray_bundle_aim_create(pass, plan, error)))
        return false;
    pass->build_program = lsf_plan_program(plan, context, "ray_bundle_build", build_files, error);
    pass->search_program =
        lsf_plan_program(plan, context, "ray_bundle_search", search_files, error);
    pass->rest_program = lsf_plan_program(plan, context, "ray_bundle_search", rest_files, error);
    pass->build_timer = lsf_timer_create(context, "ray_bundle_build", error);
    pass->search_timer = lsf_timer_create(context, "ray_bundle_search", error);
    return pass->build_program && pass->search_program && pass->rest_program && pass->build_timer &&
           pass->search_timer;
}

lsf_bundle_nodes lsf_ray_bundle_nodes(const lsf_ray_bundle *pass, uint32_t bundle)
{
    return (lsf_bundle_nodes){.projections = pass->projection_buffer,
                              .offset = (GLintptr)(bundle * sizeof *pass->projections),
                              .arrays = pass->slots[bundle % pass->use.slots].arrays};
}

static void bind_nodes(const lsf_ray_bundle *pass, uint32_t bundle)
{
    const lsf_bundle_nodes nodes = lsf_ray_bundle_nodes(pass, bundle);
    lsf_bundle_nodes_bind(&nodes);
}

/* Clears the lists of all texels. */
static void clear_lists(const lsf_ray_bundle *pass, const lsf_ray_bundle_slot *slot)
{
    static const GLuint zero = 0;
    glClearNamedBufferSubData(slot->arrays[LSF_RAY_BUNDLE_KEYS], GL_R32UI, 0,
                              (GLsizeiptr)(16 * lsf_ray_bundle_texels(&pass->params)),
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glClearNamedBufferSubData(slot->arrays[LSF_RAY_BUNDLE_HEADS], GL_R32UI, 0,
                              4 * LSF_BUNDLE_COUNTERS, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void lsf_ray_bundle_set_chance(const lsf_ray_bundle *pass, const lsf_iteration *iteration,
                               uint32_t bundle)
{
    bool straight = iteration->plan->straight && !pass->use.distances_only;
    if (straight || iteration->plan->requirements.blended)
        lsf_iteration_set_chance(iteration, LSF_PURPOSE_STRAIGHT_BUNDLE, bundle);
}

void lsf_ray_bundle_build(lsf_ray_bundle *pass, const lsf_iteration *iteration, uint32_t bundle)
{
    uint32_t side = (uint32_t)pass->params.resolution;
    lsf_timer_begin(pass->build_timer);
    lsf_begin_fullscreen(pass->build_framebuffer, side, side, pass->build_program);
    glEnable(GL_DEPTH_CLAMP); /* rounding must not clip what lies on the range's ends */
    GLint margin = (GLint)(side - pass->side) / 2;
    glEnable(GL_SCISSOR_TEST);
    glScissor(margin, margin, (GLsizei)pass->side, (GLsizei)pass->side);
    clear_lists(pass, &pass->slots[bundle % pass->use.slots]);
    bind_nodes(pass, bundle);
    glBeginQuery(GL_SAMPLES_PASSED, pass->samples_query);
    if (pass->small_program) {
        lsf_ray_bundle_raster_run(pass, iteration, bundle);
    } else {
        glUniform1ui(0, pass->capacity);
        lsf_ray_bundle_set_chance(pass, iteration, bundle);
        lsf_scene_gpu_draw(iteration->scene, iteration->state, LSF_DRAW_POINTWISE, NULL,
                           pass->draw_counts);
    }
    glEndQuery(GL_SAMPLES_PASSED);
    glDisable(GL_SCISSOR_TEST);
    lsf_ray_bundle_tally_build(pass);
    lsf_timer_end(pass->build_timer);
}

static void set_ray(const lsf_ray_bundle *pass, GLuint program,
                    const lsf_ray_bundle_origins *origins, const lsf_region *region)
{
    glUseProgram(program);
    if (pass->use.deep_vertices)
        glUniform1i(0, origins->from_position);
    lsf_region_set(region);
}

/* Chained nodes, and hits on surfaces that coincide: few. */
static void search_rest(const lsf_ray_bundle *pass, const lsf_ray_bundle_origins *origins,
                        const lsf_region *region)
{
    /* The search has drawn to the texture that is now stored to. */
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glBindImageTexture(0, pass->hits, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RG32UI);
    set_ray(pass, pass->rest_program, origins, region);
    glDispatchCompute(LSF_BUNDLE_REST_GROUPS, 1, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                    GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

GLuint lsf_ray_bundle_search(lsf_ray_bundle *pass, const lsf_iteration *iteration, uint32_t bundle,
                             const lsf_ray_bundle_origins *origins, const lsf_region *region)
{
    static const GLuint zero = 0;
    lsf_timer_begin(pass->search_timer);
    bind_nodes(pass, bundle);
    lsf_ray_bundle_nodes_bind_textures(&pass->slots[bundle % pass->use.slots]);
    lsf_begin_fullscreen(pass->hits_framebuffer, iteration->grid.width, iteration->grid.height,
                         pass->search_program);
    lsf_bind_texture(0, origins->depth);
    lsf_bind_texture(1, origins->surface);
    lsf_bind_texture(2, origins->position);
    lsf_bind_texture(LSF_UNIT_POSITION_PIXELS, origins->pixels);
    glClearNamedBufferSubData(pass->rest, GL_R32UI, 0, 4, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_REST, pass->rest);
    set_ray(pass, pass->search_program, origins, region);
    glUniform2f(1, (float)region->width, (float)region->height);
    lsf_draw_fullscreen(pass->context);
    search_rest(pass, origins, region);
    lsf_timer_end(pass->search_timer);
    return pass->hits;
}

void lsf_ray_bundle_timers(const lsf_ray_bundle *pass, lsf_timer *timers[3])
{
    timers[0] = pass->bounds_timer;
    timers[1] = pass->build_timer;
    timers[2] = pass->search_timer;
}

const uint64_t *lsf_ray_bundle_counts(const lsf_ray_bundle *pass)
{
    return pass->counts;
}

void lsf_ray_bundle_destroy(lsf_ray_bundle *pass)
{
    if (!pass)
        return;
    lsf_ray_bundle_nodes_destroy(pass);
    lsf_ray_bundle_raster_destroy(pass);
    lsf_ray_bundle_tally_destroy(pass);
    lsf_buffer_destroy(pass->context, &pass->projection_buffer);
    lsf_buffer_destroy(pass->context, &pass->rest);
    lsf_texture_destroy(pass->context, &pass->tiles);
    lsf_texture_destroy(pass->context, &pass->hits);
    lsf_framebuffer_destroy(pass->context, &pass->tiles_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->build_framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->hits_framebuffer);
    lsf_timer_destroy(pass->bounds_timer);
    lsf_timer_destroy(pass->build_timer);
    lsf_timer_destroy(pass->search_timer);
    free(pass->projections);
    free(pass);
}
