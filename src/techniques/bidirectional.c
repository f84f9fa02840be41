/* Bidirectional path tracing by rasterisation: light paths by reflective shadow maps and virtual
 * point lights, camera paths by ray-bundles, joined by multiple importance sampling.
 * Y. Tokuyoshi and S. Ogaki, "Real-Time Bidirectional Path Tracing via Rasterization", I3D 2012.
 * docs/bidirectional.md has the derivation. */
#include <stdlib.h>

#include "base/base.h"
#include "math/distribution.h"
#include "math/sampling.h"
#include "passes/bidirectional_shade.h"
#include "passes/compose.h"
#include "passes/interleave.h"
#include "passes/ray_bundle.h"
#include "passes/reflective_shadow_map.h"
#include "passes/vpl.h"
#include "shared/scene_data.h"
#include "techniques/bundle_directions.h"
#include "techniques/direct_chain.h"

/* Random numbers that pick the light of each sample. */
#define PURPOSE_LIGHT 0x40000

/* How samples are spent, decided from the scene and the options. */
typedef struct sampling {
    uint32_t bounces; /* that light of punctual lights takes */
    uint32_t vpl_count, bundle_count;
    uint32_t segments; /* bundles along a path */
    uint32_t vertices; /* of these, whose hits become vertices */
    bool vpl_light;    /* punctual lights shine by VPLs */
    bool bundle_light; /* and by the hits of bundles */
    bool emission;     /* surfaces or the environment shine into bundles */
    bool whole_scene;
    bool split_direct;
    uint32_t interleave, tiles;
} sampling;

typedef struct bidirectional {
    lsf_context *context;
    sampling sampling;
    lsf_direct_chain chain;
    lsf_reflective_shadow_map rsm;
    lsf_vpl vpl;
    lsf_ray_bundle *bundle;         /* NULL: no bundles */
    lsf_ray_bundle_direction *aims; /* bundle_count of them */
    lsf_bundle_directions directions;
    GLuint bundle_pdf; /* 0: uniform */
    lsf_bidirectional_shade shade;
    lsf_interleave interleave;
    lsf_compose compose;
    lsf_distribution light_power;
    uint32_t *lights; /* that each sample of the iteration takes */
    lsf_bidirectional_shade_params shade_params;
} bidirectional;

