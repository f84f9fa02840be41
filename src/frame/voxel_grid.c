#include "frame/voxel_grid.h"
#include "frame/purpose.h"

#include <math.h>

#include "math/sampling.h"
#include "scene/sky.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

/* The largest 3D texture that every device has (GL 4.5, table 23.53). */
#define MAX_TEXTURE_DEPTH 2048

/* Sizes are multiples of a block of occupancy, 4^2 voxels. */
#define BLOCK 16

const lsf_option_row lsf_voxel_grid_options[LSF_VOXEL_GRID_OPTION_COUNT] = {
    {"voxel.resolution", LSF_OPTION_INT, offsetof(lsf_voxel_grid_params, resolution), 0, 512, NULL,
     "voxels",
     "voxels along the scene's longest side; 0: 128, or with cone or voxel_path and a time limit "
     "fewer in software OpenGL: 64 for 1 s, 112 for 4 s"},
    {"voxel.memory", LSF_OPTION_FLOAT, offsetof(lsf_voxel_grid_params, memory), 1.0, 1048576.0,
     NULL, "MiB", "memory limit of the grid's textures; the resolution is halved until they fit"},
    {"voxel.jitter", LSF_OPTION_BOOL, offsetof(lsf_voxel_grid_params, jitter), 0, 0, NULL, "",
     "shifts the grid within a voxel in each iteration, so that the mean shows no voxels"},
};

/* The grid has two voxels more than the scene takes: half of one on each side leaves space for
 * the shift, the other half keeps surfaces at the scene's bounds off the grid's border. */
static void fit(lsf_voxel_grid *grid, const lsf_state *state, uint32_t resolution)
{
    float longest = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        longest = fmaxf(longest, state->reach_max[axis] - state->reach_min[axis]);
    grid->resolution = resolution;
    grid->side = longest > 0.0f ? longest / (float)(resolution > 3 ? resolution - 2 : 1) : 1.0f;
    bool empty = state->reach_min[0] > state->reach_max[0];
    for (int axis = 0; axis < 3; axis++) {
        float low = empty ? 0.0f : state->reach_min[axis];
        float high = empty ? 0.0f : state->reach_max[axis];
        float extent = high - low;
        uint32_t voxels = (uint32_t)ceilf(extent / grid->side - 1e-3f) + 2;
        grid->size[axis] = (voxels + BLOCK - 1) / BLOCK * BLOCK;
        grid->origin[axis] = 0.5f * (low + high) - 0.5f * (float)grid->size[axis] * grid->side;
    }
}

static float largest(const float color[3])
{
    return fmaxf(color[0], fmaxf(color[1], color[2]));
}

/* A power of two of the order of the light on surfaces: radiance is stored as half floats, which
 * then resolve values 2^14 times darker and brighter. Emission may be much brighter than the
 * surfaces that it lights, so that it gets the upper part of the range. */
void lsf_voxel_grid_set_unit(lsf_voxel_grid *grid, const lsf_scene *scene, const lsf_state *state)
{
    float brightest = 0.0f;
    for (uint32_t i = 0; i < state->light_count; i++)
        brightest = fmaxf(brightest, largest(state->lights[i].intensity));
    brightest = fmaxf(brightest, (float)lsf_sky_fluence(&scene->environment));
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_material *material = &state->animated.materials[state->instances[i].material];
        brightest = fmaxf(brightest, largest(material->emission) / 256.0f);
        if (material->unlit)
            brightest = fmaxf(brightest, largest(material->base_color) / 256.0f);
    }
    int exponent = 0;
    if (brightest > 0.0f)
        frexpf(brightest, &exponent);
    grid->unit = ldexpf(1.0f, exponent);
}

static bool fits(const lsf_voxel_grid *grid, const lsf_voxel_grid_params *params,
                 const lsf_voxel_grid_use *use)
{
    double voxels = (double)grid->size[0] * grid->size[1] * grid->size[2];
    return voxels * use->bytes <= (double)params->memory * 1048576.0 &&
           grid->size[2] * use->sides <= MAX_TEXTURE_DEPTH;
}

