#include "passes/voxel_light.h"

#include <string.h>

#include "base/base.h"
#include "frame/light_walls.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "shared/scene_data.h"

/* Storage buffer. */
#define BINDING_BRICKS 1

/* Programs of one shader. */
typedef struct variant {
    const char *name, *what, *reads;
    bool emit, reflect, sky;
    size_t program; /* offset in the pass */
} variant;

static const variant variants[] = {
    {"voxel_light_emit", "what voxels emit, in the place of what was there", "voxelize", true,
     false, false, offsetof(lsf_voxel_light, emit_program)},
    {"voxel_light_first", "the same, and what they reflect of the first light",
     "voxelize shadow_map", true, true, false, offsetof(lsf_voxel_light, first_program)},
    {"voxel_light_add", "what they reflect of another light", "voxelize shadow_map", false, true,
     false, offsetof(lsf_voxel_light, add_program)},
    {"voxel_light_sky", "what they reflect of directions of the environment", "voxelize sky_map",
     false, true, true, offsetof(lsf_voxel_light, sky_program)},
};

static bool needed(const variant *v, const lsf_plan *plan, const lsf_voxel_light_use *use)
{
    return !v->reflect || (v->sky ? plan->sky_lights > 0 : use->lights);
}

static void plan_sides(lsf_plan *plan, const lsf_voxel_light_use *use)
{
    lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", (int)use->sides,
                        "sides that radiance is kept for");
    lsf_plan_switch_add(plan, "LSF_BINDING_BRICKS", BINDING_BRICKS, "always");
}

static void plan_variant(lsf_plan *plan, const variant *v, const lsf_voxel_light_use *use)
{
    bool tint = v->sky ? lsf_plan_find_pass(plan, "sky_map_straight") != NULL
                       : lsf_light_walls_needed(plan);
    lsf_plan_pass_add(plan, v->name, "%s", v->what);
    lsf_plan_reads(plan, v->reads);
    plan_sides(plan, use);
    lsf_plan_switch_add(plan, "LSF_EMIT", v->emit, "part of the program's purpose");
    lsf_plan_switch_add(plan, "LSF_REFLECT", v->reflect, "the same");
    lsf_voxel_bend_switch(plan);
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_SPECULAR", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_voxel_specular_params_switch(plan);
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_plan_switch_add(plan, "LSF_SHADOW_TINT", v->reflect && tint,
                        "light passes surfaces on its way");
    lsf_plan_switch_add(plan, "LSF_SHADOW_PCF", use->pcf ? 2 : 0,
                        "shadow.filter; texels are small beside voxels");
    lsf_plan_switch_add(plan, "LSF_SHADOW_SKY", v->sky, "directions of the environment");
    lsf_voxel_lamps_switch(plan, use->lamps);
    if (v->reflect && !v->sky)
        lsf_light_switches(plan);
}

void lsf_voxel_light_plan(lsf_plan *plan, const lsf_voxel_grid *grid,
                          const lsf_voxel_light_use *use)
{
    lsf_plan_pass_add(plan, "voxel_light_clear", "the light of voxels that were");
    lsf_plan_reads(plan, "voxelize");
    plan_sides(plan, use);
    for (size_t i = 0; i < LSF_COUNT(variants); i++)
        if (needed(&variants[i], plan, use))
            plan_variant(plan, &variants[i], use);
    lsf_voxel_texture_plan(plan, grid, "voxel_light.radiance", GL_RGBA16F, use->sides, use->levels,
                           "radiance of each side of a voxel's surface");
    if (use->lamps)
        lsf_voxel_texture_plan(plan, grid, "voxel_light.lamps", GL_RGBA32UI, use->sides, 1,
                               "a light that each side mirrors, of smooth metal");
}

bool lsf_voxel_light_create(lsf_voxel_light *pass, lsf_context *context, const lsf_plan *plan,
                            const lsf_voxel_light_use *use, lsf_error *error)
{
    static const char *const files[5] = {"passes/voxel_light.comp.glsl"};
    static const char *const clear_files[5] = {"lib/voxel_sides_clear.comp.glsl"};
    *pass = (lsf_voxel_light){.context = context, .use = *use};
    if (!lsf_plan_create_texture(plan, context, "voxel_light.radiance", &pass->radiance, error) ||
        !lsf_plan_create_texture_if_planned(plan, context, "voxel_light.lamps", &pass->lamps,
                                            error))
        return false;
    for (uint32_t level = 0; level < use->levels; level++)
        glClearTexImage(pass->radiance, (GLint)level, GL_RGBA, GL_FLOAT, NULL);
    for (size_t i = 0; i < LSF_COUNT(variants); i++) {
        GLuint *program = (GLuint *)((char *)pass + variants[i].program);
        if (lsf_plan_find_pass(plan, variants[i].name) &&
            !(*program = lsf_plan_program(plan, context, variants[i].name, files, error)))
            return false;
    }
    pass->clear_program = lsf_plan_program(plan, context, "voxel_light_clear", clear_files, error);
    pass->timer = lsf_timer_create(context, "voxel_light", error);
    return pass->clear_program && pass->timer;
}