static uint32_t max_u32(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static bool punctual_light_shines(const lsf_state *state)
{
    for (uint32_t i = 0; i < state->light_count; i++)
        if (lsf_light_power(&state->lights[i]) > 0.0f)
            return true;
    return false;
}

static sampling choose_sampling(const lsf_plan *plan, const lsf_pass_params *params,
                                const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    int strategy = params->bidirectional_shade.strategy;
    int window = params->ray_bundle.window;
    bool punctual = punctual_light_shines(state) && plan->bounces > 0;
    sampling s = {.bounces = plan->bounces,
                  .vpl_count = (uint32_t)params->vpl.count,
                  .bundle_count = (uint32_t)params->ray_bundle.count,
                  .emission = r->emissive || r->unlit || r->environment,
                  .interleave = (uint32_t)params->interleave.size,
                  .tiles = (uint32_t)(params->interleave.size * params->interleave.size)};
    s.vpl_light = punctual && strategy != LSF_BIDIRECTIONAL_BUNDLE && s.vpl_count > 0;
    s.bundle_light = punctual && strategy != LSF_BIDIRECTIONAL_VPL;
    if (s.emission)
        s.segments = plan->bounces + 1;
    else if (s.bundle_light)
        s.segments = plan->bounces;
    else if (s.vpl_light)
        s.segments = plan->bounces - 1;
    s.whole_scene = window == LSF_RAY_BUNDLE_WINDOW_SCENE ||
                    (window == LSF_RAY_BUNDLE_WINDOW_AUTO && s.segments > 1);
    if (!s.whole_scene && s.segments > 1)
        s.segments = 1;
    if (!s.vpl_light)
        s.vpl_count = 0;
    if (s.segments > 0)
        s.vertices = s.vpl_light && s.bounces > s.segments ? s.segments : s.segments - 1;
    if (s.segments == 0)
        s.bundle_count = 0;
    else
        s.bundle_count = max_u32(s.bundle_count, max_u32(s.segments, s.tiles));
    if (s.vpl_light)
        s.vpl_count = max_u32(s.vpl_count, s.tiles);
    if (!s.vpl_light && s.segments == 0)
        s.interleave = s.tiles = 1;
    s.split_direct =
        s.emission && s.interleave == 1 &&
        (plan->aovs & (LSF_AOV_DIRECT | LSF_AOV_INDIRECT_DIFFUSE | LSF_AOV_INDIRECT_SPECULAR));
    return s;
}

static lsf_ray_bundle_use bundle_use(const sampling *s)
{
    return (lsf_ray_bundle_use){.count = s->bundle_count,
                                .slots = s->segments > 1 ? s->bundle_count : 1,
                                .whole_scene = s->whole_scene,
                                .interleave = s->interleave,
                                .deep_vertices = s->segments > 1};
}

static lsf_vpl_params vpl_params(const lsf_pass_params *params, const sampling *s)
{
    lsf_vpl_params vpl = params->vpl;
    vpl.count = (int32_t)s->vpl_count;
    return vpl;
}

static void remark(lsf_plan *plan, const lsf_pass_params *params, const sampling *s)
{
    const lsf_requirements *r = &plan->requirements;
    if (r->transmissive)
        lsf_plan_remark(plan, "transmission is read, but shaded as opaque");
    if (s->bundle_count > (uint32_t)params->ray_bundle.count)
        lsf_plan_remark(plan,
                        "%u bundles an iteration instead of %d: paths of %u segments need as many "
                        "independent directions, and each of %u tiles a sample",
                        s->bundle_count, params->ray_bundle.count, s->segments, s->tiles);
    if (s->vpl_light && s->vpl_count > (uint32_t)params->vpl.count)
        lsf_plan_remark(plan, "%u VPLs an iteration instead of %d: each of %u tiles needs one",
                        s->vpl_count, params->vpl.count, s->tiles);
    if (s->emission && s->interleave > 1)
        lsf_plan_remark(plan, "with interleave.size above 1, direct light of surfaces and "
                              "environments is in the indirect layers");
    if (!s->whole_scene && plan->bounces > 2)
        lsf_plan_remark(plan,
                        "bundle.window=visible ends paths after one bundle: %u bounces are "
                        "2 at most, and of light from surfaces and environments none",
                        plan->bounces);
    else if (!s->whole_scene && s->emission && plan->bounces > 0)
        lsf_plan_remark(plan, "bundle.window=visible ends paths after one bundle: light from "
                              "surfaces and environments does not bounce");
}

static void plan_bidirectional(lsf_plan *plan, const lsf_pass_params *params,
                               const lsf_state *state)
{
    sampling s = choose_sampling(plan, params, state);
    lsf_vpl_params vpl = vpl_params(params, &s);
    plan->random_samples = params->bidirectional_shade.sequence == LSF_BIDIRECTIONAL_RANDOM;
    lsf_direct_chain_plan(plan, params, state);
    if (s.interleave > 1)
        lsf_interleave_plan(plan, &params->interleave);
    else
        lsf_plan_omit(plan, "interleave", "%s",
                      params->interleave.size > 1 ? "no light bounces" : "interleave.size is 1");
    if (s.vpl_light || s.bundle_light)
        lsf_reflective_shadow_map_plan(plan, &params->reflective_shadow_map, state);
    else
        lsf_plan_omit(plan, "reflective_shadow_map", "no punctual light bounces");
    if (s.vpl_light)
        lsf_vpl_plan(plan, &vpl);
    else
        lsf_plan_omit(plan, "vpl",
                      s.bundle_light ? "bidirectional.strategy is bundle"
                                     : "no punctual light bounces");
    if (s.segments > 0) {
        lsf_ray_bundle_use use = bundle_use(&s);
        lsf_bundle_directions_plan(plan);
        lsf_ray_bundle_plan(plan, &params->ray_bundle, &use);
    } else {
        lsf_plan_omit(plan, "ray_bundle",
                      s.vpl_light ? "VPLs alone light visible points" : "no light bounces");
    }
    bool indirect = s.vpl_light || s.segments > 0;
    if (indirect) {
        lsf_bidirectional_shade_use use = {.segments = s.segments,
                                           .vertices = s.vertices,
                                           .vpl = s.vpl_light,
                                           .hit_light = s.bundle_light,
                                           .deep_vpl = s.segments > 0 && s.bounces > 1,
                                           .emission = s.emission,
                                           .split_direct = s.split_direct,
                                           .interleave = s.interleave};
        lsf_bidirectional_shade_plan(plan, &params->bidirectional_shade, &use);
    } else {
        lsf_plan_omit(plan, "bidirectional_shade", "no light bounces");
    }
    lsf_compose_plan(plan, &(lsf_compose_use){.direct = state->light_count > 0,
                                              .indirect = indirect,
                                              .split_direct = s.split_direct});
    remark(plan, params, &s);
}

static bool create_light_power(bidirectional *b, const lsf_state *state, lsf_error *error)
{
    float *weights = lsf_alloc(state->light_count, sizeof *weights);
    for (uint32_t i = 0; weights && i < state->light_count; i++)
        weights[i] = lsf_light_power(&state->lights[i]);
    bool good = weights && lsf_distribution_init(&b->light_power, weights, state->light_count);
    free(weights);
    return good || lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u lights",
                                 state->light_count);
}

