#include "passes/voxel_mip.h"

#include <string.h>

#include "base/base.h"
#include "shared/scene_data.h"

/* The last of the levels that are written where bricks are: one brick is one texel of it. */
#define BRICK_LEVEL 2

/* Storage buffer. */
#define BINDING_BRICKS 1

/* Uniform of voxel_mip_whole. */
#define LOCATION_LEVEL 0

/* Side of the work groups that write whole levels. */
#define GROUP 4

void lsf_voxel_mip_plan(lsf_plan *plan, uint32_t sides)
{
    lsf_plan_pass_add(plan, "voxel_mip", "what voxels look like from afar");
    lsf_plan_reads(plan, "voxelize voxel_light voxel_bounce");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)sides,
                        "directions that radiance is kept for");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
}

bool lsf_voxel_mip_create(lsf_voxel_mip *pass, lsf_context *context, const lsf_plan *plan,
                          const lsf_voxel_grid *grid, uint32_t sides, lsf_error *error)
{
    *pass = (lsf_voxel_mip){.context = context, .grid = *grid, .sides = sides};
    const struct {
        const char *files[5];
        GLuint *program;
    } programs[] = {{{"passes/voxel_mip_clear.comp.glsl"}, &pass->clear_program},
                    {{"passes/voxel_mip_fine.comp.glsl"}, &pass->fine_program},
                    {{"passes/voxel_mip_brick.comp.glsl"}, &pass->brick_program},
                    {{"passes/voxel_mip_whole.comp.glsl"}, &pass->whole_program}};
    for (size_t i = 0; i < LSF_COUNT(programs); i++)
        if (!(*programs[i].program =
                  lsf_plan_program(plan, context, "voxel_mip", programs[i].files, error)))
            return false;
    pass->timer = lsf_timer_create(context, "voxel_mip", error);
    return pass->timer != NULL;
}

static void bind_level(GLuint unit, GLuint radiance, int level)
{
    glBindImageTexture(unit, radiance, level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
}

static void dispatch_bricks(GLuint program, GLuint bricks)
{
    glUseProgram(program);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, bricks);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, bricks);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

/* Levels 1 and 2, which are empty where no brick is. */
static void write_bricks(const lsf_voxel_mip *pass, const lsf_voxels *voxels, GLuint radiance)
{
    bind_level(0, radiance, 1);
    bind_level(1, radiance, BRICK_LEVEL);
    if (voxels->changed)
        dispatch_bricks(pass->clear_program, voxels->previous_bricks);
    dispatch_bricks(pass->fine_program, voxels->bricks);
    bind_level(0, radiance, BRICK_LEVEL);
    dispatch_bricks(pass->brick_program, voxels->bricks);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

static GLuint groups(uint32_t texels)
{
    return (texels + GROUP - 1) / GROUP;
}

static void write_whole(const lsf_voxel_mip *pass, GLuint radiance, int level)
{
    const uint32_t *size = pass->grid.size;
    bind_level(0, radiance, level);
    glUniform1i(LOCATION_LEVEL, level);
    glDispatchCompute(groups(size[0] >> level), groups(size[1] >> level),
                      groups((size[2] >> level) * pass->sides));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void lsf_voxel_mip_run(lsf_voxel_mip *pass, const lsf_voxels *voxels, GLuint radiance)
{
    lsf_timer_begin(pass->timer);
    lsf_voxels_bind_grid(voxels);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, radiance);
    write_bricks(pass, voxels, radiance);
    glUseProgram(pass->whole_program);
    for (int level = BRICK_LEVEL + 1; level < LSF_VOXEL_LEVELS; level++)
        write_whole(pass, radiance, level);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_mip_destroy(lsf_voxel_mip *pass)
{
    if (!pass->context)
        return;
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
