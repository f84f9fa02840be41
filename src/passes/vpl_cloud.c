#include "passes/vpl_cloud.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "frame/light_walls.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "shared/scene_data.h"
#include "shared/vpl_record.h"

#define GROUP_SIZE 64

/* Storage buffers. */
#define BINDING_CLOUD 2
#define BINDING_SUMS 4

/* Random numbers of vertices beyond the first go by the path alone; lights count from 0. */
#define NO_LIGHT UINT32_MAX

_Static_assert(sizeof(struct lsf_vpl_record) == 32, "as shaders see it");

static const char emitter_name[] = "vpl_cloud.emitters";

const lsf_option_row lsf_vpl_cloud_options[LSF_VPL_CLOUD_OPTION_COUNT] = {
    {"cloud.count", LSF_OPTION_INT, offsetof(lsf_vpl_cloud_params, count), 8192, 1048576, NULL,
     "VPLs",
     "maximum number of VPLs of the substitute tree in an iteration: 4096 of them on emissive "
     "surfaces, if there are any, the others where light was reflected"},
    {"cloud.lobe_share", LSF_OPTION_FLOAT, offsetof(lsf_vpl_cloud_params, lobe_share), 0.0, 1.0,
     NULL, "of what is reflected",
     "smallest share of specular reflection for which virtual point lights keep its direction; "
     "below it they emit diffusely; 0: they always keep it, with more noise"},
    {"cloud.directions", LSF_OPTION_INT, offsetof(lsf_vpl_cloud_params, directions), 0, 256, NULL,
     "directions",
     "maximum number of the environment's directions at which light paths begin in an iteration, "
     "each with a reflective shadow map of the scene; 0: all, or where the scene stands in the "
     "open, "
     "as many as draw 262144 triangles"},
};

lsf_vpl_cloud_shape lsf_vpl_cloud_shape_of(const lsf_vpl_cloud_params *params,
                                           const lsf_vpl_cloud_use *use)
{
    bool bounces = use->bounces > 0 && (use->lights || use->emitters);
    lsf_vpl_cloud_shape shape = {.points = use->emitters ? LSF_EMITTER_POINTS : 0,
                                 .vertices = bounces ? use->bounces : 0};
    if (bounces)
        shape.paths = ((uint32_t)params->count - shape.points) / use->bounces;
    return shape;
}

uint32_t lsf_vpl_cloud_records(const lsf_vpl_cloud_shape *shape)
{
    return shape->points + shape->paths * shape->vertices;
}

/* In the open most light comes from the environment itself, and maps of all directions would take
 * more time than they are worth where there are many triangles. */
static uint32_t directions_used(const lsf_plan *plan, const lsf_vpl_cloud_params *params)
{
    enum { MOST_TRIANGLES = 1 << 18 }; /* of all maps together */
    uint64_t triangles = plan->requirements.triangles;
    uint64_t used = plan->sky_lights;
    if (params->directions > 0)
        used = (uint64_t)params->directions;
    else if (plan->open && used * triangles > MOST_TRIANGLES)
        used = triangles < MOST_TRIANGLES ? MOST_TRIANGLES / triangles : 1;
    return used < plan->sky_lights ? (uint32_t)used : plan->sky_lights;
}

/* Whether paths go on from their first points. */
static bool goes_on(const lsf_vpl_cloud_use *use)
{
    return use->bounces > (use->emitters ? 0u : 1u);
}

static void plan_materials(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_SPECULAR", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
}

static void plan_light(lsf_plan *plan)
{
    lsf_plan_pass_add(plan, "vpl_cloud_light", "what lights fall on");
    lsf_plan_reads(plan, "reflective_shadow_map");
    lsf_plan_fills(plan, "vpl_cloud");
    plan_materials(plan);
    lsf_light_switches(plan);
    lsf_plan_switch_add(plan, "LSF_EMISSION_ADAPTIVE", lsf_light_emission_is_adaptive(plan),
                        "rsm.pdf is adaptive");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", lsf_plan_surfaces_differ(plan),
                        "roughness or metallic vary");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", plan->straight, "it goes straight on");
    lsf_plan_switch_add(plan, "LSF_SHADOW_TINT", lsf_light_walls_needed(plan),
                        "light passes thin walls");
}

static void plan_bounce(lsf_plan *plan, const lsf_vpl_cloud_use *use)
{
    lsf_plan_pass_add(plan, "vpl_cloud_bounce", "paths through the voxels, of %u bounce%s at most",
                      use->bounces, lsf_plural(use->bounces));
    lsf_plan_reads(plan, "voxelize");
    lsf_plan_fills(plan, "vpl_cloud");
    plan_materials(plan);
    lsf_voxel_specular_params_switch(plan);
    lsf_voxel_bend_switch(plan);
    lsf_voxel_passage_switches(plan);
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
}

