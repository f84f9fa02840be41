#include "passes/voxelize_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "shared/scene_data.h"

/* Work groups of a row of bricks. */
#define BRICK_GROUPS (LSF_VOXEL_LIST_ROW / LSF_VOXEL_GROUP_BRICKS)

/* Locations in voxelize.geom.glsl, voxelize_write and voxelize_list.glsl. */
#define LOCATION_SIDE 27
#define LOCATION_DRAW 28
#define LOCATION_LIST_SIZES 29

void lsf_voxelize_textures(lsf_voxelize *pass, lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES])
{
    lsf_voxels *o = &pass->outputs;
    const lsf_voxelize_texture list[LSF_VOXELIZE_TEXTURES] = {
        {"voxelize.key", &pass->key},
        {"voxelize.occupancy_0", &o->occupancy[0]},
        {"voxelize.occupancy_1", &o->occupancy[1]},
        {"voxelize.albedo", &o->albedo},
        {"voxelize.normal", &o->normal},
        {"voxelize.shading", &o->shading},
        {"voxelize.point", &o->point},
        {"voxelize.emission", &o->emission},
        {"voxelize.shining", &o->shining},
        {"voxelize.specular_params", &o->specular_params},
        {"voxelize.transmission", &o->transmission}};
    memcpy(textures, list, sizeof list);
}

