#include "passes/voxelize_parts.h"

/* Columns of voxels that one invocation does by itself, and those of a tile's side that a work
 * group shares; tiles in the list, 8 bytes each. */
#define SMALL_COLUMNS 16
#define TILE 8
#define MAX_TILES (1u << 20)

#define BRICK_VOXELS (LSF_VOXEL_BRICK * LSF_VOXEL_BRICK * LSF_VOXEL_BRICK)

/* Capacity for voxels that instances win: a storage block of 128 MiB. In a grid of more voxels
 * than this of which more are occupied, a quarter of all at 512^3, the rest would have no
 * surface. */
#define MAX_WON ((uint64_t)1 << 25)

const lsf_option_row lsf_voxelize_options[LSF_VOXELIZE_OPTION_COUNT] = {
    {"voxel.method", LSF_OPTION_ENUM, offsetof(lsf_voxelize_params, method), 0, 0, "compute|raster",
     "", "compute: an exact triangle-box test; raster: enlarged triangles on the raster pipeline"},
};

const char *const lsf_voxelize_count_names[LSF_VOXELIZE_COUNTS] = {"instances", "triangles"};

/* Without lists and the coarser occupancy, which take half a byte together. */
uint32_t lsf_voxelize_bytes(const lsf_plan *plan, bool jitter)
{
    uint32_t words = 5u + lsf_voxel_bends(plan) + lsf_plan_surfaces_shine(plan) +
                     lsf_voxel_has_specular_params(plan);
    uint32_t bytes = 4 * (words + plan->transmission) + 1;
    return lsf_voxelize_keeps_still(plan, jitter) ? 2 * bytes : bytes;
}

static void plan_switches(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_GROUP", GROUP, "triangles, or voxels, of a work group");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
    lsf_plan_switch_add(plan, "LSF_BINDING_DRAWS", BINDING_DRAWS, "always");
    lsf_plan_switch_add(plan, "LSF_BINDING_WON", BINDING_WON, "always");
}

static void beside_switches(lsf_plan *plan)
{
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
}

static void plan_programs(lsf_plan *plan)
{
    lsf_plan_pass_add(plan, "voxelize_clear", "what the grid held in the iteration before");
    beside_switches(plan);
    lsf_plan_pass_add(plan, "voxelize_mark", "triangles bid for the voxels that they touch");
    lsf_plan_reads(plan, "scene");
    plan_switches(plan);
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_SMALL", SMALL_COLUMNS, "columns of an invocation");
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_TILE", TILE, "columns of a tile's side");
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_GROUP_TILES", GROUP_TILES, "tiles of a work group");
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_TILES", MAX_TILES, "room in the list of tiles");
    lsf_plan_switch_add(plan, "LSF_VOXELIZE_ROW", GROUP * ROW_GROUPS,
                        "triangles of a row of work groups");
    lsf_plan_switch_add(plan, "LSF_BINDING_TILES", BINDING_TILES, "always");
    lsf_scene_gpu_material_switches(plan, false, false);
    lsf_voxel_chance_switch(plan);
    lsf_plan_pass_add(plan, "voxelize_list", "the voxels that each instance has won");
    plan_switches(plan);
    lsf_plan_pass_add(plan, "voxelize_write", "the surfaces of those that won");
    lsf_plan_reads(plan, "scene");
    plan_switches(plan);
    lsf_voxel_bend_switch(plan);
    lsf_scene_gpu_material_switches(plan, lsf_voxel_has_specular_params(plan),
                                    lsf_plan_surfaces_shine(plan));
    lsf_scene_gpu_fold_lobes(plan);
    lsf_voxel_chance_switch(plan);
    lsf_plan_pass_add(plan, "voxelize_beside", "what spares rays a look at voxels beside others");
    beside_switches(plan);
}

/* A bit for each cell, whose side is `cell` voxels. */
static void plan_bits(lsf_plan *plan, const lsf_voxel_grid *grid, const char *name, uint32_t cell,
                      const char *why)
{
    uint32_t side = LSF_VOXEL_BRICK * cell;
    lsf_texture_desc desc = {.target = GL_TEXTURE_3D,
                             .internal_format = GL_R32UI,
                             .width = 2 * ((grid->size[0] + side - 1) / side),
                             .height = (grid->size[1] + side - 1) / side,
                             .depth = (grid->size[2] + side - 1) / side,
                             .levels = 1};
    lsf_plan_texture_desc_add(plan, name, &desc, "%s", why);
}