void lsf_vpl_cloud_plan(lsf_plan *plan, const lsf_vpl_cloud_params *params,
                        const lsf_vpl_cloud_use *use)
{
    lsf_vpl_cloud_shape shape = lsf_vpl_cloud_shape_of(params, use);
    uint32_t records = lsf_vpl_cloud_records(&shape);
    if (use->emitters) {
        lsf_plan_pass_add(plan, "vpl_cloud_emitter", "surfaces emit light");
        lsf_plan_fills(plan, "vpl_cloud");
        lsf_emitter_points_plan(plan, emitter_name);
    } else {
        lsf_plan_omit(plan, "vpl_cloud_emitter", "no surface emits light");
    }
    uint32_t directions = directions_used(plan, params);
    if (directions < plan->sky_lights)
        lsf_plan_remark(plan,
                        "in an iteration, light paths begin at %u of the environment's %u "
                        "directions (cloud.directions)",
                        directions, plan->sky_lights);
    if (use->lights)
        plan_light(plan);
    else
        lsf_plan_omit(plan, "vpl_cloud_light", "no light but what surfaces emit bounces");
    if (goes_on(use))
        plan_bounce(plan, use);
    else
        lsf_plan_omit(plan, "vpl_cloud_bounce", "light does not go on from where it fell");
    lsf_plan_buffer_add(plan, "vpl_cloud.records",
                        records * (uint64_t)sizeof(struct lsf_vpl_record),
                        "%u paths of %u vertices, %u points on emitters", shape.paths,
                        shape.vertices, shape.points);
}

/* Program and timer of a pass; both stay 0, with success, when the plan does not list it. */
static bool create_pass(lsf_vpl_cloud *pass, const lsf_plan *plan, const char *name,
                        const char *file, GLuint *program, lsf_timer **timer, lsf_error *error)
{
    const char *const files[5] = {file};
    if (!lsf_plan_find_pass(plan, name))
        return true;
    *program = lsf_plan_program(plan, pass->context, name, files, error);
    *timer = *program ? lsf_timer_create(pass->context, name, error) : NULL;
    return *timer != NULL;
}

bool lsf_vpl_cloud_create(lsf_vpl_cloud *pass, lsf_context *context, const lsf_plan *plan,
                          const lsf_vpl_cloud_params *params, const lsf_vpl_cloud_use *use,
                          const lsf_scene *scene, const lsf_state *state, lsf_error *error)
{
    *pass = (lsf_vpl_cloud){.context = context,
                            .use = *use,
                            .shape = lsf_vpl_cloud_shape_of(params, use),
                            .specular = plan->requirements.specular,
                            .lobe_share = params->lobe_share,
                            .directions = directions_used(plan, params)};
    return lsf_plan_create_buffer(plan, context, "vpl_cloud.records", NULL, 0, &pass->records,
                                  error) &&
           (!use->emitters || lsf_emitter_points_create(&pass->emitters, context, plan,
                                                        emitter_name, scene, state, error)) &&
           create_pass(pass, plan, "vpl_cloud_light", "passes/vpl_cloud_light.comp.glsl",
                       &pass->light_program, &pass->light_timer, error) &&
           create_pass(pass, plan, "vpl_cloud_emitter", "passes/vpl_cloud_emitter.comp.glsl",
                       &pass->emitter_program, &pass->emitter_timer, error) &&
           create_pass(pass, plan, "vpl_cloud_bounce", "passes/vpl_cloud_bounce.comp.glsl",
                       &pass->bounce_program, &pass->bounce_timer, error);
}

bool lsf_vpl_cloud_follow(lsf_vpl_cloud *pass, bool materials_edited)
{
    return !pass->use.emitters || lsf_emitters_update(&pass->emitters.list, materials_edited);
}

/* The share of all paths that begin at lights: half by power, and half evenly, as among lights
 * themselves. */
static uint32_t paths_at_lights(const lsf_vpl_cloud *pass, float light_power)
{
    float emitter_power = pass->use.emitters ? lsf_emitters_power(&pass->emitters.list) : 0.0f;
    if (!pass->use.lights || light_power <= 0.0f)
        return 0;
    if (emitter_power <= 0.0f)
        return pass->shape.paths;
    float share = 0.25f + 0.5f * light_power / (light_power + emitter_power);
    return (uint32_t)(share * (float)pass->shape.paths);
}

/* Sets uniforms of the program in use, whose paths meet surfaces. */
static void set_lobes(const lsf_vpl_cloud *pass)
{
    if (pass->specular)
        glUniform1f(4, pass->lobe_share);
}

/* Sets uniforms of the program in use. */
static void set_shape(const lsf_vpl_cloud *pass, const lsf_iteration *iteration, uint32_t light,
                      uint32_t first, uint32_t count)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_CLOUD, pass->records);
    glUniform4ui(0, pass->shape.points, pass->shape.paths, first, count);
    glUniform3ui(1, iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_VPL_CLOUD), light);
}

