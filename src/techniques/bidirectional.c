/* Bidirectional path tracing by rasterisation: light paths by reflective shadow maps and virtual
 * point lights, camera paths by ray-bundles, joined by multiple importance sampling.
 * Y. Tokuyoshi and S. Ogaki, "Real-Time Bidirectional Path Tracing via Rasterization", I3D 2012.
 * docs/bidirectional.md has the derivation. */
#include <math.h>
#include <stdlib.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "passes/bidirectional_shade.h"
#include "passes/compose.h"
#include "passes/ray_bundle.h"
#include "passes/reflective_shadow_map.h"
#include "passes/vpl.h"
#include "scene/environment.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"
#include "techniques/bidirectional_sampling.h"
#include "techniques/bundle_directions.h"
#include "techniques/light_picks.h"
#include "techniques/sparse_chain.h"
#include "techniques/specular_path_chain.h"

typedef struct bidirectional {
    lsf_context *context;
    lsf_bidirectional_sampling sampling;
    lsf_voxel_chain chain; /* without voxels, unless paths go through them */
    lsf_specular_path paths;
    lsf_reflective_shadow_map rsm;
    lsf_vpl vpl;
    lsf_ray_bundle *bundle;         /* NULL: no bundles */
    lsf_ray_bundle_direction *aims; /* bundle_count of them */
    lsf_bundle_directions directions;
    GLuint bundle_pdf; /* 0: uniform */
    lsf_bidirectional_shade shade;
    lsf_sparse_chain sparse;
    lsf_compose compose;
    lsf_emitters emitters; /* empty unless they shine as VPLs */
    lsf_light_picks light_picks;
    uint32_t *lights; /* that each sample of the iteration takes */
    lsf_bidirectional_shade_params shade_params;
} bidirectional;

/* The samples of an iteration: a VPL of each kind, a path along bundles, or some of these. */
static uint32_t sample_count(const lsf_bidirectional_sampling *s)
{
    uint32_t count = s->vpl_count > s->bundle_count ? s->vpl_count : s->bundle_count;
    return count > s->emitter_count ? count : s->emitter_count;
}

static bool create_emitters(bidirectional *b, const lsf_scene *scene, const lsf_state *state,
                            lsf_error *error)
{
    return lsf_emitters_init(&b->emitters, scene, state) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for the scene's %llu triangles",
                         (unsigned long long)scene->requirements.triangles);
}

/* Makes the directions of bundles anew from the current environment. */
static bool aim_bundles(bidirectional *b, const lsf_ray_bundle_params *params,
                        const lsf_scene *scene, lsf_error *error)
{
    lsf_bundle_directions_finish(&b->directions);
    if (!lsf_bundle_directions_init(&b->directions, &scene->environment, params->environment_offset,
                                    error))
        return false;
    if (b->bundle_pdf)
        glTextureSubImage2D(b->bundle_pdf, 0, 0, 0, (GLsizei)b->directions.width,
                            (GLsizei)b->directions.height, GL_RED, GL_FLOAT, b->directions.pdf);
    return true;
}

static bool create_bundles(bidirectional *b, lsf_context *context, const lsf_plan *plan,
                           const lsf_pass_params *params, const lsf_scene *scene, lsf_error *error)
{
    lsf_ray_bundle_use use = lsf_bidirectional_bundle_use(&b->sampling);
    b->aims = lsf_alloc(b->sampling.bundle_count, sizeof *b->aims);
    if (!b->aims)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u ray-bundles",
                             b->sampling.bundle_count);
    return lsf_plan_create_texture_if_planned(plan, context, "bundle.pdf", &b->bundle_pdf, error) &&
           aim_bundles(b, &params->ray_bundle, scene, error) &&
           lsf_ray_bundle_create(&b->bundle, context, plan, &params->ray_bundle, &use, error);
}

