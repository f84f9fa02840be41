#include "passes/open_sky.h"
#include "frame/purpose.h"

#include <string.h>

#include "base/base.h"
#include "math/sampling.h"
#include "scene/environment.h"
#include "shared/scene_data.h"

/* Along the narrow lobes of a pixel, in each iteration. */
#define PIXEL_RAYS 4

#define AT(member) offsetof(lsf_open_sky, member)

static const lsf_texture_row textures[] = {
    {"open_sky.irradiance", GL_RGBA32F, AT(light.irradiance), 0, "for the diffuse lobe"},
    {"open_sky.specular", GL_RGBA32F, AT(light.specular), LSF_TEXTURE_SPECULAR,
     "of the specular lobe"},
};

/* Where rays tell how much narrow lobes see. */
static const lsf_texture_row lobe_textures[] = {
    {"open_sky.narrow", GL_RGBA32F, AT(narrow), 0, "of narrow lobes, the part that rays decide on"},
    {"open_sky.lobes", GL_RG16, AT(lobes), 0, "how much of such lobes sees it"},
};

void lsf_open_sky_plan(lsf_plan *plan, const lsf_sky_use *use)
{
    const lsf_requirements *r = &plan->requirements;
    if (use->control == LSF_SKY_CONTROL_NONE)
        return;
    lsf_plan_pass_add(plan, "open_sky", "the environment's light, were there no shadows");
    lsf_plan_reads(plan, "view gbuffer scene.environment direct_light.control");
    if (use->lobes)
        lsf_plan_reads(plan, "voxelize");
    lsf_sky_use_switches(plan);
    lsf_plan_switch_add(plan, "LSF_ENVIRONMENT_MAP", r->environment_map,
                        "the environment is a map");
    lsf_plan_switch_add(plan, "LSF_SKY_CHANCE", (int)use->chance,
                        "what else finds the environment");
    lsf_plan_switch_add(plan, "LSF_SKY_CONTROL", (int)use->control,
                        "how much of this light is counted on");
    lsf_plan_switch_add(plan, "LSF_RANDOM_TEXTURE", 0, "never: random numbers are computed");
    lsf_plan_switch_add(plan, "LSF_SPECULAR_PATHS", use->lobes, "paths gather narrow lobes");
    uint32_t points = plan->pixel_side * plan->pixel_side; /* of a pixel share its rays */
    lsf_plan_switch_add(plan, "LSF_LOBE_RAYS",
                        !use->lobes           ? 0
                        : points < PIXEL_RAYS ? (int)(PIXEL_RAYS / points)
                                              : 1,
                        "rays of a point tell what its narrow lobes see");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->seen_width,
                          plan->seen_height);
    if (use->lobes)
        lsf_plan_textures_add(plan, lobe_textures, LSF_COUNT(lobe_textures), 0, plan->seen_width,
                              plan->seen_height);
    lsf_upload_plan(plan, "open_sky.drawn", LSF_OPEN_SKY_DRAWN * sizeof(lsf_open_sky_data),
                    "directions drawn by the environment's radiance");
}

bool lsf_open_sky_create(lsf_open_sky *pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_sky_use *use, GLuint seen_depth, lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/open_sky.frag.glsl"};
    *pass = (lsf_open_sky){.context = context, .use = *use};
    if (!lsf_plan_find_pass(plan, "open_sky"))
        return true;
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        (use->lobes && !lsf_plan_create_textures(plan, context, lobe_textures,
                                                 LSF_COUNT(lobe_textures), pass, error)) ||
        !lsf_upload_create(&pass->drawn, context, plan, "open_sky.drawn", error) ||
        !lsf_buffer_textures_create(context, 1, &pass->drawn_fetch, error))
        return false;
    glTextureBuffer(pass->drawn_fetch, GL_RGBA32F, pass->drawn.buffer);
    const lsf_framebuffer_desc desc = {
        .label = "open_sky",
        .color_count = 4,
        .colors = {pass->light.irradiance, pass->light.specular, pass->narrow, pass->lobes},
        .depth = seen_depth,
        .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "open_sky", files, error);
    pass->timer = pass->program ? lsf_timer_create(context, "open_sky", error) : NULL;
    return pass->framebuffer && pass->timer;
}

static void draw_directions(lsf_open_sky *pass, const lsf_iteration *iteration)
{
    const lsf_sky *sky = &iteration->sky;
    lsf_open_sky_data *drawn = lsf_upload_begin(&pass->drawn);
    for (uint32_t i = 0; i < LSF_OPEN_SKY_DRAWN; i++) {
        uint32_t bits[2];
        lsf_iteration_sample(iteration, iteration->index * LSF_OPEN_SKY_DRAWN + i,
                             LSF_PURPOSE_OPEN_SKY, bits);
        const double u[2] = {lsf_unit_double(bits[0]), lsf_unit_double(bits[1])};
        float pdf;
        lsf_float3 direction = lsf_sky_sample(sky, u, &pdf);
        lsf_float3 radiance = lsf_environment_radiance(sky->environment, direction);
        lsf_float3 light = lsf_f3_scale(radiance, 1.0f / pdf);
        drawn[i] = (lsf_open_sky_data){
            .direction = {direction.x, direction.y, direction.z, lsf_sky_density(sky, radiance)},
            .radiance = {light.x, light.y, light.z, 0.0f}};
    }
    lsf_upload_end(&pass->drawn);
}

void lsf_open_sky_run(lsf_open_sky *pass, const lsf_iteration *iteration,
                      const lsf_surface_maps *seen, GLuint control, const lsf_voxels *voxels)
{
    if (!pass->timer)
        return;
    lsf_timer_begin(pass->timer);
    draw_directions(pass, iteration);
    lsf_begin_fullscreen(pass->framebuffer, iteration->plan->seen_width,
                         iteration->plan->seen_height, pass->program);
    lsf_skip_background();
    lsf_surface_maps_bind(seen);
    lsf_bind_texture(3, control);
    lsf_scene_gpu_bind_environment(iteration->scene);
    lsf_iteration_bind_sky(iteration);
    lsf_bind_texture(LSF_UNIT_OPEN_SKY, pass->drawn_fetch);
    glUniform2i(0, (GLint)pass->use.open_samples, (GLint)iteration->index);
    glUniform1i(2, iteration->done > 0);
    glUniform1ui(1, lsf_iteration_seed(iteration, LSF_PURPOSE_OPEN_SKY));
    if (pass->use.chance != LSF_SKY_CHANCE_NONE)
        glUniform2fv(LSF_LOCATION_SKY_CHANCE, 1, pass->use.paths);
    if (pass->lobes) {
        lsf_voxels_bind(voxels);
        glUniform1f(LSF_LOCATION_SPECULAR_SHARE, lsf_iteration_sky_angle(iteration));
    }
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_open_sky_destroy(lsf_open_sky *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_textures_destroy(pass->context, lobe_textures, LSF_COUNT(lobe_textures), pass);
    glDeleteTextures(1, &pass->drawn_fetch);
    lsf_upload_destroy(&pass->drawn, pass->context);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
