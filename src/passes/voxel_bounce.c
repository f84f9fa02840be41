#include "passes/voxel_bounce.h"

#include <string.h>

#include "shared/scene_data.h"

/* Storage buffer. */
#define BINDING_BRICKS 2
/* Texture unit and uniform of passes/voxel_bounce.comp.glsl. */
#define UNIT_BASE 1
#define LOCATION_SUM_OF 0
#define LOCATION_SKY_RAYS 1

static const char *const radiance_names[2] = {"voxel_bounce.radiance",
                                              "voxel_bounce.other_radiance"};

void lsf_voxel_bounce_plan(lsf_plan *plan, const lsf_cone_params *params,
                           const lsf_voxel_grid *grid, bool of_own, bool lamps)
{
    uint32_t slices = lsf_cone_slices(params), levels = lsf_cone_levels(params);
    lsf_plan_pass_add(plan, "voxel_bounce", "what voxels reflect of each other's light");
    lsf_plan_reads(plan, "voxelize voxel_light voxel_draw");
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)slices, "cone.sides");
    lsf_plan_switch_add(plan, "LSF_SEALED", params->sealed, "cone.sealed");
    lsf_plan_switch_add(plan, "LSF_VOXEL_DRAW", lsf_cone_draws(params), "cone.draws");
    lsf_cone_emission_switches(plan, params);
    lsf_voxel_bend_switch(plan);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_voxel_specular_params_switch(plan);
    lsf_voxel_lamps_switch(plan, lamps);
    if (plan->transmission)
        lsf_plan_switch_add(plan, "LSF_TRANSMISSION", true, "light passes materials that transmit");
    lsf_voxel_passage_switches(plan);
    lsf_scene_gpu_environment_switches(plan, "an environment shines");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
    for (int i = 0; i < (of_own ? 2 : 1); i++)
        lsf_voxel_texture_plan(plan, grid, radiance_names[i], GL_RGBA16F, slices, levels,
                               "radiance of voxels with what they reflect");
    if (!of_own)
        lsf_plan_omit(plan, radiance_names[1], "light goes from voxel to voxel once");
}

/* A texture that the plan does not list is left out. */
static bool create_radiance(lsf_voxel_bounce *pass, const lsf_plan *plan, lsf_error *error)
{
    for (int i = 0; i < 2; i++) {
        if (!lsf_plan_create_texture_if_planned(plan, pass->context, radiance_names[i],
                                                &pass->radiance[i], error))
            return false;
        for (uint32_t level = 0; pass->radiance[i] && level < pass->levels; level++)
            glClearTexImage(pass->radiance[i], (GLint)level, GL_RGBA, GL_FLOAT, NULL);
    }
    return true;
}

bool lsf_voxel_bounce_create(lsf_voxel_bounce *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_cone_params *params, const lsf_voxel_grid *grid,
                             lsf_error *error)
{
    static const char *const files[5] = {"passes/voxel_bounce.comp.glsl"};
    static const char *const clear_files[5] = {"lib/voxel_sides_clear.comp.glsl"};
    *pass = (lsf_voxel_bounce){
        .context = context, .params = *params, .grid = *grid, .levels = lsf_cone_levels(params)};
    if (!create_radiance(pass, plan, error))
        return false;
    pass->program = lsf_plan_program(plan, context, "voxel_bounce", files, error);
    if (!pass->program)
        return false;
    pass->clear_program = lsf_plan_program(plan, context, "voxel_bounce", clear_files, error);
    if (!pass->clear_program)
        return false;
    pass->timer = lsf_timer_create(context, "voxel_bounce", error);
    return pass->timer != NULL;
}

static void dispatch(GLuint radiance, GLuint bricks)
{
    glBindImageTexture(0, radiance, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, bricks);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, bricks);
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
}

void lsf_voxel_bounce_begin(lsf_voxel_bounce *pass, const lsf_voxels *voxels)
{
    if (!voxels->changed || pass->levels == 1)
        return;
    lsf_timer_begin(pass->timer);
    lsf_voxels_bind_grid(voxels);
    glUseProgram(pass->clear_program);
    for (int i = 0; i < 2 && pass->radiance[i]; i++)
        dispatch(pass->radiance[i], voxels->previous_bricks);
    lsf_timer_end(pass->timer);
}

static int32_t part_of(int32_t count, int32_t parts)
{
    return (count + parts - 1) / parts;
}

/* Cones, draws and points on emitters of a voxel. A third of a visible point's cones will do:
 * visible points gather the light of many voxels, whose directions differ. Light that is reflected
 * again before it is seen counts less, so that even fewer rays find it. All are needed of marching
 * cones, which fill the hemisphere, and where directions do not change from iteration to iteration.
 */
static lsf_cone_params voxel_cones(const lsf_cone_params *seen, uint32_t later)
{
    enum { SEEN = 3 };
    int32_t parts = 1 + (int32_t)later;
    lsf_cone_params cones = *seen;
    if (seen->sealed && seen->jitter) {
        cones.count = part_of(seen->count, SEEN * parts);
        cones.draws = part_of(seen->draws, parts);
        cones.emitters = part_of(seen->emitters, parts);
    }
    return cones;
}

GLuint lsf_voxel_bounce_run(lsf_voxel_bounce *pass, const lsf_iteration *iteration,
                            const lsf_voxels *voxels, const lsf_voxel_bounce_sum *sum)
{
    if (sum->source && sum->source == pass->radiance[pass->last])
        pass->last = 1 - pass->last;
    GLuint radiance = pass->radiance[pass->last];
    lsf_timer_begin(pass->timer);
    glUseProgram(pass->program);
    glUniform3i(LOCATION_SUM_OF, sum->keep, sum->base != 0, sum->source != 0);
    /* A term that is left out has the other's texture: software GL would compile the program again
     * for a unit without a texture. */
    lsf_bind_texture(UNIT_BASE, sum->base ? sum->base : sum->source);
    lsf_voxels_bind(voxels);
    if (sum->source) {
        lsf_cone_params cones = voxel_cones(&pass->params, sum->later);
        lsf_cone_bind(&cones, &pass->grid, iteration, sum->source, sum->draws);
        if (sum->lamps)
            lsf_voxel_lamps_bind(iteration, &pass->grid, sum->lamps, sum->lit);
        if (sum->emitters)
            lsf_emitter_points_bind(sum->emitters, cones.emitters);
    } else {
        lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, sum->base);
    }
    lsf_voxel_passage_bind(iteration);
    lsf_scene_gpu_bind_environment(iteration->scene);
    if (iteration->plan->requirements.environment) {
        lsf_iteration_bind_sky(iteration);
        glUniform1f(LOCATION_SKY_RAYS, (float)pass->params.count);
    }
    dispatch(radiance, voxels->bricks);
    lsf_timer_end(pass->timer);
    return radiance;
}

void lsf_voxel_bounce_destroy(lsf_voxel_bounce *pass)
{
    if (!pass->context)
        return;
    for (int i = 0; i < 2; i++)
        lsf_texture_destroy(pass->context, &pass->radiance[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