static bool create_bundles(bidirectional *b, lsf_context *context, const lsf_plan *plan,
                           const lsf_pass_params *params, const lsf_scene *scene, lsf_error *error)
{
    lsf_ray_bundle_use use = bundle_use(&b->sampling);
    b->aims = lsf_alloc(b->sampling.bundle_count, sizeof *b->aims);
    if (!b->aims)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u ray-bundles",
                             b->sampling.bundle_count);
    if (!lsf_bundle_directions_init(&b->directions, &scene->environment,
                                    params->ray_bundle.environment_offset, error) ||
        !lsf_plan_create_texture(plan, context, "bundle.pdf", &b->bundle_pdf, error))
        return false;
    if (b->bundle_pdf)
        glTextureSubImage2D(b->bundle_pdf, 0, 0, 0, (GLsizei)b->directions.width,
                            (GLsizei)b->directions.height, GL_RED, GL_FLOAT, b->directions.pdf);
    return lsf_ray_bundle_create(&b->bundle, context, plan, &params->ray_bundle, &use, error);
}

static bool create_bidirectional(void **self, lsf_context *context, const lsf_plan *plan,
                                 const lsf_pass_params *params, const lsf_scene_gpu *scene,
                                 const lsf_state *state, lsf_error *error)
{
    bidirectional *b = *self = lsf_alloc(1, sizeof *b);
    if (!b)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    b->context = context;
    sampling s = b->sampling = choose_sampling(plan, params, state);
    lsf_vpl_params vpl = vpl_params(params, &s);
    b->shade_params = params->bidirectional_shade;
    uint32_t draws = max_u32(max_u32(s.vpl_count, s.bundle_count), 1);
    b->lights = lsf_alloc(draws, sizeof *b->lights);
    if (!b->lights)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u samples", draws);
    return lsf_direct_chain_create(&b->chain, context, plan, params, scene, error) &&
           ((!s.vpl_light && !s.bundle_light) ||
            (create_light_power(b, state, error) &&
             lsf_reflective_shadow_map_create(&b->rsm, context, plan, error))) &&
           (!s.vpl_light || lsf_vpl_create(&b->vpl, context, plan, &vpl, error)) &&
           (s.segments == 0 || create_bundles(b, context, plan, params, scene->scene, error)) &&
           (!lsf_plan_find(plan, "bidirectional_shade.irradiance") ||
            lsf_bidirectional_shade_create(&b->shade, context, plan, &params->bidirectional_shade,
                                           error)) &&
           (s.interleave == 1 ||
            lsf_interleave_create(&b->interleave, context, plan, &params->interleave, error)) &&
           lsf_compose_create(&b->compose, context, plan, error);
}

/* Each sample takes the light of one punctual light, picked by power. */
static void pick_lights(bidirectional *b, const lsf_iteration *iteration, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        uint32_t bits[2];
        lsf_iteration_sample(iteration, iteration->index * count + i, PURPOSE_LIGHT, bits);
        b->lights[i] =
            (uint32_t)lsf_distribution_sample(&b->light_power, lsf_unit_double(bits[0]), NULL);
    }
}

/* How many of `count` samples, dealt out in turn, fall to a tile. */
static float dealt(uint32_t count, uint32_t tiles, uint32_t tile)
{
    return (float)(count / tiles + (tile < count % tiles));
}