static bool create_textures(lsf_voxelize *pass, const lsf_plan *plan, lsf_error *error)
{
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    lsf_voxelize_textures(pass, textures);
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        if (!lsf_plan_create_texture_if_planned(plan, pass->context, textures[i].name,
                                                textures[i].texture, error))
            return false;
    glClearTexImage(pass->key, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    for (int level = 0; level < LSF_VOXEL_OCCUPANCY_LEVELS; level++)
        glClearTexImage(pass->outputs.occupancy[level], 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    if (pass->outputs.shining)
        glClearTexImage(pass->outputs.shining, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, NULL);
    return true;
}

/* `groups`: that a row of the list takes. */
static void empty_list(GLuint list, GLuint groups)
{
    const GLuint header[LSF_VOXEL_LIST_HEADER] = {groups, 0, 1, 0};
    glClearNamedBufferSubData(list, GL_RGBA32UI, 0, sizeof header, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                              header);
}

static bool create_lists(lsf_voxelize *pass, const lsf_plan *plan, lsf_error *error)
{
    if (!lsf_plan_create_buffer(plan, pass->context, "voxelize.bricks", NULL, 0, &pass->bricks[0],
                                error) ||
        !lsf_plan_create_buffer(plan, pass->context, "voxelize.previous_bricks", NULL, 0,
                                &pass->bricks[1], error) ||
        !lsf_plan_create_buffer_if_planned(plan, pass->context, "voxelize.tiles", NULL, 0,
                                           &pass->tiles, error) ||
        !lsf_plan_create_buffer(plan, pass->context, "voxelize.draws_start", NULL,
                                GL_DYNAMIC_STORAGE_BIT, &pass->draws_start, error) ||
        !lsf_plan_create_buffer(plan, pass->context, "voxelize.draws", NULL, 0, &pass->draws,
                                error) ||
        !lsf_plan_create_buffer(plan, pass->context, "voxelize.won", NULL, 0, &pass->won, error) ||
        !lsf_plan_create_buffer(plan, pass->context, "voxelize.grid", NULL, GL_DYNAMIC_STORAGE_BIT,
                                &pass->outputs.grid_buffer, error))
        return false;
    empty_list(pass->bricks[0], BRICK_GROUPS);
    empty_list(pass->bricks[1], BRICK_GROUPS);
    return true;
}

static bool create_programs(lsf_voxelize *pass, const lsf_plan *plan, bool raster, lsf_error *error)
{
    const struct {
        const char *pass, *files[5];
        GLuint *program;
        bool wanted;
    } programs[] = {
        {"voxelize_clear", {"passes/voxelize_clear.comp.glsl"}, &pass->clear_program, true},
        {"voxelize_mark", {"passes/voxelize_small.comp.glsl"}, &pass->small_program, !raster},
        {"voxelize_mark", {"passes/voxelize_large.comp.glsl"}, &pass->large_program, !raster},
        {"voxelize_mark",
         {"passes/voxelize.vert.glsl", "passes/voxelize.geom.glsl", "passes/voxelize.frag.glsl"},
         &pass->raster_program,
         raster},
        {"voxelize_list", {"passes/voxelize_count.comp.glsl"}, &pass->count_program, true},
        {"voxelize_list", {"passes/voxelize_sum.comp.glsl"}, &pass->sum_program, true},
        {"voxelize_list", {"passes/voxelize_place.comp.glsl"}, &pass->list_program, true},
        {"voxelize_write", {"passes/voxelize_write.comp.glsl"}, &pass->write_program, true},
        {"voxelize_beside", {"passes/voxelize_beside.comp.glsl"}, &pass->beside_program, true},
    };
    for (size_t i = 0; i < LSF_COUNT(programs); i++)
        if (programs[i].wanted &&
            !(*programs[i].program = lsf_plan_program(plan, pass->context, programs[i].pass,
                                                      programs[i].files, error)))
            return false;
    return true;
}

static bool create_framebuffer(lsf_voxelize *pass, lsf_error *error)
{
    const uint32_t *size = pass->grid.size;
    pass->side = size[0] > size[1] ? size[0] : size[1];
    pass->side = pass->side > size[2] ? pass->side : size[2];
    lsf_framebuffer_desc desc = {
        .label = "voxelize", .layer = -1, .width = pass->side, .height = pass->side};
    pass->framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    return pass->framebuffer != 0;
}

bool lsf_voxelize_create(lsf_voxelize **created, lsf_context *context, const lsf_plan *plan,
                         const lsf_voxelize_params *params, const lsf_voxel_grid *grid,
                         const lsf_scene *scene, lsf_error *error)
{
    lsf_voxelize *pass = *created = lsf_alloc(1, sizeof *pass);
    if (!pass)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
    bool raster = params->method == LSF_VOXELIZE_RASTER;
    pass->context = context;
    pass->grid = *grid;
    if (!lsf_triangle_fetch_create(&pass->fetch, context, error) ||
        !create_textures(pass, plan, error) || !create_lists(pass, plan, error) ||
        !lsf_voxelize_still_create(pass, plan, scene, error) ||
        !create_programs(pass, plan, raster, error) || (raster && !create_framebuffer(pass, error)))
        return false;
    pass->timer = lsf_timer_create(context, "voxelize", error);
    return pass->timer != NULL;
}

static void bind_image(GLuint unit, GLuint texture)
{
    glBindImageTexture(unit, texture, 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
}

static void bind_occupancy(const lsf_voxelize *pass)
{
    bind_image(0, pass->key);
    for (GLuint level = 0; level < LSF_VOXEL_OCCUPANCY_LEVELS; level++)
        bind_image(1 + level, pass->outputs.occupancy[level]);
    if (pass->outputs.shining)
        bind_image(1 + LSF_VOXEL_OCCUPANCY_LEVELS, pass->outputs.shining);
}

static void bind_attributes(const lsf_voxelize *pass)
{
    const lsf_voxels *o = &pass->outputs;
    const GLuint images[] = {pass->key,   o->albedo,          o->normal,       o->point,
                             o->emission, o->specular_params, o->transmission, o->shading};
    for (GLuint unit = 0; unit < LSF_COUNT(images); unit++)
        if (images[unit])
            bind_image(unit, images[unit]);
}

static void clear_before(lsf_voxelize *pass)
{
    GLuint list = pass->bricks[pass->runs % 2];
    bind_occupancy(pass);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, list);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list);
    glUseProgram(pass->clear_program);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

/* An instance of the draws. */
typedef struct instance_work {
    const lsf_iteration *iteration;
    uint32_t draw, instance, triangles, first_triangle;
} instance_work;

static void use_program(GLuint program, const instance_work *work)
{
    glUseProgram(program);
    glUniform1ui(0, work->first_triangle);
    lsf_triangle_fetch_instance(work->iteration, work->instance, 0, work->triangles);
}

static void use_mark_program(GLuint program, const instance_work *work)
{
    use_program(program, work);
    const lsf_plan *plan = work->iteration->plan;
    if (plan->requirements.blended || plan->voxel_chance)
        lsf_iteration_set_chance(work->iteration, LSF_PURPOSE_BLEND_VOXEL, 0);
}

static void mark_by_compute(lsf_voxelize *pass, const instance_work *work)
{
    uint32_t groups = (work->triangles + GROUP - 1) / GROUP;
    empty_list(pass->tiles, LSF_VOXEL_LIST_ROW / GROUP_TILES);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    use_mark_program(pass->small_program, work);
    glDispatchCompute(groups < ROW_GROUPS ? groups : ROW_GROUPS,
                      (groups + ROW_GROUPS - 1) / ROW_GROUPS, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
    use_mark_program(pass->large_program, work);
    glDispatchComputeIndirect(0);
}

static void mark_by_raster(lsf_voxelize *pass, const instance_work *work)
{
    use_mark_program(pass->raster_program, work);
    glUniform1f(LOCATION_SIDE, (float)pass->side);
    lsf_draw_vertices(pass->context, 3 * work->triangles);
}

static void write_surfaces(lsf_voxelize *pass, const instance_work *work)
{
    use_program(pass->write_program, work);
    glUniform1ui(LOCATION_DRAW, work->draw);
    glDispatchComputeIndirect((GLintptr)(work->draw * sizeof(voxelize_draw)));
}

/* Which instances: those that move, the others, or, where nothing is kept apart, all. */
typedef enum instance_group { GROUP_STILL, GROUP_MOVING } instance_group;

static bool in_group(const lsf_voxelize *pass, uint32_t instance, instance_group group)
{
    bool moves = pass->still.moves && pass->still.moves[instance];
    return moves == (group == GROUP_MOVING);
}

/* Calls `run_instance` for the instances of a group, in the order of their materials. */
static void for_group(lsf_voxelize *pass, const lsf_iteration *iteration, instance_group group,
                      void (*run_instance)(lsf_voxelize *pass, const instance_work *work))
{
    const lsf_scene_gpu *scene = iteration->scene;
    instance_work work = {.iteration = iteration};
    uint32_t bound = LSF_NONE;
    for (uint32_t i = 0; i < scene->draw_count; i++, work.first_triangle += work.triangles) {
        work.draw = i;
        work.instance = scene->draw_order[i];
        const lsf_instance_state *instance = &iteration->state->instances[work.instance];
        work.triangles = (uint32_t)(scene->scene->primitives[instance->primitive].index_count / 3);
        if (instance->skipped || !in_group(pass, work.instance, group))
            continue;
        if (instance->material != bound)
            lsf_scene_gpu_bind_material(scene, bound = instance->material, LSF_DRAW_SHADING);
        run_instance(pass, &work);
    }
}

static void count_work(lsf_voxelize *pass, const instance_work *work)
{
    pass->counts[LSF_VOXELIZE_INSTANCES]++;
    pass->counts[LSF_VOXELIZE_TRIANGLES] += work->triangles;
}

static void mark_group(lsf_voxelize *pass, const lsf_iteration *iteration, instance_group group)
{
    bind_occupancy(pass);
    if (pass->raster_program)
        lsf_begin_fullscreen(pass->framebuffer, pass->side, pass->side, pass->raster_program);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, pass->outputs.bricks);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_TILES, pass->tiles);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pass->tiles);
    for_group(pass, iteration, group, pass->raster_program ? mark_by_raster : mark_by_compute);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                    GL_BUFFER_UPDATE_BARRIER_BIT);
}