static bool create_chain(bidirectional *b, lsf_context *context, const lsf_plan *plan,
                         const lsf_pass_params *params, const lsf_scene_gpu *scene,
                         const lsf_state *state, lsf_error *error)
{
    lsf_voxel_chain_use voxels = lsf_specular_path_chain_voxels(plan, params, state);
    return b->sampling.specular_paths ? lsf_voxel_chain_create(&b->chain, context, plan, params,
                                                               scene, state, &voxels, error)
                                      : lsf_direct_chain_create(&b->chain.direct, context, plan,
                                                                params, scene, NULL, error);
}

static bool create_bidirectional(void **self, lsf_context *context, const lsf_plan *plan,
                                 const lsf_pass_params *params, const lsf_scene_gpu *scene,
                                 const lsf_state *state, lsf_error *error)
{
    bidirectional *b = *self = lsf_alloc(1, sizeof *b);
    if (!b)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    b->context = context;
    lsf_bidirectional_sampling s = b->sampling =
        lsf_bidirectional_sampling_choose(plan, params, state);
    lsf_vpl_params vpl = lsf_bidirectional_vpl_params(params, &s);
    b->shade_params = params->bidirectional_shade;
    uint32_t draws = sample_count(&s);
    b->lights = lsf_alloc(draws, sizeof *b->lights);
    if (!b->lights)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u samples", draws);
    return create_chain(b, context, plan, params, scene, state, error) &&
           ((!s.vpl_light && !s.bundle_light) ||
            (lsf_light_picks_init(&b->light_picks, plan, scene->scene, state,
                                  plan->sky_lights > 0 && plan->requirements.environment_map,
                                  error) &&
             lsf_reflective_shadow_map_create(&b->rsm, context, plan, error))) &&
           (!s.vpl_emitter || create_emitters(b, scene->scene, state, error)) &&
           (vpl.count == 0 || lsf_vpl_create(&b->vpl, context, plan, &vpl, error)) &&
           (s.segments == 0 || create_bundles(b, context, plan, params, scene->scene, error)) &&
           (!lsf_plan_find(plan, "bidirectional_shade.irradiance") ||
            (lsf_bidirectional_shade_create(&b->shade, context, plan, &params->bidirectional_shade,
                                            error) &&
             lsf_sparse_chain_create(&b->sparse, context, plan, params, error))) &&
           (!s.specular_paths ||
            lsf_specular_path_create(&b->paths, context, plan, &params->specular_path, 1,
                                     &(lsf_specular_path_targets){b->shade.outputs.light.specular,
                                                                  b->shade.outputs.direct.specular},
                                     scene->scene, state, error)) &&
           lsf_compose_create(&b->compose, context, plan, error);
}

static lsf_update update_bidirectional(void *self, const lsf_pass_params *params,
                                       const lsf_iteration *iteration, const lsf_changes *changes)
{
    bidirectional *b = self;
    if (changes->environment && b->aims &&
        !aim_bundles(b, &params->ray_bundle, iteration->scene->scene, NULL))
        return LSF_UPDATE_FAILED;
    if (changes->lights && b->light_picks.weights)
        lsf_light_picks_update(&b->light_picks, iteration->plan, iteration->scene->scene,
                               iteration->state);
    bool emitters = b->sampling.vpl_emitter && (changes->moved || changes->materials);
    if (emitters && !lsf_emitters_update(&b->emitters, changes->materials))
        return LSF_UPDATE_FAILED;
    if ((changes->moved || changes->materials) &&
        !lsf_specular_path_follow(&b->paths, changes->materials))
        return LSF_UPDATE_FAILED;
    lsf_voxel_chain_use voxels =
        lsf_specular_path_chain_voxels(iteration->plan, params, iteration->state);
    return lsf_voxel_chain_update(&b->chain, params, iteration, &voxels, changes);
}

/* Each sample takes the light of one punctual light. A path beyond the VPLs goes with one of
 * theirs, so that a VPL of its light is there. */
static void pick_lights(bidirectional *b, const lsf_iteration *iteration, uint32_t count)
{
    uint32_t picked = b->sampling.vpl_count > 0 ? b->sampling.vpl_count : count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits[2];
        lsf_iteration_sample(iteration, iteration->index * picked + i, LSF_PURPOSE_VPL_LIGHT, bits);
        b->lights[i] = i < picked
                           ? (uint32_t)lsf_distribution_sample(&b->light_picks.distribution,
                                                               lsf_unit_double(bits[0]), NULL)
                           : b->lights[i % picked];
    }
}