lsf_voxel_grid lsf_voxel_grid_fit(const lsf_voxel_grid_params *params, const lsf_state *state,
                                  const lsf_voxel_grid_use *use)
{
    lsf_voxel_grid grid = {.jitter = params->jitter, .unit = 1.0f};
    grid.wanted = params->resolution > 0 ? (uint32_t)params->resolution : use->voxels;
    fit(&grid, state, grid.wanted);
    while (!fits(&grid, params, use) && grid.resolution > 1)
        fit(&grid, state, grid.resolution / 2);
    return grid;
}

void lsf_voxel_grid_remark(lsf_plan *plan, const lsf_voxel_grid_params *params,
                           const lsf_voxel_grid *grid)
{
    lsf_plan_remark(
        plan,
        "a voxel is %.3g scene units wide: a grid over the whole scene blurs indirect light by as "
        "much, and misses smaller rooms",
        (double)grid->side / plan->requirements.scale);
    if (params->resolution == 0 && grid->wanted < LSF_VOXEL_RESOLUTION)
        lsf_plan_remark(plan,
                        "a grid of %u voxels along the scene's longest side: with more, too few "
                        "iterations fit into the time limit (voxel.resolution)",
                        grid->wanted);
    if (grid->resolution != grid->wanted)
        lsf_plan_remark(
            plan,
            "a grid of %u voxels instead of %u along the scene's longest side: a finer one exceeds "
            "voxel.memory=%g, or the maximum texture depth of %d",
            grid->resolution, grid->wanted, (double)params->memory, MAX_TEXTURE_DEPTH);
}

static uint32_t id_bits(uint64_t triangles)
{
    uint32_t bits = 1;
    while (bits < 31 && (UINT64_C(1) << bits) < triangles + 1)
        bits++;
    return bits;
}

struct lsf_voxel_grid_data lsf_voxel_grid_data(const lsf_voxel_grid *grid,
                                               const lsf_iteration *iteration)
{
    float shift[3] = {0.5f, 0.5f, 0.5f}, point[2];
    if (grid->jitter) {
        lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_SHIFT),
                     shift);
        lsf_sobol_2d(iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_SHIFT + 1),
                     point);
        shift[2] = point[0];
    }
    for (int axis = 0; axis < 3; axis++)
        shift[axis] = grid->origin[axis] + (shift[axis] - 0.5f) * grid->side;
    return (struct lsf_voxel_grid_data){.origin = {shift[0], shift[1], shift[2], grid->side},
                                        .size = {(float)grid->size[0], (float)grid->size[1],
                                                 (float)grid->size[2], 1.0f / grid->side},
                                        .unit = {grid->unit, 1.0f / grid->unit},
                                        .id_bits =
                                            id_bits(iteration->plan->requirements.triangles)};
}

void lsf_voxels_bind_grid(const lsf_voxels *voxels)
{
    glBindBufferBase(GL_UNIFORM_BUFFER, LSF_BINDING_VOXEL, voxels->grid_buffer);
}

void lsf_voxels_bind(const lsf_voxels *voxels)
{
    lsf_voxels_bind_grid(voxels);
    for (GLuint level = 0; level < LSF_VOXEL_OCCUPANCY_LEVELS; level++)
        lsf_bind_texture(LSF_UNIT_VOXEL_OCCUPANCY + level, voxels->occupancy[level]);
    lsf_bind_texture(LSF_UNIT_VOXEL_ALBEDO, voxels->albedo);
    lsf_bind_texture(LSF_UNIT_VOXEL_NORMAL, voxels->normal);
    lsf_bind_texture(LSF_UNIT_VOXEL_POINT, voxels->point);
    lsf_bind_texture(LSF_UNIT_VOXEL_SHADING, voxels->shading);
    lsf_bind_texture(LSF_UNIT_VOXEL_EMISSION, voxels->emission);
    lsf_bind_texture(LSF_UNIT_VOXEL_SHINING, voxels->shining);
    lsf_bind_texture(LSF_UNIT_VOXEL_SPECULAR_PARAMS, voxels->specular_params);
    lsf_bind_texture(LSF_UNIT_VOXEL_TRANSMISSION, voxels->transmission);
}