static void plan_emission(lsf_plan *plan, const lsf_voxel_grid *grid)
{
    if (!lsf_plan_surfaces_shine(plan)) {
        lsf_plan_omit(plan, "voxelize.emission", "no material emits");
        return;
    }
    lsf_voxel_texture_plan(plan, grid, "voxelize.emission", GL_R32UI, 1, 1,
                           "some material emits or is unlit");
    plan_bits(plan, grid, "voxelize.shining", LSF_VOXEL_BRICK, "a bit for each brick that emits");
}

static uint64_t list_bytes(const lsf_voxel_grid *grid)
{
    uint64_t voxels = (uint64_t)grid->size[0] * grid->size[1] * grid->size[2];
    return 4 * LSF_VOXEL_LIST_HEADER + voxels / BRICK_VOXELS * sizeof(struct lsf_voxel_brick_data);
}

uint64_t lsf_voxelize_won_voxels(const lsf_voxel_grid *grid)
{
    uint64_t voxels = (uint64_t)grid->size[0] * grid->size[1] * grid->size[2];
    return voxels < MAX_WON ? voxels : MAX_WON;
}

void lsf_voxelize_plan(lsf_plan *plan, const lsf_voxelize_params *params,
                       const lsf_voxel_grid *grid)
{
    plan_programs(plan);
    lsf_plan_buffer_add(plan, "voxelize.grid", sizeof(struct lsf_voxel_grid_data),
                        "where the grid lies: %u x %u x %u voxels", grid->size[0], grid->size[1],
                        grid->size[2]);
    lsf_voxel_texture_plan(plan, grid, "voxelize.key", GL_R32UI, 1, 1, "the winning triangle");
    plan_bits(plan, grid, "voxelize.occupancy_0", 1, "a bit for each voxel");
    plan_bits(plan, grid, "voxelize.occupancy_1", LSF_VOXEL_BRICK, "a bit for each brick of 4^3");
    lsf_voxel_texture_plan(plan, grid, "voxelize.albedo", GL_R32UI, 1, 1, "base colour");
    lsf_voxel_texture_plan(plan, grid, "voxelize.normal", GL_R32UI, 1, 1, "the plane's normal");
    if (lsf_voxel_bends(plan))
        lsf_voxel_texture_plan(plan, grid, "voxelize.shading", GL_R32UI, 1, 1,
                               "shading normal and tangent");
    lsf_voxel_texture_plan(plan, grid, "voxelize.point", GL_R32UI, 1, 1,
                           "where the surface is in the voxel");
    plan_emission(plan, grid);
    if (lsf_voxel_has_specular_params(plan))
        lsf_voxel_texture_plan(plan, grid, "voxelize.specular_params", GL_R32UI, 1, 1,
                               "some material is glossy");
    else
        lsf_plan_omit(plan, "voxelize.specular_params", "no material is glossy");
    if (plan->transmission)
        lsf_voxel_texture_plan(plan, grid, "voxelize.transmission", GL_R32UI, 1, 1,
                               "light passes some material");
    lsf_plan_buffer_add(plan, "voxelize.bricks", list_bytes(grid), "occupied bricks of 4^3 voxels");
    lsf_plan_buffer_add(plan, "voxelize.previous_bricks", list_bytes(grid),
                        "those of the iteration before");
    if (params->method == LSF_VOXELIZE_COMPUTE)
        lsf_plan_buffer_add(plan, "voxelize.tiles",
                            4 * LSF_VOXEL_LIST_HEADER + 8 * (uint64_t)MAX_TILES,
                            "tiles of large triangles");
    uint64_t draws = plan->requirements.instances * sizeof(voxelize_draw);
    lsf_plan_buffer_add(plan, "voxelize.draws_start", draws, "instances in the order of draws");
    lsf_plan_buffer_add(plan, "voxelize.draws", draws,
                        "the same with how many voxels they have won");
    lsf_plan_buffer_add(plan, "voxelize.won", 4 * lsf_voxelize_won_voxels(grid),
                        "which voxels these are");
    lsf_voxelize_still_plan(plan, grid);
}