/* Iterations that suppression may count on. */
static float suppressed_iterations(const bidirectional *b, const lsf_iteration *iteration)
{
    if (b->shade_params.suppression == LSF_GLOSSY_SUPPRESSION_NONE)
        return 0.0f;
    uint32_t samples = iteration->plan->samples;
    return samples == UINT32_MAX ? (float)iteration->index + 1.0f : (float)samples;
}

/* One sample: a VPL, and a path along bundles that begins with one of the same number. */
typedef struct sample_turn {
    bidirectional *b;
    const lsf_iteration *iteration;
    lsf_bidirectional_shade_inputs inputs;
    lsf_region region;
    float tile_vpls, tile_bundles; /* that the region's pixels get */
    float iterations;
    uint32_t vpl; /* whose map is there */
    float vpl_probability;
} sample_turn;

static float light_probability(const bidirectional *b, uint32_t light)
{
    return (float)lsf_distribution_probability(&b->light_power, light);
}

static void connect_vpl(sample_turn *turn, bool deep, const lsf_bidirectional_sample *sample)
{
    bidirectional *b = turn->b;
    lsf_bidirectional_shade_inputs inputs = turn->inputs;
    inputs.bundle_pdf = b->bundle_pdf;
    lsf_vpl_bind(&b->vpl, turn->vpl);
    inputs.map_depth = b->vpl.outputs.shadow_map;
    inputs.map_gradient = 0; /* in the same texels */
    lsf_bidirectional_shade_vpl(&b->shade, turn->iteration, &inputs, sample, deep, turn->vpl,
                                &turn->region);
}

static void shade_by_vpl(sample_turn *turn)
{
    const sampling *s = &turn->b->sampling;
    lsf_bidirectional_sample sample = {.vpl_count = turn->tile_vpls,
                                       .bundle_count = s->bundle_light ? turn->tile_bundles : 0.0f,
                                       .weight = 1.0f / turn->tile_vpls,
                                       .iterations = turn->iterations,
                                       .light_probability = turn->vpl_probability};
    connect_vpl(turn, false, &sample);
}

/* One bundle's length of a path: from visible points (segment 1) or from the hits before. */
static void trace_segment(sample_turn *turn, uint32_t first, uint32_t segment, uint32_t light)
{
    bidirectional *b = turn->b;
    const sampling *s = &b->sampling;
    bool deep = segment > 1;
    uint32_t bundle = (first + segment - 1) % s->bundle_count;
    uint32_t before = (first + segment + s->bundle_count - 2) % s->bundle_count;
    bool lit = s->bundle_light && segment <= s->bounces;
    lsf_bidirectional_shade_inputs inputs = turn->inputs;
    lsf_ray_bundle_origins origins = {.depth = deep ? 0 : inputs.depth,
                                      .position = deep ? b->shade.outputs.position : 0,
                                      .surface = deep ? b->shade.outputs.surface : inputs.surface};
    inputs.hits =
        lsf_ray_bundle_search(b->bundle, turn->iteration, bundle, &origins, &turn->region);
    /* Beyond the visible point each path is joined to one VPL. */
    lsf_bidirectional_sample sample = {.vpl_count = !s->vpl_light ? 0.0f
                                                    : deep        ? 1.0f
                                                                  : turn->tile_vpls,
                                       .bundle_count = deep ? 1.0f : turn->tile_bundles,
                                       .weight = 1.0f / turn->tile_bundles,
                                       .path_count = turn->tile_bundles,
                                       .iterations = turn->iterations,
                                       .light_probability =
                                           lit ? light_probability(b, light) : 1.0f,
                                       .arrival = b->aims[before].direction,
                                       .arrival_pdf = b->aims[before].pdf};
    inputs.bundle_pdf = b->bundle_pdf;
    if (lit) {
        inputs.map_depth = b->rsm.outputs.depth;
        inputs.map_gradient = b->rsm.outputs.gradient;
        inputs.importance = b->rsm.outputs.importance;
        glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_LIGHT, b->rsm.outputs.light_buffer);
    }
    lsf_ray_bundle_bind(b->bundle, bundle);
    lsf_bidirectional_shade_hit(&b->shade, turn->iteration, &inputs, &sample, deep, s->emission,
                                lit, &turn->region);
    if (!s->vpl_light || segment + 1 > s->bounces)
        return;
    /* Where no further bundle competes, the connection's 1/d^2 has nothing against it but a bound.
     */
    bool alone = !s->bundle_light || segment == s->segments;
    sample.bundle_count = alone ? 0.0f : 1.0f;
    sample.clamp_distance = alone ? b->shade_params.clamp_distance : 0.0f;
    sample.light_probability = turn->vpl_probability;
    sample.arrival = b->aims[bundle].direction;
    sample.arrival_pdf = b->aims[bundle].pdf;
    connect_vpl(turn, true, &sample);
}