/* How many of `count` samples, dealt out in turn, fall to a tile. */
static float dealt(uint32_t count, uint32_t tiles, uint32_t tile)
{
    return (float)(count / tiles + (tile < count % tiles));
}

/* The number of tiles whose samples a filter pools. */
static float tiles_pooled(const bidirectional *b, const lsf_iteration *iteration)
{
    return iteration->plan->filtered ? (float)b->sampling.tiles : 1.0f;
}

/* Iterations that suppression may count on; 0: it is off. A filter shares the samples of a
 * pattern's tiles, as if each tile had as many more. */
static float suppressed_iterations(const bidirectional *b, const lsf_iteration *iteration)
{
    if (b->shade_params.suppression == LSF_GLOSSY_SUPPRESSION_NONE)
        return 0.0f;
    return tiles_pooled(b, iteration) * lsf_iteration_expected(iteration);
}

/* Solid angle of as many samples as suppression spreads a lobe over, were they uniform over the
 * half sphere [sr]. */
static float suppressed_angle(const bidirectional *b, const lsf_iteration *iteration)
{
    const lsf_bidirectional_sampling *s = &b->sampling;
    float samples = suppressed_iterations(b, iteration) *
                    (float)(s->vpl_count + s->emitter_count + s->bundle_count) / (float)s->tiles;
    return samples > 0.0f ? 2.0f * LSF_PI * b->shade_params.kernel_samples / samples : 0.0f;
}

static float light_probability(const bidirectional *b, uint32_t light)
{
    return (float)lsf_distribution_probability(&b->light_picks.distribution, light);
}

/* The number of bundles that may find the environment at a visible point, and at a vertex beyond
 * it. */
static float sky_bundles(const lsf_bidirectional_sampling *s, bool deep)
{
    if (deep)
        return s->segments > 1 ? 1.0f : 0.0f;
    return s->emission && !s->sky_by_maps ? (float)s->bundle_count / (float)s->tiles : 0.0f;
}

/* The share that is left to a light that stands for the environment, which light paths find as
 * well as bundles. Deep vertices have one light each, as `light_picks` says. */
static void share_sky(bidirectional *b, const lsf_iteration *iteration)
{
    const lsf_bidirectional_sampling *s = &b->sampling;
    float iterations = suppressed_iterations(b, iteration) / tiles_pooled(b, iteration);
    for (uint32_t i = iteration->state->light_count; i < iteration->light_count; i++) {
        lsf_sky_share *share = &iteration->shares[i];
        lsf_float3 direction = lsf_f3_scale(lsf_f3_load(iteration->lights[i].direction), -1.0f);
        float p_r = lsf_bundle_directions_pdf(&b->directions, direction);
        float straight = share->density + sky_bundles(s, false) * p_r;
        float bounced =
            b->light_picks.sky_probability * share->density / (float)iteration->plan->sky_lights;
        if (straight > 0.0f)
            share->shares[LSF_LIGHT_STRAIGHT] = share->density / straight;
        if (bounced > 0.0f)
            share->shares[LSF_LIGHT_BOUNCED] = bounced / (bounced + sky_bundles(s, true) * p_r);
        share->kernel = iterations * straight > 0.0f
                            ? b->shade_params.kernel_samples / (iterations * straight)
                            : 0.0f;
    }
}

/* The same for a bundle: its densities in both senses, for each path of a pixel. */
static void share_bundle(const bidirectional *b, const lsf_iteration *iteration, uint32_t bundle,
                         bool deep, lsf_bidirectional_sample *sample)
{
    float p_r = b->aims[bundle].pdf, count = sky_bundles(&b->sampling, deep);
    sample->bundle_pdf = p_r;
    for (int side = 0; side < 2 && iteration->plan->sky_lights > 0; side++) {
        lsf_float3 direction =
            lsf_f3_scale(lsf_f3_load(b->aims[bundle].direction), side ? -1.0f : 1.0f);
        float drawn = lsf_sky_density(
            &iteration->sky, lsf_environment_radiance(iteration->sky.environment, direction));
        if (deep)
            sample->sky_pdf[side] = b->light_picks.sky_probability * drawn;
        else
            sample->sky_pdf[side] =
                count > 0.0f ? (float)iteration->plan->sky_lights * drawn / count : INFINITY;
    }
}

