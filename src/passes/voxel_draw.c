#include "passes/voxel_draw.h"

#include <string.h>

#include "base/base.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "shared/scene_data.h"
#include "shared/voxel_draw_data.h"

/* Storage buffer. */
#define BINDING_BRICKS 1

/* Uniform of passes/voxel_draw_pick.comp.glsl. */
#define LOCATION_SEED 0

#define PICK_GROUP (LSF_VOXEL_BRICK_LANES * LSF_VOXEL_GROUP_BRICKS)

_Static_assert(LSF_VOXEL_DRAWS % PICK_GROUP == 0, "whole work groups");

/* Bits of a brick's place along the grid's longest axis. */
static int brick_bits(const lsf_voxel_grid *grid)
{
    int bits = 0;
    for (int axis = 0; axis < 3; axis++)
        while ((1u << bits) < grid->size[axis] / LSF_VOXEL_BRICK)
            bits++;
    return bits;
}

void lsf_voxel_draw_plan(lsf_plan *plan, const lsf_voxel_grid *grid, uint32_t sides, bool emitters)
{
    int bits = brick_bits(grid);
    lsf_plan_pass_add(plan, "voxel_draw", "%d sides of voxels, drawn by their radiance",
                      LSF_VOXEL_DRAWS);
    lsf_plan_reads(plan, "voxelize voxel_light voxel_bounce");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)sides, "sides that radiance is kept for");
    lsf_plan_switch_add(plan, "LSF_EMITTERS", emitters, "points on emitters find emission");
    lsf_plan_switch_add(plan, "LSF_EMISSION", emitters, "some material emits");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
    lsf_plan_switch_add(plan, "LSF_VOXEL_DRAW_BITS", bits, "2 to this power bricks fill the grid");
    lsf_plan_buffer_add(plan, "voxel_draw.list",
                        (LSF_VOXEL_DRAWS_HEADER + 2 * LSF_VOXEL_DRAWS) * sizeof(uint32_t),
                        "the drawn sides");
    lsf_plan_buffer_add(plan, "voxel_draw.bricks", ((uint64_t)1 << (3 * bits)) * sizeof(float),
                        "sums of radiance over bricks");
}

bool lsf_voxel_draw_create(lsf_voxel_draw *pass, lsf_context *context, const lsf_plan *plan,
                           lsf_error *error)
{
    *pass = (lsf_voxel_draw){.context = context};
    const struct {
        const char *files[5];
        GLuint *program;
    } programs[] = {{{"passes/voxel_draw_sum.comp.glsl"}, &pass->sum_program},
                    {{"passes/voxel_draw_scan.comp.glsl"}, &pass->scan_program},
                    {{"passes/voxel_draw_pick.comp.glsl"}, &pass->pick_program}};
    if (!lsf_plan_create_buffer(plan, context, "voxel_draw.list", NULL, 0, &pass->list, error) ||
        !lsf_plan_create_buffer(plan, context, "voxel_draw.bricks", NULL, 0, &pass->bricks, error))
        return false;
    for (size_t i = 0; i < LSF_COUNT(programs); i++)
        if (!(*programs[i].program =
                  lsf_plan_program(plan, context, "voxel_draw", programs[i].files, error)))
            return false;
    pass->timer = lsf_timer_create(context, "voxel_draw", error);
    return pass->timer != NULL;
}

void lsf_voxel_draw_begin(lsf_voxel_draw *pass)
{
    pass->runs = 0;
}

static void dispatch(GLuint program, GLuint groups)
{
    glUseProgram(program);
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void lsf_voxel_draw_run(lsf_voxel_draw *pass, const lsf_iteration *iteration,
                        const lsf_voxels *voxels, GLuint radiance)
{
    lsf_timer_begin(pass->timer);
    lsf_voxels_bind(voxels);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, radiance);
    /* The sums and the list of the last run may still be in use. */
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    glClearNamedBufferData(pass->bricks, GL_R32F, GL_RED, GL_FLOAT, NULL);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, voxels->bricks);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VOXEL_DRAWS, pass->list);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VOXEL_DRAW_BRICKS, pass->bricks);
    glUseProgram(pass->sum_program);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, voxels->bricks);
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(pass->scan_program, 1);
    uint32_t seed = lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_DRAW);
    glProgramUniform1ui(pass->pick_program, LOCATION_SEED,
                        lsf_hash(lsf_hash(seed, iteration->index), pass->runs++));
    dispatch(pass->pick_program, LSF_VOXEL_DRAWS / PICK_GROUP);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_draw_destroy(lsf_voxel_draw *pass)
{
    if (!pass->context)
        return;
    lsf_buffer_destroy(pass->context, &pass->list);
    lsf_buffer_destroy(pass->context, &pass->bricks);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