static void run_sample(sample_turn *turn, uint32_t i)
{
    bidirectional *b = turn->b;
    const sampling *s = &b->sampling;
    uint32_t tile = i % s->tiles;
    turn->region = lsf_interleave_region(turn->iteration->plan, s->interleave, tile);
    turn->tile_vpls = dealt(s->vpl_count, s->tiles, tile);
    turn->tile_bundles = dealt(s->bundle_count, s->tiles, tile);
    if (i < s->vpl_count) {
        turn->vpl = i;
        turn->vpl_probability = light_probability(b, b->lights[i]);
        lsf_vpl_shadow_map(&b->vpl, turn->iteration, i);
        shade_by_vpl(turn);
    }
    if (i >= s->bundle_count)
        return;
    if (s->segments == 1)
        lsf_ray_bundle_build(b->bundle, turn->iteration, i);
    for (uint32_t segment = 1; segment <= s->segments; segment++)
        trace_segment(turn, i, segment, b->lights[i]);
}

/* The samples of one light: its reflective shadow map, then each VPL and path. */
static void run_light(sample_turn *turn, uint32_t light, uint32_t count)
{
    bidirectional *b = turn->b;
    uint32_t first = 0;
    while (first < count && b->lights[first] != light)
        first++;
    if (first == count)
        return;
    lsf_reflective_shadow_map_run(&b->rsm, turn->iteration, light);
    const lsf_vpl_inputs map = {.depth = b->rsm.outputs.depth,
                                .surface = b->rsm.outputs.surface,
                                .gloss = b->rsm.outputs.gloss,
                                .light_buffer = b->rsm.outputs.light_buffer,
                                .importance = b->rsm.outputs.importance,
                                .sums = b->rsm.outputs.sums};
    for (uint32_t i = first; i < count; i++) {
        if (b->lights[i] != light)
            continue;
        if (i < b->sampling.vpl_count)
            lsf_vpl_draw(&b->vpl, turn->iteration, i, 1, light_probability(b, light), &map);
        run_sample(turn, i);
    }
}

static void run_samples(bidirectional *b, const lsf_iteration *iteration,
                        const lsf_bidirectional_shade_inputs *inputs)
{
    const sampling *s = &b->sampling;
    uint32_t count = max_u32(s->vpl_count, s->bundle_count);
    sample_turn turn = {.b = b,
                        .iteration = iteration,
                        .inputs = *inputs,
                        .iterations = suppressed_iterations(b, iteration)};
    lsf_bidirectional_shade_clear(&b->shade);
    if (s->segments > 0) {
        lsf_bundle_directions_draw(&b->directions, iteration, s->bundle_count, s->segments > 1,
                                   b->aims);
        lsf_ray_bundle_aim(b->bundle, iteration, b->aims, b->chain.gbuffer.outputs.depth);
    }
    for (uint32_t i = 0; s->segments > 1 && i < s->bundle_count; i++)
        lsf_ray_bundle_build(b->bundle, iteration, i);
    if (s->vpl_light || s->bundle_light) {
        pick_lights(b, iteration, count);
        for (uint32_t light = 0; light < iteration->state->light_count; light++)
            run_light(&turn, light, count);
    } else {
        for (uint32_t i = 0; i < count; i++)
            run_sample(&turn, i);
    }
}