/* One sample: a VPL of each kind, and a path along bundles that begins with one of the same number.
 */
typedef struct sample_work {
    bidirectional *b;
    const lsf_iteration *iteration;
    lsf_bidirectional_shade_inputs inputs;
    lsf_region region;
    float tile_vpls, tile_bundles; /* for each pixel of the region; VPLs of each kind */
    float iterations;
    uint32_t vpl, emitter; /* the VPLs whose maps are current; LSF_NONE: there is none */
    float light_probability;
} sample_work;

static void connect_vpl(sample_work *work, bool deep, uint32_t vpl,
                        const lsf_bidirectional_sample *sample)
{
    bidirectional *b = work->b;
    lsf_bidirectional_shade_inputs inputs = work->inputs;
    const lsf_shadow shadow = lsf_vpl_shadow(&b->vpl, vpl);
    inputs.bundle_pdf = b->bundle_pdf;
    inputs.shadow = &shadow;
    inputs.vpls = b->vpl.outputs.fetch;
    lsf_bidirectional_shade_vpl(&b->shade, work->iteration, &inputs, sample, deep, vpl,
                                &work->region);
}

/* Joins visible points to the VPL of either kind. */
static void connect_visible(sample_work *work, bool emitter)
{
    const lsf_bidirectional_sampling *s = &work->b->sampling;
    bool shared = emitter ? s->bundle_emitter : s->bundle_light;
    lsf_bidirectional_sample sample = {.vpl_count = work->tile_vpls,
                                       .bundle_count = shared ? work->tile_bundles : 0.0f,
                                       .weight = 1.0f / work->tile_vpls,
                                       .iterations = work->iterations,
                                       .light_probability = work->light_probability,
                                       .emitter = emitter};
    connect_vpl(work, false, emitter ? work->emitter : work->vpl, &sample);
}

/* A VPL found with the density a by area stands for 1 / (n a) of it, n being those that a pixel's
 * vertices are joined to over all iterations. No disc of that area can shed more than as many times
 * its radiance as there are in the half sphere above, pi: its 1/d^2 is held where d is the disc's
 * radius. */
static float bound(const sample_work *work, float vertices)
{
    float radii = work->b->shade_params.bound;
    return radii * radii / (LSF_PI * vertices * lsf_iteration_expected(work->iteration));
}

/* Joins the vertices that the segment found to the VPL of either kind. */
static void connect_deep(sample_work *work, lsf_bidirectional_sample sample, uint32_t segment,
                         bool emitter)
{
    const lsf_bidirectional_sampling *s = &work->b->sampling;
    uint32_t vpl = emitter ? work->emitter : work->vpl;
    uint32_t bounces = emitter ? segment : segment + 1;
    if (vpl == LSF_NONE || bounces > s->bounces)
        return;
    /* Where no further bundle competes, only a bound limits the connection's 1/d^2. */
    bool shared = emitter ? s->bundle_emitter : s->bundle_light;
    bool alone = !shared || segment == s->segments;
    sample.bundle_count = alone ? 0.0f : 1.0f;
    sample.bound = alone ? bound(work, sample.path_count) : 0.0f;
    sample.emitter = emitter;
    connect_vpl(work, true, vpl, &sample);
}