/* Sorts voxels by the instance that has won them: counts, sums, and places. */
static void list_winners(lsf_voxelize *pass, const lsf_iteration *iteration)
{
    /* NVIDIA's driver says 0 for length() of these storage buffers' arrays. */
    const GLuint programs[] = {pass->count_program, pass->sum_program, pass->list_program};
    for (size_t i = 0; i < LSF_COUNT(programs); i++)
        glProgramUniform2ui(programs[i], LOCATION_LIST_SIZES, iteration->scene->draw_count,
                            (GLuint)lsf_voxelize_won_voxels(&pass->grid));
    glCopyNamedBufferSubData(pass->draws_start, pass->draws, 0, 0,
                             (GLsizeiptr)(iteration->scene->draw_count * sizeof(voxelize_draw)));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_DRAWS, pass->draws);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_WON, pass->won);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pass->outputs.bricks);
    lsf_bind_texture(LSF_UNIT_VOXEL_OCCUPANCY, pass->outputs.occupancy[0]);
    glUseProgram(pass->count_program);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glUseProgram(pass->sum_program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(pass->list_program);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

/* Adds a group to the grid: bids, then surfaces. */
static void add_group(lsf_voxelize *pass, const lsf_iteration *iteration, instance_group group)
{
    for_group(pass, iteration, group, count_work);
    mark_group(pass, iteration, group);
    list_winners(pass, iteration);
    /* The occupancy's unit is one of the vertices'. */
    lsf_triangle_fetch_bind(&pass->fetch, iteration->scene);
    bind_attributes(pass);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pass->draws);
    for_group(pass, iteration, group, write_surfaces);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

/* Levels that let rays skip empty space. */
static void look_beside(lsf_voxelize *pass)
{
    const lsf_voxels *o = &pass->outputs;
    bind_image(0, o->normal);
    if (o->shining)
        bind_image(1, o->shining);
    if (o->emission)
        bind_image(2, o->emission);
    lsf_bind_texture(LSF_UNIT_VOXEL_OCCUPANCY, o->occupancy[0]);
    lsf_bind_texture(LSF_UNIT_VOXEL_POINT, o->point);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, o->bricks);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, o->bricks);
    glUseProgram(pass->beside_program);
    glDispatchComputeIndirect(0);
}

