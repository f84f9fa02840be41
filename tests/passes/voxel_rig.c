#include "voxel_rig.h"

#include <math.h>

#define MAP_RESOLUTION 512
#define SKY_MAP_RESOLUTION 128

/* Of the radiance, so that it is kept fit to be filtered. */
#define LEVELS 2

static void init_light(voxel_rig *rig)
{
    lsf_error error = {0};
    const lsf_voxel_light_use use = {.sides = rig->sides, .levels = LEVELS, .lights = true};
    lsf_plan *plan = rig->setup.plan;
    if (!lsf_shadow_map_create(&rig->shadow_map, rig->context, plan, &error) ||
        (plan->sky_lights > 0 &&
         !lsf_sky_map_create(&rig->sky_map, rig->context, plan, &rig->scene, &error)) ||
        !lsf_voxel_light_create(&rig->light, rig->context, plan, &use, &error))
        fail_msg("%s", error.message);
}

static void plan_light(voxel_rig *rig)
{
    const lsf_shadow_map_params shadow_map = {LSF_SHADOW_MAP_PARAMS_DEFAULTS};
    const lsf_voxel_light_use use = {.sides = rig->sides, .levels = LEVELS, .lights = true};
    lsf_shadow_map_plan(rig->setup.plan, &shadow_map, &rig->setup.state);
    lsf_shadow_map_plan_scene(rig->setup.plan, &shadow_map, &rig->setup.state, MAP_RESOLUTION);
    if (rig->setup.plan->sky_lights > 0) {
        lsf_sky_map_plan(rig->setup.plan, SKY_MAP_RESOLUTION);
        lsf_sky_map_plan_scene(rig->setup.plan, SKY_MAP_RESOLUTION);
    }
    lsf_voxel_light_plan(rig->setup.plan, &rig->grid, &use);
}

void voxel_rig_init(voxel_rig *rig, const lsf_scene *scene, int32_t resolution,
                    lsf_voxelize_method method, bool jitter, uint32_t sides)
{
    lsf_error error = {0};
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS, .raw = true, .bounces = 1};
    const lsf_voxelize_params voxelize = {.method = (int32_t)method};
    lsf_voxel_grid_params grid = {LSF_VOXEL_GRID_PARAMS_DEFAULTS};
    grid.resolution = resolution;
    grid.jitter = jitter;
    params.width = params.height = 64;
    *rig = (voxel_rig){.sides = sides};
    rig->context = gl_test_context(gl_test_backend(), NULL);
    if (!lsf_setup_begin(&rig->setup, scene, &params, true, &error))
        fail_msg("%s", error.message);
    lsf_plan *plan = rig->setup.plan;
    const lsf_voxel_grid_use use = {.bytes = lsf_voxelize_bytes(plan, jitter), .sides = 1};
    rig->grid = lsf_voxel_grid_fit(&grid, &rig->setup.state, &use);
    lsf_voxel_grid_set_unit(&rig->grid, scene, &rig->setup.state);
    lsf_voxelize_plan(plan, &voxelize, &rig->grid);
    if (sides > 0)
        plan_light(rig);
    if (!lsf_scene_gpu_create(&rig->scene, rig->context, plan, scene, &rig->setup.state, NULL,
                              &error) ||
        !lsf_iteration_create(&rig->iteration, rig->context, plan, &rig->scene, &rig->setup.state,
                              NULL, 0, &error) ||
        !lsf_voxelize_create(&rig->pass, rig->context, plan, &voxelize, &rig->grid, scene, &error))
        fail_msg("%s", error.message);
    if (sides > 0)
        init_light(rig);
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, lsf_plan_bytes(plan));
}

static void add_sky(voxel_rig *rig)
{
    const lsf_sky_map_outputs *maps = &rig->sky_map.outputs;
    lsf_sky_map_begin(&rig->sky_map, &rig->iteration);
    while (lsf_sky_map_next(&rig->sky_map, &rig->iteration))
        if (maps->whole > 0)
            lsf_voxel_light_add_sky(&rig->light, &rig->iteration, rig->outputs, &maps->shadow,
                                    maps->count);
    lsf_sky_map_begin_scene(&rig->sky_map, &rig->iteration);
    while (lsf_sky_map_next(&rig->sky_map, &rig->iteration))
        lsf_voxel_light_add_sky(&rig->light, &rig->iteration, rig->outputs, &maps->shadow,
                                maps->count);
}

