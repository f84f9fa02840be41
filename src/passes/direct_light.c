#include "passes/direct_light.h"

#include <string.h>

#include "base/base.h"
#include "frame/light_walls.h"
#include "frame/purpose.h"
#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/scene_data.h"

static void plan_switches(lsf_plan *plan, const lsf_direct_light_use *use)
{
    lsf_sky_use_switches(plan);
    lsf_plan_switch_add(plan, "LSF_SHADOW_PCF", use->shadow_pcf ? 4 : 0, "shadow.filter");
}

void lsf_direct_light_plan(lsf_plan *plan, uint32_t lights, const lsf_direct_light_use *use)
{
    if (lights > 0) {
        lsf_plan_pass_add(plan, "direct_light", "one reflection of each light");
        lsf_plan_reads(plan, "view gbuffer shadow_map");
        plan_switches(plan, use);
        lsf_light_switches(plan);
        lsf_plan_switch_add(plan, "LSF_SHADOW_TINT", lsf_light_walls_needed(plan),
                            "light passes thin walls");
    } else {
        lsf_plan_omit(plan, "direct_light", "no punctual light");
    }
    if (plan->sky_lights > 0) {
        lsf_plan_pass_add(plan, "sky_light", "one reflection of the environment");
        lsf_plan_reads(plan, "view gbuffer sky_map open_sky");
        lsf_plan_fills(plan, "direct_light");
        plan_switches(plan, use);
        lsf_plan_switch_add(plan, "LSF_SHADOW_TINT", lsf_plan_find(plan, "sky_map.tint") != NULL,
                            "light passes materials that transmit");
        lsf_plan_switch_add(plan, "LSF_SHADOW_SKY", 1, "directions of the environment");
        lsf_plan_switch_add(plan, "LSF_SKY_CHANCE", (int)use->sky.chance,
                            "what else finds the environment");
        lsf_plan_switch_add(plan, "LSF_SKY_SPLIT", plan->sky_split, "their light is filtered");
        lsf_plan_switch_add(plan, "LSF_SKY_CONTROL", (int)use->sky.control,
                            "their light is told by the open sky's");
        lsf_plan_switch_add(plan, "LSF_SPECULAR_PATHS", use->sky.lobes,
                            "paths gather narrow lobes");
    }
    if (use->sky.control == LSF_SKY_CONTROL_SHARE) {
        const lsf_texture_desc desc = {
            NULL, GL_TEXTURE_2D_ARRAY, GL_RGBA32F, plan->seen_width, plan->seen_height, 3, 1};
        lsf_plan_texture_desc_add(plan, "direct_light.control", &desc,
                                  "what directions of the environment have found");
    }
    if (plan->sky_split)
        lsf_plan_texture_add(plan, "direct_light.sky_irradiance", GL_RGBA32F, plan->seen_width,
                             plan->seen_height, "light of the environment, to be filtered");
    if (plan->sky_split && plan->requirements.specular)
        lsf_plan_texture_add(plan, "direct_light.sky_specular", GL_RGBA32F, plan->seen_width,
                             plan->seen_height, "light of the environment, to be filtered");
    lsf_plan_texture_add(plan, "direct_light.radiance", GL_RGBA32F, plan->seen_width,
                         plan->seen_height, "the sum over lights");
}

/* Program and timer of a pass; both stay 0, with success, when the plan does not list it. */
static bool create_program(lsf_context *context, const lsf_plan *plan, const char *name,
                           GLuint *program, lsf_timer **timer, lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl",
                                         "passes/direct_light.frag.glsl"};
    if (!lsf_plan_find_pass(plan, name))
        return true;
    *program = lsf_plan_program(plan, context, name, files, error);
    *timer = *program ? lsf_timer_create(context, name, error) : NULL;
    return *timer != NULL;
}

static bool create_sky(lsf_direct_light *pass, const lsf_plan *plan, GLuint seen_depth,
                       lsf_error *error)
{
    if (!lsf_plan_create_texture_if_planned(plan, pass->context, "direct_light.control",
                                            &pass->control, error))
        return false;
    if (!plan->sky_split)
        return true;
    if (!lsf_plan_create_texture(plan, pass->context, "direct_light.sky_irradiance",
                                 &pass->sky.irradiance, error) ||
        !lsf_plan_create_texture_if_planned(plan, pass->context, "direct_light.sky_specular",
                                            &pass->sky.specular, error))
        return false;
    const lsf_framebuffer_desc desc = {.label = "sky_light",
                                       .color_count = 2,
                                       .colors = {pass->sky.irradiance, pass->sky.specular},
                                       .depth = seen_depth,
                                       .layer = -1};
    pass->sky_framebuffer = lsf_framebuffer_create(pass->context, &desc, error);
    return pass->sky_framebuffer != 0;
}