/* One bundle's length of a path: from visible points (segment 1) or from the hits before. */
static void trace_segment(sample_work *work, uint32_t first, uint32_t segment, uint32_t light)
{
    bidirectional *b = work->b;
    const lsf_bidirectional_sampling *s = &b->sampling;
    bool deep = segment > 1;
    uint32_t bundle = (first + segment - 1) % s->bundle_count;
    uint32_t before = (first + segment + s->bundle_count - 2) % s->bundle_count;
    bool lit = s->bundle_light && segment <= s->bounces;
    lsf_bidirectional_shade_inputs inputs = work->inputs;
    lsf_ray_bundle_origins origins = {.from_position = deep,
                                      .depth = inputs.seen->depth,
                                      .pixels = inputs.seen->pixels,
                                      .position = b->shade.outputs.position,
                                      .surface =
                                          deep ? b->shade.outputs.surface : inputs.seen->surface};
    inputs.hits =
        lsf_ray_bundle_search(b->bundle, work->iteration, bundle, &origins, &work->region);
    /* Beyond the visible point each path is joined to one VPL. */
    lsf_bidirectional_sample sample = {
        .vpl_count = !s->vpl_light && !s->vpl_emitter ? 0.0f
                     : deep                           ? 1.0f
                                                      : work->tile_vpls,
        .bundle_count = deep ? 1.0f : work->tile_bundles,
        .weight = 1.0f / work->tile_bundles,
        .path_count = work->tile_bundles,
        .iterations = work->iterations,
        .light_probability = lit ? light_probability(b, light) : 1.0f,
        .emitter_weight = s->vpl_emitter ? lsf_emitters_weight(&b->emitters) : 0.0f,
        .arrival = b->aims[before].direction,
        .arrival_pdf = b->aims[before].pdf};
    if (s->vpl_emitter && !s->bundle_emitter)
        sample.bundle_count = 0.0f; /* nor do they share the light of punctual ones */
    inputs.bundle_pdf = b->bundle_pdf;
    share_bundle(b, work->iteration, bundle, deep, &sample);
    inputs.shadow = &b->rsm.outputs.shadow;
    inputs.importance = b->rsm.outputs.importance;
    inputs.nodes = lsf_ray_bundle_nodes(b->bundle, bundle);
    lsf_bidirectional_shade_hit(&b->shade, work->iteration, &inputs, &sample, deep, s->emission,
                                lit, &work->region);
    sample.arrival = b->aims[bundle].direction;
    sample.arrival_pdf = b->aims[bundle].pdf;
    sample.light_probability = work->light_probability;
    connect_deep(work, sample, segment, false);
    connect_deep(work, sample, segment, true);
}

static void place_on_emitter(sample_work *work, uint32_t i)
{
    bidirectional *b = work->b;
    uint32_t bits[2];
    lsf_iteration_sample_dealt(work->iteration, i, b->sampling.emitter_count,
                               LSF_PURPOSE_VPL_EMITTER, bits);
    const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
    lsf_emitter_sample sample = lsf_emitters_sample(&b->emitters, u);
    work->emitter = b->vpl.first_emitter + i;
    lsf_vpl_emit(&b->vpl, work->iteration, work->emitter, &sample);
}

static void run_sample(sample_work *work, uint32_t i, uint32_t light)
{
    bidirectional *b = work->b;
    const lsf_bidirectional_sampling *s = &b->sampling;
    uint32_t slot = i % s->tiles;
    work->region = lsf_sparse_region(&work->iteration->grid, s->interleave, slot);
    work->tile_vpls = dealt(s->vpl_light ? s->vpl_count : s->emitter_count, s->tiles, slot);
    work->tile_bundles = dealt(s->bundle_count, s->tiles, slot);
    if (i < s->vpl_count) {
        work->vpl = i;
        work->light_probability = light_probability(b, light);
        lsf_vpl_shadow_map(&b->vpl, work->iteration, i);
        connect_visible(work, false);
    }
    if (i < s->emitter_count && b->emitters.power.sum > 0.0) {
        place_on_emitter(work, i);
        lsf_vpl_shadow_map(&b->vpl, work->iteration, work->emitter);
        connect_visible(work, true);
    }
    if (i >= s->bundle_count)
        return;
    if (s->segments == 1)
        lsf_ray_bundle_build(b->bundle, work->iteration, i);
    for (uint32_t segment = 1; segment <= s->segments; segment++)
        trace_segment(work, i, segment, light);
}