static void run_light(voxel_rig *rig)
{
    lsf_voxel_light_begin(&rig->light, rig->outputs);
    for (uint32_t i = 0; i < rig->setup.state.light_count; i++) {
        lsf_shadow_map_run_scene(&rig->shadow_map, &rig->iteration, i);
        lsf_voxel_light_add(&rig->light, &rig->iteration, rig->outputs,
                            &rig->shadow_map.outputs.shadow);
    }
    if (rig->sky_map.timer)
        add_sky(rig);
    lsf_voxel_light_emit(&rig->light, rig->outputs);
}

void voxel_rig_bind(const voxel_rig *rig)
{
    lsf_error error = {0};
    if (!lsf_context_make_current(rig->context, &error))
        fail_msg("%s", error.message);
}

void voxel_rig_run(voxel_rig *rig, uint32_t iteration)
{
    voxel_rig_bind(rig);
    lsf_iteration_begin(&rig->iteration, iteration);
    rig->outputs = lsf_voxelize_run(rig->pass, &rig->iteration);
    if (rig->sides > 0)
        run_light(rig);
    gl_test_check(rig->context);
}

void voxel_rig_finish(voxel_rig *rig)
{
    voxel_rig_bind(rig);
    lsf_voxel_light_destroy(&rig->light);
    lsf_shadow_map_destroy(&rig->shadow_map);
    lsf_sky_map_destroy(&rig->sky_map);
    lsf_voxelize_destroy(rig->pass);
    lsf_iteration_destroy(&rig->iteration);
    lsf_scene_gpu_destroy(&rig->scene);
    lsf_setup_finish(&rig->setup);
    assert_int_equal(lsf_context_get_info(rig->context).gl_bytes, 0);
    gl_test_check(rig->context);
    lsf_context_destroy(rig->context);
}

size_t voxel_rig_voxel_count(const voxel_rig *rig)
{
    return (size_t)rig->grid.size[0] * rig->grid.size[1] * rig->grid.size[2];
}

uint32_t *voxel_rig_read_texture(GLuint texture, size_t texels)
{
    uint32_t *words = malloc(4 * texels);
    glGetTextureImage(texture, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, (GLsizei)(4 * texels), words);
    return words;
}

uint8_t *voxel_rig_read_occupancy(const voxel_rig *rig)
{
    const uint32_t *size = rig->grid.size;
    uint8_t *set = malloc(voxel_rig_voxel_count(rig));
    uint32_t *words =
        voxel_rig_read_texture(rig->outputs->occupancy[0], voxel_rig_voxel_count(rig) / 32);
    for (uint32_t z = 0, i = 0; z < size[2]; z++)
        for (uint32_t y = 0; y < size[1]; y++)
            for (uint32_t x = 0; x < size[0]; x++, i++) {
                uint32_t texel =
                    2 * (x / 4) + (z / 2) % 2 + size[0] / 2 * (y / 4 + size[1] / 4 * (z / 4));
                uint32_t bit = x % 4 + 4 * (y % 4) + 16 * (z % 2);
                set[i] = words[texel] >> bit & 1;
            }
    free(words);
    return set;
}

float *voxel_rig_read_radiance(const voxel_rig *rig)
{
    size_t texels = voxel_rig_voxel_count(rig) * rig->sides;
    float *radiance = malloc(16 * texels);
    glGetTextureImage(rig->light.radiance, 0, GL_RGBA, GL_FLOAT, (GLsizei)(16 * texels), radiance);
    for (size_t i = 0; i < 4 * texels; i++)
        radiance[i] *= i % 4 == 3 ? 1.0f : rig->grid.unit;
    return radiance;
}

size_t voxel_rig_voxel_at(const voxel_rig *rig, lsf_float3 point)
{
    const struct lsf_voxel_grid_data grid = lsf_voxel_grid_data(&rig->grid, &rig->iteration);
    const double p[3] = {(double)point.x, (double)point.y, (double)point.z};
    size_t cell[3];
    for (int axis = 0; axis < 3; axis++) {
        double at = (p[axis] - rig->setup.state.center[axis]) * rig->setup.state.scale;
        cell[axis] = (size_t)floor((at - (double)(&grid.origin.x)[axis]) / (double)grid.origin.w);
    }
    return cell[0] + rig->grid.size[0] * (cell[1] + rig->grid.size[1] * cell[2]);
}
