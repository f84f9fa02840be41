#include "passes/compose.h"

#include <string.h>

#include "shared/scene_data.h"

void lsf_compose_plan(lsf_plan *plan, bool direct)
{
    const lsf_requirements *r = &plan->requirements;
    lsf_plan_pass_add(plan, "compose", "adds up what is seen itself and what is reflected");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_find(plan, "gbuffer.emission") != NULL,
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_DIRECT", direct, "there are punctual lights");
    lsf_plan_switch_add(plan, "LSF_ENVIRONMENT", r->environment, "an environment is seen");
    lsf_plan_switch_add(plan, "LSF_ENVIRONMENT_MAP", r->environment_map,
                        "the environment is a map");
    lsf_plan_texture_add(plan, "compose.radiance", GL_RGBA32F, plan->width, plan->height,
                         "the iteration's picture");
    lsf_plan_switch_add(plan, "LSF_SEEN", (plan->aovs & LSF_AOV_EMISSION) != 0,
                        "the emission layer is asked for");
    if (plan->aovs & LSF_AOV_EMISSION)
        lsf_plan_texture_add(plan, "compose.seen", GL_RGBA32F, plan->width, plan->height,
                             "the emission layer is asked for");
}

bool lsf_compose_create(lsf_compose *pass, lsf_context *context, const lsf_plan *plan,
                        lsf_error *error)
{
    static const char *const files[5] = {"lib/fullscreen.vert.glsl", "passes/compose.frag.glsl"};
    *pass = (lsf_compose){.context = context};
    if (!lsf_plan_create_texture(plan, context, "compose.radiance", &pass->radiance, error) ||
        !lsf_plan_create_texture(plan, context, "compose.seen", &pass->seen, error))
        return false;
    lsf_framebuffer_desc desc = {.label = "compose",
                                 .color_count = pass->seen ? 2 : 1,
                                 .colors = {pass->radiance, pass->seen},
                                 .layer = -1};
    pass->framebuffer = lsf_framebuffer_create(context, &desc, error);
    pass->program = lsf_plan_program(plan, context, "compose", files, error);
    pass->timer = lsf_timer_create(context, "compose", error);
    return pass->framebuffer && pass->program && pass->timer;
}

void lsf_compose_run(lsf_compose *pass, const lsf_iteration *iteration,
                     const lsf_compose_inputs *inputs)
{
    lsf_timer_begin(pass->timer);
    glBindFramebuffer(GL_FRAMEBUFFER, pass->framebuffer);
    glViewport(0, 0, (GLsizei)iteration->plan->width, (GLsizei)iteration->plan->height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glUseProgram(pass->program);
    glBindTextureUnit(0, inputs->depth);
    glBindTextureUnit(1, inputs->emission);
    glBindTextureUnit(2, inputs->direct);
    glBindTextureUnit(LSF_UNIT_ENVIRONMENT, iteration->scene->environment);
    const lsf_environment *environment = &iteration->scene->scene->environment;
    if (environment->present && !environment->width)
        glUniform3fv(LSF_LOCATION_ENVIRONMENT, 1, environment->radiance);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_compose_destroy(lsf_compose *pass)
{
    if (!pass->context)
        return;
    lsf_framebuffer_destroy(pass->context, &pass->framebuffer);
    lsf_texture_destroy(pass->context, &pass->radiance);
    lsf_texture_destroy(pass->context, &pass->seen);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