/* The samples of one light: its reflective shadow map, then each VPL and path. */
static void run_light(sample_work *work, uint32_t light, uint32_t count)
{
    bidirectional *b = work->b;
    uint32_t first = 0;
    while (first < count && b->lights[first] != light)
        first++;
    if (first == count)
        return;
    lsf_reflective_shadow_map_run(&b->rsm, work->iteration, light,
                                  &b->chain.direct.gbuffer.outputs.seen);
    const lsf_vpl_inputs map = {.shadow = &b->rsm.outputs.shadow,
                                .seen = &b->rsm.outputs.seen,
                                .importance = b->rsm.outputs.importance,
                                .sums = b->rsm.outputs.sums};
    for (uint32_t i = first; i < count && lsf_iteration_goes_on(work->iteration); i++) {
        if (b->lights[i] != light)
            continue;
        if (i < b->sampling.vpl_count)
            lsf_vpl_draw(&b->vpl, work->iteration, i, 1, light_probability(b, light), &map);
        run_sample(work, i, light);
    }
}

static void run_samples(bidirectional *b, const lsf_iteration *iteration,
                        const lsf_bidirectional_shade_inputs *inputs)
{
    const lsf_bidirectional_sampling *s = &b->sampling;
    uint32_t count = sample_count(s);
    sample_work work = {.b = b,
                        .iteration = iteration,
                        .inputs = *inputs,
                        .iterations = suppressed_iterations(b, iteration),
                        .vpl = LSF_NONE,
                        .emitter = LSF_NONE,
                        .light_probability = 1.0f};
    lsf_bidirectional_shade_clear(&b->shade);
    if (s->segments > 0) {
        lsf_bundle_directions_draw(&b->directions, iteration, s->bundle_count, s->segments > 1,
                                   b->aims);
        lsf_ray_bundle_aim(b->bundle, iteration, b->aims,
                           b->chain.direct.gbuffer.outputs.seen.depth);
    }
    for (uint32_t i = 0; s->segments > 1 && i < s->bundle_count && lsf_iteration_goes_on(iteration);
         i++)
        lsf_ray_bundle_build(b->bundle, iteration, i);
    if (s->vpl_light || s->bundle_light) {
        lsf_light_picks_follow(&b->light_picks, iteration->state->light_count,
                               lsf_light_importance_read(&b->chain.direct.importance, iteration));
        pick_lights(b, iteration, count);
        for (uint32_t light = 0; light < iteration->light_count && lsf_iteration_goes_on(iteration);
             light++)
            run_light(&work, light, count);
    } else {
        for (uint32_t i = 0; i < count && lsf_iteration_goes_on(iteration); i++)
            run_sample(&work, i, LSF_NONE);
    }
}

static void run_bidirectional(void *self, const lsf_iteration *iteration,
                              lsf_technique_outputs *outputs)
{
    bidirectional *b = self;
    const lsf_gbuffer_maps *gbuffer = &b->chain.direct.gbuffer.outputs;
    const lsf_split_light *light = &b->shade.outputs.light;
    share_sky(b, iteration);
    b->chain.direct.gbuffer.lobe_angle = suppressed_angle(b, iteration);
    if (b->sampling.specular_paths)
        lsf_voxel_chain_run(&b->chain, iteration);
    else
        lsf_direct_chain_run(&b->chain.direct, iteration);
    lsf_light_parts parts = lsf_direct_chain_parts(&b->chain.direct);
    if (light->irradiance) {
        lsf_bidirectional_shade_inputs inputs = {
            .seen = lsf_sparse_chain_split(&b->sparse, iteration, &gbuffer->seen)};
        b->shade.lobe_kernel = b->paths.lobe_kernel = suppressed_angle(b, iteration);
        run_samples(b, iteration, &inputs);
        if (b->sampling.specular_paths) {
            const lsf_path_inputs paths = lsf_voxel_chain_paths(&b->chain, inputs.seen);
            lsf_specular_path_run(&b->paths, iteration, &paths);
        }
        parts.indirect = lsf_sparse_chain_finish(&b->sparse, iteration, &gbuffer->seen, light);
    }
    if (b->bundle)
        lsf_ray_bundle_end(b->bundle, iteration);
    parts.split_direct = b->shade.outputs.direct;
    lsf_compose_run(&b->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){
        .parts = parts,
        .layers = b->compose.outputs,
        .bounded = b->shade_params.bound > 0.0f,
        .kernel = b->shade.lobes ? 0.0f : suppressed_angle(b, iteration),
        .gate = b->bundle ? lsf_ray_bundle_gate(b->bundle) : 0,
    };
}

