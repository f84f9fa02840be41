#include "passes/voxel_path.h"
#include "frame/purpose.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "shared/scene_data.h"
#include "shared/voxel_draw_data.h"

/* Side of the texture of random numbers, a power of two; as in the paper. */
#define RANDOM_SIZE 512

const lsf_option_row lsf_voxel_path_options[LSF_VOXEL_PATH_OPTION_COUNT] = {
    {"voxel_path.min_samples", LSF_OPTION_INT, offsetof(lsf_voxel_path_params, min_samples), 1,
     LSF_VOXEL_PATH_MOST, NULL, "paths", "paths that begin at a pixel of roughness 0"},
    {"voxel_path.max_samples", LSF_OPTION_INT, offsetof(lsf_voxel_path_params, max_samples), 0,
     LSF_VOXEL_PATH_MOST, NULL, "paths",
     "paths that begin at a pixel of roughness 1, or of glass; 0: 4, or fewer where there is no "
     "glass and a time limit leaves software OpenGL too little time for them"},
    {"voxel_path.emitters", LSF_OPTION_INT, offsetof(lsf_voxel_path_params, emitters), 0, 16, NULL,
     "points",
     "points sampled on emissive surfaces at each vertex of a path; 0: paths find these by chance"},
    {"voxel_path.draws", LSF_OPTION_INT, offsetof(lsf_voxel_path_params, draws), 0, 16, NULL,
     "rays", "rays at each vertex of a path towards voxels drawn by their radiance"},
    {"voxel_path.sequence", LSF_OPTION_ENUM, offsetof(lsf_voxel_path_params, sequence), 0, 0,
     "sobol|texture", "", "random numbers: low-discrepancy, or from a texture as in the paper"},
};

/* Condition of textures, beside LSF_TEXTURE_SPECULAR. */
enum { DIRECT = 2 };

#define AT(member) offsetof(lsf_voxel_path, outputs.member)

static const lsf_texture_row textures[] = {
    {"voxel_path.irradiance", GL_RGBA32F, AT(light.irradiance), 0,
     "the diffuse part, without albedo"},
    {"voxel_path.specular", GL_RGBA32F, AT(light.specular), LSF_TEXTURE_SPECULAR,
     "the specular part"},
    {"voxel_path.direct_irradiance", GL_RGBA32F, AT(direct.irradiance), DIRECT,
     "direct light, apart"},
    {"voxel_path.direct_specular", GL_RGBA32F, AT(direct.specular), DIRECT | LSF_TEXTURE_SPECULAR,
     "direct light, apart"},
};

static const char emitter_name[] = "voxel_path.emitters";

uint32_t lsf_voxel_path_segments(const lsf_plan *plan, bool punctual)
{
    const lsf_requirements *r = &plan->requirements;
    if (r->emissive || r->unlit || r->environment)
        return plan->bounces + 1;
    return punctual ? plan->bounces : 0;
}

bool lsf_voxel_path_emitters(const lsf_plan *plan, const lsf_voxel_path_params *params)
{
    return plan->requirements.emissive && params->emitters > 0;
}

/* Points on emissive surfaces that vertices of paths are joined to. */
static void plan_emitters(lsf_plan *plan, const lsf_voxel_path_params *params)
{
    bool wanted = lsf_voxel_path_emitters(plan, params);
    lsf_plan_switch_add(plan, "LSF_EMITTERS", wanted,
                        "some material emits, and voxel_path.emitters is not 0");
    if (wanted)
        lsf_emitter_points_plan(plan, emitter_name);
}

void lsf_voxel_path_plan(lsf_plan *plan, const lsf_voxel_path_params *params,
                         const lsf_voxel_path_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    bool specular_params = lsf_gbuffer_specular_params(plan) != GL_NONE;
    bool texture = params->sequence == LSF_VOXEL_PATH_TEXTURE;
    uint32_t size[2];
    lsf_plan_pass_add(plan, "voxel_path", "up to %d path%s of %u segment%s through the voxels",
                      params->max_samples, lsf_plural((uint64_t)params->max_samples), use->segments,
                      lsf_plural(use->segments));
    lsf_plan_reads(plan, "view points|gbuffer voxelize voxel_light voxel_draw");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_sparse_grid_switch(plan);
    lsf_plan_switch_add(plan, "LSF_SPECULAR", r->specular, "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PARAMS", specular_params, "roughness or metallic vary");
    lsf_voxel_specular_params_switch(plan);
    lsf_voxel_bend_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ANISOTROPY", specular_params && r->anisotropic,
                        "some material is anisotropic");
    lsf_scene_gpu_lobe_switches(plan, specular_params);
    lsf_plan_switch_add(plan, "LSF_TRANSMISSION", plan->transmission,
                        "light passes materials that transmit");
    lsf_scene_gpu_scatter_switch(plan);
    lsf_plan_switch_add(plan, "LSF_ABSORPTION", plan->transmission && r->refractive,
                        "some material is the surface of a medium");
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    plan_emitters(plan, params);
    lsf_plan_switch_add(plan, "LSF_VOXEL_DRAW", use->draws,
                        "light bounces, and voxel_path.draws is not 0");
    if (use->draws)
        lsf_plan_switch_add(plan, "LSF_VOXEL_SIDES", LSF_VOXEL_SIDES_SURFACE, "always");
    lsf_scene_gpu_environment_switches(plan, "paths may leave the scene");
    lsf_plan_switch_add(plan, "LSF_VOXEL_MIRRORS", use->mirrors,
                        "smooth metals mirror what is around them");
    lsf_voxel_lamps_switch(plan, use->lamps);
    lsf_plan_switch_add(plan, "LSF_RANDOM_TEXTURE", texture, "voxel_path.sequence is texture");
    lsf_plan_switch_add(plan, "LSF_SPLIT_DIRECT", use->split_direct,
                        "direct light is asked for apart");
    lsf_sparse_grid_texture_size(plan, size);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), use->split_direct ? DIRECT : 0,
                          size[0], size[1]);
    if (texture)
        lsf_plan_texture_add(plan, "voxel_path.random", GL_RGBA32F, RANDOM_SIZE, RANDOM_SIZE,
                             "random numbers, the same for all iterations");
}

