#include "passes/voxel_mip.h"

#include <string.h>

#include "shared/scene_data.h"

/* Levels that are written where bricks are; one brick is one texel of the last of them. */
#define LISTED_LEVELS 2

/* Storage buffer. */
#define BINDING_BRICKS 1

/* Locations of the uniforms. */
#define LOCATION_LEVEL 0
#define LOCATION_EMPTY 1

/* Side of the work groups that write whole levels. */
#define GROUP 4

void lsf_voxel_mip_plan(lsf_plan *plan, uint32_t sides)
{
    lsf_plan_pass_add(plan, "voxel_mip", "what voxels look like from afar");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)sides,
                        "directions that radiance is kept for");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
}

bool lsf_voxel_mip_create(lsf_voxel_mip *pass, lsf_context *context, const lsf_plan *plan,
                          const lsf_voxel_grid *grid, uint32_t sides, lsf_error *error)
{
    static const char *const bricks_files[5] = {"passes/voxel_mip_bricks.comp.glsl"};
    static const char *const whole_files[5] = {"passes/voxel_mip_whole.comp.glsl"};
    *pass = (lsf_voxel_mip){.context = context, .grid = *grid, .sides = sides};
    pass->bricks_program = lsf_plan_program(plan, context, "voxel_mip", bricks_files, error);
    if (!pass->bricks_program)
        return false;
    pass->whole_program = lsf_plan_program(plan, context, "voxel_mip", whole_files, error);
    if (!pass->whole_program)
        return false;
    pass->timer = lsf_timer_create(context, "voxel_mip", error);
    return pass->timer != NULL;
}

static void write_listed(GLuint radiance, GLuint bricks, int level, bool empty)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, bricks);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, bricks);
    glBindImageTexture(0, radiance, level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glUniform1i(LOCATION_LEVEL, level);
    glUniform1i(LOCATION_EMPTY, empty);
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

static GLuint groups(uint32_t texels)
{
    return (texels + GROUP - 1) / GROUP;
}

static void write_whole(const lsf_voxel_mip *pass, GLuint radiance, int level)
{
    const uint32_t *size = pass->grid.size;
    glBindImageTexture(0, radiance, level, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glUniform1i(LOCATION_LEVEL, level);
    glDispatchCompute(groups(size[0] >> level), groups(size[1] >> level),
                      groups((size[2] >> level) * pass->sides));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void lsf_voxel_mip_run(lsf_voxel_mip *pass, const lsf_voxel_mip_inputs *inputs)
{
    lsf_timer_begin(pass->timer);
    glBindTextureUnit(LSF_UNIT_VOXEL_RADIANCE, inputs->radiance);
    glUseProgram(pass->bricks_program);
    for (int level = 1; level <= LISTED_LEVELS; level++) {
        if (inputs->changed)
            write_listed(inputs->radiance, inputs->previous_bricks, level, true);
        write_listed(inputs->radiance, inputs->bricks, level, false);
    }
    glUseProgram(pass->whole_program);
    for (int level = LISTED_LEVELS + 1; level < LSF_VOXEL_LEVELS; level++)
        write_whole(pass, inputs->radiance, level);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_mip_destroy(lsf_voxel_mip *pass)
{
    if (!pass->context)
        return;
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