static bool settle_bidirectional(void *self, const lsf_iteration *iteration, bool wait,
                                 uint32_t *iterations_done)
{
    bidirectional *b = self;
    return !b->bundle || lsf_ray_bundle_settle(b->bundle, iteration, wait, iterations_done);
}

static void destroy_bidirectional(void *self)
{
    bidirectional *b = self;
    if (!b)
        return;
    lsf_compose_destroy(&b->compose);
    lsf_sparse_chain_destroy(&b->sparse);
    lsf_bidirectional_shade_destroy(&b->shade);
    lsf_ray_bundle_destroy(b->bundle);
    if (b->bundle_pdf)
        lsf_texture_destroy(b->context, &b->bundle_pdf);
    lsf_bundle_directions_finish(&b->directions);
    lsf_vpl_destroy(&b->vpl);
    lsf_reflective_shadow_map_destroy(&b->rsm);
    lsf_specular_path_destroy(&b->paths);
    lsf_voxel_chain_destroy(&b->chain);
    lsf_light_picks_finish(&b->light_picks);
    lsf_emitters_finish(&b->emitters);
    free(b->lights);
    free(b->aims);
    free(b);
}

static uint32_t report_bidirectional(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    bidirectional *b = self;
    uint32_t count = lsf_voxel_chain_report(&b->chain, reports);
    lsf_timer *bundle_timers[3] = {NULL};
    if (b->bundle)
        lsf_ray_bundle_timers(b->bundle, bundle_timers);
    const lsf_pass_report candidates[] = {
        {b->rsm.timer, LSF_DRAW_COUNTS, lsf_draw_count_names, b->rsm.counts},
        {.timer = b->rsm.pdf_timer},
        {.timer = b->vpl.draw_timer},
        {.timer = b->vpl.emitter_timer},
        {b->vpl.map_timer, LSF_DRAW_COUNTS, lsf_draw_count_names, b->vpl.counts},
        {.timer = bundle_timers[0]},
        {bundle_timers[1], LSF_RAY_BUNDLE_COUNTS, lsf_ray_bundle_count_names,
         b->bundle ? lsf_ray_bundle_counts(b->bundle) : NULL},
        {.timer = bundle_timers[2]},
        {.timer = b->shade.vpl_timer},
        {.timer = b->shade.hit_timer},
        {.timer = b->paths.timer},
    };
    count += lsf_sparse_chain_report_split(&b->sparse, reports + count);
    for (size_t i = 0; i < LSF_COUNT(candidates); i++)
        if (candidates[i].timer)
            reports[count++] = candidates[i];
    count += lsf_sparse_chain_report_finish(&b->sparse, reports + count);
    reports[count++] = (lsf_pass_report){.timer = b->compose.timer};
    return count;
}

static const char *const groups[] = {
    "rsm", "vpl", "bundle", "bidirectional", "mis", "specular_path", "voxel", "sparse", NULL};

const lsf_technique lsf_technique_bidirectional = {
    .name = "bidirectional",
    .help = "global illumination by ray-bundles and virtual point lights, combined by MIS",
    .groups = groups,
    .bounces = true,
    .maps_scene = true,
    .points_per_second = 0x1p17f, /* a point took 10 us of a core, most of it for specular paths */
    .voxels_in_a_second = 48,
    .plan = lsf_bidirectional_plan,
    .create = create_bidirectional,
    .update = update_bidirectional,
    .run = run_bidirectional,
    .settle = settle_bidirectional,
    .destroy = destroy_bidirectional,
    .report = report_bidirectional,
};