static void dispatch(uint32_t count)
{
    glDispatchCompute((count + GROUP_SIZE - 1) / GROUP_SIZE, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

static void emit(lsf_vpl_cloud *pass, const lsf_iteration *iteration)
{
    lsf_timer_begin(pass->emitter_timer);
    if (lsf_emitter_points_draw(&pass->emitters, iteration, LSF_PURPOSE_VPL_CLOUD_EMITTER)) {
        glUseProgram(pass->emitter_program);
        set_shape(pass, iteration, NO_LIGHT, 0, 0);
        dispatch(pass->shape.points);
    }
    lsf_timer_end(pass->emitter_timer);
}

void lsf_vpl_cloud_begin(lsf_vpl_cloud *pass, const lsf_iteration *iteration, float light_power)
{
    static const GLuint dead = 0;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferData(pass->records, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &dead);
    pass->light_paths = paths_at_lights(pass, light_power);
    if (pass->emitter_program)
        emit(pass, iteration);
}

/* The first of the iteration's directions at which paths begin. Iteration t of M directions has the
 * numbers t M to t M + M - 1 of a sequence whose last digits decide which part of the sphere a
 * direction is from. The sum of t's digits of base M takes all values equally often for any values
 * of a few digits; always the same direction, or that of number t mod M, would leave out parts. */
static uint32_t first_direction(uint32_t t, uint32_t directions)
{
    uint64_t sum = t;
    for (uint32_t digits = t / directions; directions > 1 && digits > 0; digits /= directions)
        sum += digits;
    return (uint32_t)(sum % directions);
}

/* The part of the light paths that begin at a light, as an interval of [0, 1]. All directions of
 * the environment are equally probable. Where only some begin paths, these have those of the
 * others, each path with its share of the light as before. */
static void find_part(const lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                      const lsf_distribution *picks, uint32_t light, double part[2])
{
    uint32_t directions = iteration->plan->sky_lights, used = pass->directions;
    uint32_t first = iteration->light_count - directions;
    part[0] = picks->cumulative[light];
    part[1] = picks->cumulative[light + 1];
    if (light < first || used == directions)
        return;
    uint32_t start = first_direction(iteration->index, directions);
    uint32_t number = (light - first + directions - start) % directions;
    double before = picks->cumulative[first];
    double each = (picks->cumulative[first + directions] - before) / (double)used;
    part[0] = before + each * (number < used ? number : used);
    part[1] = before + each * (number < used ? number + 1 : used);
}

/* Systematic sampling: with one random offset, a light of probability p has p n paths rounded up or
 * down, and p n on average. */
lsf_vpl_cloud_run lsf_vpl_cloud_deal(const lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                                     const lsf_distribution *picks, uint32_t light)
{
    lsf_vpl_cloud_run run = {.light = light};
    if (pass->light_paths == 0)
        return run;
    double offset = (double)lsf_random_float(
        lsf_iteration_seed(iteration, LSF_PURPOSE_VPL_CLOUD_DEAL), iteration->index);
    double paths = (double)pass->light_paths, part[2];
    find_part(pass, iteration, picks, light, part);
    run.first = (uint32_t)floor(part[0] * paths + offset);
    run.count = (uint32_t)floor(part[1] * paths + offset) - run.first;
    run.share = (float)(1.0 / (paths * lsf_distribution_probability(picks, light)));
    return run;
}

void lsf_vpl_cloud_light(lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                         const lsf_vpl_cloud_run *run, const lsf_vpl_cloud_inputs *inputs)
{
    lsf_timer_begin(pass->light_timer);
    lsf_shadow_bind(inputs->shadow);
    lsf_surface_maps_bind(inputs->seen);
    lsf_bind_texture(3, inputs->shadow->tint);
    lsf_bind_texture(LSF_UNIT_EMISSION, inputs->importance);
    if (inputs->sums)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_SUMS, inputs->sums);
    glUseProgram(pass->light_program);
    set_shape(pass, iteration, run->light, run->first, run->count);
    set_lobes(pass);
    glUniform1f(2, run->share);
    dispatch(run->count);
    lsf_timer_end(pass->light_timer);
}

void lsf_vpl_cloud_bounce(lsf_vpl_cloud *pass, const lsf_iteration *iteration,
                          const lsf_voxels *voxels)
{
    if (!pass->bounce_program)
        return;
    uint32_t seed = lsf_iteration_seed(iteration, LSF_PURPOSE_VPL_CLOUD_EMITTER);
    lsf_timer_begin(pass->bounce_timer);
    lsf_voxels_bind(voxels);
    lsf_voxel_passage_bind(iteration);
    glUseProgram(pass->bounce_program);
    set_shape(pass, iteration, NO_LIGHT, pass->light_paths, pass->shape.paths - pass->light_paths);
    set_lobes(pass);
    glUniform1ui(2, pass->shape.vertices);
    glUniform1f(3, lsf_random_float(seed, iteration->index));
    dispatch(pass->shape.paths);
    lsf_timer_end(pass->bounce_timer);
}

void lsf_vpl_cloud_destroy(lsf_vpl_cloud *pass)
{
    if (!pass->context)
        return;
    lsf_buffer_destroy(pass->context, &pass->records);
    lsf_emitter_points_destroy(&pass->emitters, pass->context);
    lsf_timer_destroy(pass->light_timer);
    lsf_timer_destroy(pass->emitter_timer);
    lsf_timer_destroy(pass->bounce_timer);
    memset(pass, 0, sizeof *pass);
}