/* The numbers of each instance's triangles, which draws keep. */
static void upload_draws(lsf_voxelize *pass, const lsf_iteration *iteration)
{
    const lsf_scene_gpu *scene = iteration->scene;
    uint32_t first = 0;
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        const lsf_instance_state *instance = &iteration->state->instances[scene->draw_order[i]];
        uint32_t triangles =
            (uint32_t)(scene->scene->primitives[instance->primitive].index_count / 3);
        const voxelize_draw draw = {.first_triangle = first, .triangles = triangles};
        glNamedBufferSubData(pass->draws_start, (GLintptr)(i * sizeof draw), sizeof draw, &draw);
        first += triangles;
    }
}

/* The lists are swapped; the bricks of the last one are cleared. */
static void begin_run(lsf_voxelize *pass)
{
    lsf_voxels *o = &pass->outputs;
    clear_before(pass);
    pass->runs++;
    o->bricks = pass->bricks[pass->runs % 2];
    o->previous_bricks = pass->bricks[(pass->runs + 1) % 2];
}

void lsf_voxelize_follow(lsf_voxelize *pass, const lsf_voxel_grid *grid, bool anew)
{
    const lsf_voxel_grid *g = &pass->grid;
    pass->stale = pass->stale || anew || g->side != grid->side || g->unit != grid->unit ||
                  memcmp(g->origin, grid->origin, sizeof g->origin) != 0;
    pass->grid = *grid;
}

const lsf_voxels *lsf_voxelize_run(lsf_voxelize *pass, const lsf_iteration *iteration)
{
    struct lsf_voxel_grid_data data = lsf_voxel_grid_data(&pass->grid, iteration);
    lsf_voxels *o = &pass->outputs;
    bool moved = lsf_voxelize_still_moved(pass, iteration->state);
    bool anew = pass->runs == 0 || pass->stale ||
                lsf_voxelize_always_anew(iteration->plan, pass->grid.jitter);
    pass->stale = false;
    o->changed = anew || moved;
    if (!o->changed)
        return o;
    lsf_timer_begin(pass->timer);
    lsf_voxels_bind_grid(o);
    if (pass->runs == 0)
        upload_draws(pass, iteration);
    begin_run(pass);
    lsf_triangle_fetch_bind(&pass->fetch, iteration->scene);
    if (anew) {
        glNamedBufferSubData(o->grid_buffer, 0, sizeof data, &data);
        empty_list(o->bricks, BRICK_GROUPS);
        add_group(pass, iteration, GROUP_STILL);
        if (pass->still.moves)
            lsf_voxelize_still_keep(pass);
    } else {
        lsf_voxelize_still_restore(pass);
    }
    if (pass->still.moves)
        add_group(pass, iteration, GROUP_MOVING);
    look_beside(pass);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    lsf_timer_end(pass->timer);
    return o;
}

lsf_timer *lsf_voxelize_timer(lsf_voxelize *pass)
{
    return pass->timer;
}

const uint64_t *lsf_voxelize_counts(const lsf_voxelize *pass)
{
    return pass->counts;
}

void lsf_voxelize_destroy(lsf_voxelize *pass)
{
    if (!pass)
        return;
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    lsf_voxelize_textures(pass, textures);
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        lsf_texture_destroy(pass->context, textures[i].texture);
    lsf_voxelize_still_destroy(pass);
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_buffer_destroy(pass->context, &pass->bricks[0]);
    lsf_buffer_destroy(pass->context, &pass->bricks[1]);
    lsf_buffer_destroy(pass->context, &pass->tiles);
    lsf_buffer_destroy(pass->context, &pass->draws_start);
    lsf_buffer_destroy(pass->context, &pass->draws);
    lsf_buffer_destroy(pass->context, &pass->won);
    lsf_buffer_destroy(pass->context, &pass->outputs.grid_buffer);
    lsf_triangle_fetch_destroy(&pass->fetch);
    lsf_timer_destroy(pass->timer);
    free(pass);
}