static void run_bidirectional(void *self, const lsf_iteration *iteration,
                              lsf_technique_outputs *outputs)
{
    bidirectional *b = self;
    const lsf_gbuffer_outputs *gbuffer = &b->chain.gbuffer.outputs;
    lsf_bidirectional_shade_inputs inputs = {
        .depth = gbuffer->depth, .surface = gbuffer->surface, .gloss = gbuffer->gloss};
    const lsf_interleave_points points = {
        .depth = gbuffer->depth, .surface = gbuffer->surface, .gloss = gbuffer->gloss};
    GLuint irradiance = b->shade.outputs.irradiance, specular = b->shade.outputs.specular;
    lsf_direct_chain_run(&b->chain, iteration);
    if (b->sampling.interleave > 1) {
        lsf_interleave_split(&b->interleave, iteration, &points);
        inputs.depth = b->interleave.split.depth;
        inputs.surface = b->interleave.split.surface;
        inputs.gloss = b->interleave.split.gloss;
    }
    if (irradiance)
        run_samples(b, iteration, &inputs);
    if (b->sampling.interleave > 1) {
        const lsf_interleave_light light = {irradiance, specular};
        lsf_interleave_gather(&b->interleave, iteration, &points, &light);
        irradiance = b->interleave.light.irradiance;
        specular = b->interleave.light.specular;
    }
    lsf_compose_inputs parts = {.depth = gbuffer->depth,
                                .emission = gbuffer->emission,
                                .direct = b->chain.direct_light.radiance,
                                .surface = gbuffer->surface,
                                .irradiance = irradiance,
                                .specular = specular,
                                .direct_irradiance = b->shade.outputs.direct_irradiance,
                                .direct_specular = b->shade.outputs.direct_specular};
    lsf_compose_run(&b->compose, iteration, &parts);
    *outputs = (lsf_technique_outputs){
        .picture = b->compose.radiance,
        .bounded = b->shade_params.clamp_distance > 0.0f,
        .depth = gbuffer->depth,
        .surface = gbuffer->surface,
        .emission = b->compose.seen,
        .direct = b->compose.direct ? b->compose.direct : b->chain.direct_light.radiance,
        .indirect_diffuse = b->compose.indirect_diffuse,
        .indirect_specular = specular,
        .motion = gbuffer->motion,
    };
}

static void destroy_bidirectional(void *self)
{
    bidirectional *b = self;
    if (!b)
        return;
    lsf_compose_destroy(&b->compose);
    lsf_interleave_destroy(&b->interleave);
    lsf_bidirectional_shade_destroy(&b->shade);
    lsf_ray_bundle_destroy(b->bundle);
    if (b->bundle_pdf)
        lsf_texture_destroy(b->context, &b->bundle_pdf);
    lsf_bundle_directions_finish(&b->directions);
    lsf_vpl_destroy(&b->vpl);
    lsf_reflective_shadow_map_destroy(&b->rsm);
    lsf_direct_chain_destroy(&b->chain);
    lsf_distribution_finish(&b->light_power);
    free(b->lights);
    free(b->aims);
    free(b);
}

static uint32_t report_bidirectional(void *self, lsf_pass_report reports[LSF_TECHNIQUE_MAX_PASSES])
{
    bidirectional *b = self;
    uint32_t count = lsf_direct_chain_report(&b->chain, reports);
    lsf_timer *bundle_timers[3] = {NULL};
    if (b->bundle)
        lsf_ray_bundle_timers(b->bundle, bundle_timers);
    const lsf_pass_report candidates[] = {
        {.timer = b->interleave.split_timer},
        {b->rsm.timer, LSF_DRAW_COUNTS, lsf_draw_count_names, b->rsm.counts},
        {.timer = b->rsm.pdf_timer},
        {.timer = b->vpl.draw_timer},
        {b->vpl.map_timer, LSF_DRAW_COUNTS, lsf_draw_count_names, b->vpl.counts},
        {.timer = bundle_timers[0]},
        {bundle_timers[1], LSF_RAY_BUNDLE_COUNTS, lsf_ray_bundle_count_names,
         b->bundle ? lsf_ray_bundle_counts(b->bundle) : NULL},
        {.timer = bundle_timers[2]},
        {.timer = b->shade.vpl_timer},
        {.timer = b->shade.hit_timer},
        {.timer = b->interleave.gather_timer},
        {.timer = b->interleave.filter_timer},
        {.timer = b->compose.timer},
    };
    for (size_t i = 0; i < LSF_COUNT(candidates); i++)
        if (candidates[i].timer)
            reports[count++] = candidates[i];
    return count;
}

const lsf_technique lsf_technique_bidirectional = {
    .name = "bidirectional",
    .help = "global illumination by ray-bundles and virtual point lights, combined by MIS",
    .plan = plan_bidirectional,
    .create = create_bidirectional,
    .run = run_bidirectional,
    .destroy = destroy_bidirectional,
    .report = report_bidirectional,
};