static void dispatch(const lsf_voxel_light *pass, GLuint program, GLuint list)
{
    glBindImageTexture(0, pass->radiance, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
    glBindImageTexture(1, pass->lamps, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32UI);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BINDING_BRICKS, list);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list);
    glUseProgram(program);
    glDispatchComputeIndirect(0);
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT | /* the list tells which sides are stored */
                    GL_COMMAND_BARRIER_BIT);        /* and how many work groups it takes */
}

/* Of units two are others than lsf_voxels_bind takes, which are those of shadow maps and of
 * radiance. */
static void bind_voxels(const lsf_voxels *voxels)
{
    lsf_voxels_bind_grid(voxels);
    lsf_bind_texture(LSF_UNIT_VOXEL_ALBEDO, voxels->albedo);
    lsf_bind_texture(LSF_UNIT_VOXEL_NORMAL, voxels->normal);
    lsf_bind_texture(LSF_UNIT_VOXEL_SHADING, voxels->shading);
    lsf_bind_texture(LSF_UNIT_VOXEL_SPECULAR_PARAMS, voxels->point);
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, voxels->specular_params);
    lsf_bind_texture(LSF_UNIT_VOXEL_EMISSION, voxels->emission);
    lsf_bind_texture(LSF_UNIT_VOXEL_TRANSMISSION, voxels->transmission);
}

/* Lights of all runs of all iterations differ in whether they are kept. */
static void set_seed(lsf_voxel_light *pass, const lsf_iteration *iteration, GLuint program)
{
    uint32_t seed = lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_LAMP);
    if (pass->lamps)
        glProgramUniform1ui(program, LSF_LOCATION_LAMP_SEED,
                            lsf_hash(lsf_hash(seed, iteration->index), pass->runs++));
}

void lsf_voxel_light_begin(lsf_voxel_light *pass, const lsf_voxels *voxels)
{
    pass->written = false;
    pass->runs = 0;
    if (!voxels->changed || pass->use.levels == 1)
        return;
    lsf_timer_begin(pass->timer);
    lsf_voxels_bind_grid(voxels);
    dispatch(pass, pass->clear_program, voxels->previous_bricks);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_light_emit(lsf_voxel_light *pass, const lsf_voxels *voxels)
{
    if (pass->written)
        return;
    lsf_timer_begin(pass->timer);
    bind_voxels(voxels);
    dispatch(pass, pass->emit_program, voxels->bricks);
    lsf_timer_end(pass->timer);
    pass->written = true;
}

void lsf_voxel_light_add(lsf_voxel_light *pass, const lsf_iteration *iteration,
                         const lsf_voxels *voxels, const lsf_shadow *shadow)
{
    GLuint program = pass->written ? pass->add_program : pass->first_program;
    lsf_timer_begin(pass->timer);
    bind_voxels(voxels);
    lsf_shadow_bind(shadow);
    set_seed(pass, iteration, program);
    dispatch(pass, program, voxels->bricks);
    lsf_timer_end(pass->timer);
    pass->written = true;
}

void lsf_voxel_light_add_sky(lsf_voxel_light *pass, const lsf_iteration *iteration,
                             const lsf_voxels *voxels, const lsf_shadow *maps, uint32_t count)
{
    lsf_voxel_light_emit(pass, voxels);
    lsf_timer_begin(pass->timer);
    bind_voxels(voxels);
    lsf_shadow_bind(maps);
    set_seed(pass, iteration, pass->sky_program);
    glProgramUniform1i(pass->sky_program, 0, (GLint)count);
    glProgramUniform1f(pass->sky_program, LSF_LOCATION_SKY_CHANCE, pass->use.sky_rays);
    dispatch(pass, pass->sky_program, voxels->bricks);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_light_destroy(lsf_voxel_light *pass)
{
    if (!pass->context)
        return;
    lsf_texture_destroy(pass->context, &pass->radiance);
    lsf_texture_destroy(pass->context, &pass->lamps);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