bool lsf_direct_light_create(lsf_direct_light *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_direct_light_use *use, GLuint seen_depth, lsf_error *error)
{
    *pass = (lsf_direct_light){.context = context, .use = *use};
    if (!lsf_plan_create_texture(plan, context, "direct_light.radiance", &pass->radiance, error))
        return false;
    lsf_framebuffer_desc desc = {.label = "direct_light",
                                 .color_count = 1,
                                 .colors = {pass->radiance},
                                 .depth = seen_depth,
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    return pass->framebuffer && create_sky(pass, plan, seen_depth, error) &&
           create_program(context, plan, "direct_light", &pass->program, &pass->timer, error) &&
           create_program(context, plan, "sky_light", &pass->sky_program, &pass->sky_timer, error);
}

void lsf_direct_light_clear(lsf_direct_light *pass)
{
    const GLuint textures[] = {pass->radiance, pass->sky.irradiance, pass->sky.specular};
    for (size_t i = 0; i < LSF_COUNT(textures); i++)
        if (textures[i])
            glClearTexImage(textures[i], 0, GL_RGBA, GL_FLOAT, NULL);
}

/* For directions that count on the light of an open sky. */
static void set_control(const lsf_direct_light *pass, const lsf_iteration *iteration,
                        const lsf_direct_light_inputs *inputs)
{
    float directions = (float)iteration->plan->sky_lights;
    float fluence = 4.0f * LSF_PI * iteration->sky.mean;
    glUniform2f(3, 1.0f / directions, fluence > 0.0f ? directions / fluence : 0.0f);
    glUniform1i(4, (GLint)lsf_iteration_sky_sequence(iteration, inputs->first));
    lsf_bind_texture(3, inputs->open->irradiance);
    lsf_bind_texture(4, inputs->open->specular);
    if (pass->use.sky.lobes) {
        lsf_bind_texture(5, inputs->lobes);
        lsf_bind_texture(8, inputs->narrow);
    }
    if (pass->control && iteration->done == 0 && inputs->first == 0)
        glClearTexImage(pass->control, 0, GL_RGBA, GL_FLOAT, NULL);
    if (pass->control) {
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); /* open_sky has read it */
        glBindImageTexture(0, pass->control, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    }
}

void lsf_direct_light_run(lsf_direct_light *pass, const lsf_iteration *iteration,
                          const lsf_direct_light_inputs *inputs)
{
    bool sky = inputs->directions > 0;
    lsf_timer *timer = sky ? pass->sky_timer : pass->timer;
    lsf_timer_begin(timer);
    bool split = sky && pass->sky_framebuffer;
    lsf_begin_fullscreen(split ? pass->sky_framebuffer : pass->framebuffer,
                         iteration->plan->seen_width, iteration->plan->seen_height,
                         sky ? pass->sky_program : pass->program);
    lsf_skip_background();
    lsf_blend_add(split && pass->sky.specular ? 2 : 1);
    lsf_surface_maps_bind(inputs->seen);
    lsf_shadow_bind(inputs->shadow);
    if (sky)
        glUniform1i(0, (GLint)inputs->directions);
    else if (iteration->plan->scattered)
        glUniform1f(LSF_LOCATION_LOBE_ANGLE, inputs->lobe_angle);
    if (sky && pass->use.sky.chance != LSF_SKY_CHANCE_NONE)
        glUniform2fv(LSF_LOCATION_SKY_CHANCE, 1, pass->use.sky.paths);
    if (sky && pass->use.sky.lobes)
        glUniform1f(LSF_LOCATION_SPECULAR_SHARE, lsf_iteration_sky_angle(iteration));
    if (sky && inputs->open)
        set_control(pass, iteration, inputs);
    lsf_draw_fullscreen(pass->context);
    if (sky && pass->control)
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    lsf_timer_end(timer);
}

void lsf_direct_light_destroy(lsf_direct_light *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_framebuffer_destroy(pass->context, &pass->sky_framebuffer);
    lsf_texture_destroy(pass->context, &pass->radiance);
    lsf_texture_destroy(pass->context, &pass->sky.irradiance);
    lsf_texture_destroy(pass->context, &pass->sky.specular);
    lsf_texture_destroy(pass->context, &pass->control);
    lsf_timer_destroy(pass->timer);
    lsf_timer_destroy(pass->sky_timer);
    memset(pass, 0, sizeof *pass);
}