void lsf_voxel_texture_plan(lsf_plan *plan, const lsf_voxel_grid *grid, const char *name,
                            GLenum internal_format, uint32_t sides, uint32_t levels,
                            const char *why)
{
    lsf_texture_desc desc = {.target = GL_TEXTURE_3D,
                             .internal_format = internal_format,
                             .width = grid->size[0],
                             .height = grid->size[1],
                             .depth = grid->size[2] * sides,
                             .levels = levels};
    lsf_plan_texture_desc_add(plan, name, &desc, "%s", why);
}

bool lsf_voxel_bends(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    return r->smooth || r->normal_mapped || r->anisotropic;
}

void lsf_voxel_bend_switch(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_VOXEL_BENT", lsf_voxel_bends(plan),
                        "normals are smooth or mapped, or tangents count: voxels keep them, too");
}

bool lsf_voxel_has_specular_params(const lsf_plan *plan)
{
    const lsf_requirements *r = &plan->requirements;
    return r->glossy || (plan->transmission && r->variable_ior);
}

void lsf_voxel_specular_params_switch(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_VOXEL_SPECULAR_PARAMS", lsf_voxel_has_specular_params(plan),
                        "roughness or metallic vary between voxels");
}

bool lsf_voxel_mirrors(const lsf_plan *plan, const lsf_state *state)
{
    const lsf_requirements *r = &plan->requirements;
    return r->smooth_metal && (r->environment || state->light_count > 0);
}

bool lsf_voxel_lamps(const lsf_plan *plan, const lsf_state *state)
{
    return plan->requirements.smooth_metal && (plan->sky_lights > 0 || state->light_count > 0);
}

void lsf_voxel_lamps_switch(lsf_plan *plan, bool lamps)
{
    lsf_plan_switch_add(plan, "LSF_VOXEL_LAMPS", lamps, "voxels of smooth metal mirror lamps");
}

float lsf_voxel_solid_angle(const lsf_voxel_grid *grid)
{
    float angle = 2.0f / (float)grid->resolution;
    return angle * angle;
}

/* A kernel k widens lobes to alpha^2 = k / (4 pi) where all light is reflected; here to the angle
 * of a voxel seen over half the scene's extent. */
void lsf_voxel_lamps_bind(const lsf_iteration *iteration, const lsf_voxel_grid *grid, GLuint lamps,
                          bool lit)
{
    lsf_bind_texture(LSF_UNIT_VOXEL_LAMP, lamps);
    glUniform2f(LSF_LOCATION_VOXEL_LAMP,
                lit ? lsf_iteration_kernel(iteration) * LSF_HIDDEN_KERNEL : -1.0f,
                4.0f * LSF_PI * lsf_voxel_solid_angle(grid));
}

void lsf_voxel_chance_switch(lsf_plan *plan)
{
    if (plan->voxel_chance)
        lsf_plan_switch_add(plan, "LSF_VOXEL_CHANCE", true, "light passes surfaces by chance");
}

bool lsf_voxel_passage(const lsf_plan *plan)
{
    return plan->straight && !plan->voxel_chance;
}

void lsf_voxel_passage_switches(lsf_plan *plan)
{
    if (!lsf_voxel_passage(plan))
        return;
    lsf_plan_switch_add(plan, "LSF_VOXEL_PASSAGE", true, "rays go on through what transmits");
    lsf_plan_switch_add(plan, "LSF_STRAIGHT", true, "light goes straight on");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", plan->requirements.refractive, "there are media");
}

void lsf_voxel_passage_all_switches(lsf_plan *plan)
{
    if (!lsf_voxel_passage(plan)) {
        lsf_scene_gpu_scatter_switches(plan);
        return;
    }
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", true, "light passes materials that transmit");
    lsf_voxel_specular_params_switch(plan);
    lsf_voxel_bend_switch(plan);
    lsf_voxel_passage_switches(plan);
}

void lsf_voxel_passage_bind(const lsf_iteration *iteration)
{
    if (lsf_voxel_passage(iteration->plan))
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_MATERIALS,
                         iteration->scene->materials);
}