/* The same for every seed, which decides where it is read. */
static bool create_random(lsf_voxel_path *pass, const lsf_plan *plan, lsf_error *error)
{
    if (!lsf_plan_create_texture_if_planned(plan, pass->context, "voxel_path.random", &pass->random,
                                            error))
        return false;
    if (!pass->random)
        return true;
    const uint32_t count = 4 * RANDOM_SIZE * RANDOM_SIZE;
    float *numbers = lsf_alloc(count, sizeof *numbers);
    if (!numbers)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for random numbers");
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = lsf_random_float(LSF_PURPOSE_VOXEL_PATH, i);
    glTextureSubImage2D(pass->random, 0, 0, 0, RANDOM_SIZE, RANDOM_SIZE, GL_RGBA, GL_FLOAT,
                        numbers);
    free(numbers);
    return true;
}

bool lsf_voxel_path_create(lsf_voxel_path *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_voxel_path_params *params, const lsf_voxel_path_use *use,
                           const lsf_scene *scene, const lsf_state *state, lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/voxel_path.frag.glsl"};
    *pass = (lsf_voxel_path){.context = context, .params = *params, .segments = use->segments};
    const lsf_voxel_path_outputs *out = &pass->outputs;
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !create_random(pass, plan, error) ||
        (lsf_plan_find(plan, emitter_name) &&
         !lsf_emitter_points_create(&pass->emitters, context, plan, emitter_name, scene, state,
                                    error)))
        return false;
    lsf_framebuffer_desc desc = {.label = "voxel_path", .layer = -1};
    const GLuint targets[] = {out->light.irradiance, out->direct.irradiance, out->light.specular,
                              out->direct.specular};
    for (size_t i = 0; i < LSF_COUNT(targets); i++)
        if (targets[i])
            desc.colors[desc.color_count++] = targets[i];
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "voxel_path", files, error);
    pass->timer = lsf_timer_create(context, "voxel_path", error);
    return pass->framebuffer && pass->program && pass->timer;
}

bool lsf_voxel_path_follow(lsf_voxel_path *pass, bool materials_edited)
{
    return lsf_emitter_points_follow(&pass->emitters, materials_edited);
}

void lsf_voxel_path_run(lsf_voxel_path *pass, const lsf_iteration *iteration,
                        const lsf_path_inputs *inputs, GLuint draws)
{
    const lsf_voxel_path_params *p = &pass->params;
    const lsf_sparse_grid *grid = &iteration->grid;
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->framebuffer, grid->width, grid->layers * grid->height,
                         pass->program);
    lsf_path_inputs_bind(inputs, iteration);
    lsf_bind_texture(LSF_UNIT_PATH_RANDOM, pass->random);
    glUniform4i(0, (GLint)iteration->plan->bounces, (GLint)pass->segments, p->min_samples,
                p->max_samples);
    glUniform2ui(1, iteration->index, lsf_iteration_seed(iteration, LSF_PURPOSE_VOXEL_PATH));
    if (pass->emitters.upload.buffer) {
        lsf_emitter_points_draw(&pass->emitters, iteration, LSF_PURPOSE_VOXEL_EMITTER);
        lsf_emitter_points_bind(&pass->emitters, p->emitters);
    }
    if (draws) {
        glUniform1i(LSF_LOCATION_VOXEL_DRAW, p->draws);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VOXEL_DRAWS, draws);
    }
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_voxel_path_destroy(lsf_voxel_path *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_texture_destroy(pass->context, &pass->random);
    lsf_emitter_points_destroy(&pass->emitters, pass->context);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
