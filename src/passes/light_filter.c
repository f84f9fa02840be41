#include "passes/light_filter.h"

#include <math.h>
#include <string.h>

#include "base/base.h"

const lsf_option_row lsf_light_filter_options[LSF_LIGHT_FILTER_OPTION_COUNT] = {
    {"light_filter.steps", LSF_OPTION_INT, offsetof(lsf_light_filter_params, steps), 0, 8, NULL, "",
     "steps of the filter, each twice as wide as the one before; 0: no filter"},
    {"light_filter.tolerance", LSF_OPTION_FLOAT, offsetof(lsf_light_filter_params, tolerance), 1e-3,
     1e3, NULL, "standard deviations", "differences between neighbours that count as noise"},
    {"light_filter.depth_weight", LSF_OPTION_FLOAT, offsetof(lsf_light_filter_params, depth_weight),
     1e-3, 1e3, NULL, "pixels",
     "how far neighbours may be off the pixel's plane, for each pixel that they are away"},
    {"light_filter.normal_weight", LSF_OPTION_FLOAT,
     offsetof(lsf_light_filter_params, normal_weight), 0.0, 1e4, NULL, "",
     "exponent of the cosine between the normals of neighbours"},
    {"light_filter.limit", LSF_OPTION_BOOL, offsetof(lsf_light_filter_params, limit), 0, 1, NULL,
     "", "changes light by no more than its noise explains"},
};

void lsf_light_filter_plan(lsf_plan *plan, const lsf_light_filter_params *params)
{
    lsf_plan_pass_add(plan, "light_filter", "%d steps over the mean of light, once a picture",
                      params->steps);
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", 0, "light of a specular lobe");
    lsf_plan_texture_add(plan, "light_filter.slope", GL_RGBA32F, plan->width, plan->height,
                         "of what is seen");
    lsf_plan_texture_add(plan, "light_filter.light", GL_RGBA32F, plan->width, plan->height,
                         "without tint, and its variance");
    lsf_plan_texture_add(plan, "light_filter.turn_0", GL_RGBA32F, plan->width, plan->height,
                         "after a step");
    lsf_plan_texture_add(plan, "light_filter.turn_1", GL_RGBA32F, plan->width, plan->height,
                         "after the next one");
    lsf_plan_texture_add(plan, "light_filter.picture", GL_RGBA32F, plan->width, plan->height,
                         "the result");
    if (!plan->requirements.specular)
        return;
    lsf_plan_pass_add(plan, "light_filter_specular", "the same for specular light");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", 1, "light of a specular lobe");
    lsf_plan_switch_add(plan, "LSF_PATTERN", (int)plan->pattern,
                        "the side of the interleaving pattern whose light is pooled");
}

static GLuint create_target(lsf_light_filter *pass, const lsf_plan *plan, const char *name,
                            GLuint *texture, lsf_error *error)
{
    if (!lsf_plan_create_texture(plan, pass->context, name, texture, error))
        return 0;
    const lsf_framebuffer_desc desc = {
        .label = name, .color_count = 1, .colors = {*texture}, .layer = -1};
    return lsf_framebuffer_create(pass->context, &desc, error);
}

/* A part's programs. */
static bool create_programs(lsf_light_filter *pass, const lsf_plan *plan, const char *name,
                            lsf_light_filter_programs *programs, lsf_error *error)
{
    const struct {
        const char *file;
        GLuint *program;
    } rows[] = {
        {"passes/light_filter_variance.frag.glsl", &programs->variance},
        {"passes/light_filter_step.frag.glsl", &programs->step},
        {"passes/light_filter_blend.frag.glsl", &programs->blend},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        const char *const files[5] = {"lib/fullscreen.vert.glsl", rows[i].file};
        if (!(*rows[i].program = lsf_plan_program(plan, pass->context, name, files, error)))
            return false;
    }
    return true;
}

bool lsf_light_filter_create(lsf_light_filter *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_light_filter_params *params, lsf_error *error)
{
    *pass = (lsf_light_filter){.context = context, .params = *params};
    const struct {
        const char *name;
        GLuint *texture, *framebuffer;
    } targets[] = {
        {"light_filter.slope", &pass->slope, &pass->slope_framebuffer},
        {"light_filter.light", &pass->light, &pass->light_framebuffer},
        {"light_filter.turn_0", &pass->turns[0], &pass->turn_framebuffers[0]},
        {"light_filter.turn_1", &pass->turns[1], &pass->turn_framebuffers[1]},
        {"light_filter.picture", &pass->picture, &pass->picture_framebuffer},
    };
    static const char *const slope_files[5] = {"lib/fullscreen.vert.glsl",
                                               "lib/light_guide_slope.frag.glsl"};
    static const char *const divide_files[5] = {"lib/fullscreen.vert.glsl",
                                                "passes/light_filter_divide.frag.glsl"};
    for (size_t i = 0; i < LSF_COUNT(targets); i++)
        if (!(*targets[i].framebuffer =
                  create_target(pass, plan, targets[i].name, targets[i].texture, error)))
            return false;
    pass->slope_program = lsf_plan_program(plan, context, "light_filter", slope_files, error);
    pass->divide_program = lsf_plan_program(plan, context, "light_filter", divide_files, error);
    if (!pass->slope_program || !pass->divide_program ||
        !create_programs(pass, plan, "light_filter", &pass->programs[0], error) ||
        (lsf_plan_find_pass(plan, "light_filter_specular") &&
         !create_programs(pass, plan, "light_filter_specular", &pass->programs[1], error)))
        return false;
    pass->timer = lsf_timer_create(context, "light_filter", error);
    return pass->timer != NULL;
}

static void begin(const lsf_plan *plan, GLuint framebuffer, GLuint program)
{
    lsf_begin_fullscreen(framebuffer, plan->width, plan->height, program);
}

/* What the programs of a part have in common. */
static void set_guide(const lsf_light_filter *pass)
{
    glUniform2f(0, pass->params.depth_weight, pass->params.normal_weight);
    if (pass->lobe)
        glUniform1f(3, pass->kernel);
}

/* Relative variance of a variance that is known from so many iterations of heavy-tailed noise:
 * (kurtosis - 1) / (n - 1). Where pixels of a pattern share samples few tell it: the kurtosis is
 * that of light which one sample in 64 finds. Else it is 9, that of an exponential distribution.
 * One iteration tells next to nothing. */
static float uncertainty_of(const lsf_light_filter *pass, float iterations)
{
    float kurtosis = pass->shared ? 64.0f : 9.0f;
    return (kurtosis - 1.0f) / (iterations > 1.5f ? iterations - 1.0f : 0.01f);
}

/* Sets `light` to the part without tint, with its variance. */
static void divide(lsf_light_filter *pass, const lsf_plan *plan, float iterations,
                   const lsf_light_filter_inputs *inputs, const lsf_light_filter_part *part,
                   const lsf_light_filter_programs *programs)
{
    begin(plan, pass->turn_framebuffers[0], pass->divide_program);
    glUniform1f(1, iterations);
    lsf_bind_texture(2, part->light);
    lsf_bind_texture(3, part->factor);
    lsf_draw_fullscreen(pass->context);
    begin(plan, pass->light_framebuffer, programs->variance);
    set_guide(pass);
    glUniform1f(1, iterations > 1.5f ? uncertainty_of(pass, iterations) : -1.0f);
    float rest = fmaxf(iterations - (float)inputs->half_count, 1.0f);
    glUniform1f(2, inputs->half ? (float)inputs->half_count / rest : -1.0f);
    lsf_bind_texture(2, pass->turns[0]);
    lsf_bind_texture(4, part->light);
    lsf_bind_texture(5, part->factor);
    lsf_bind_texture(6, inputs->half);
    lsf_draw_fullscreen(pass->context);
}

/* Sum of squared weights of a tent of 2^step pixels to each side, along one axis. */
static float tent_squares(int32_t step)
{
    float width = (float)(1 << step);
    return (2.0f * width * width + 1.0f) / (3.0f * width * width * width);
}

/* Of the noise of neighbours before a step, such that over a plane the variance after it is the
 * tent's: equal weights of 1 : 2 : 1 along both axes have a sum of squares of (3/8)^2. */
static float correlation_before(int32_t step)
{
    float independent = 9.0f / 64.0f, along = tent_squares(step + 1) / tent_squares(step);
    return (along * along - independent) / (1.0f - independent);
}

/* Returns the filtered light. */
static GLuint run_steps(lsf_light_filter *pass, const lsf_plan *plan, float iterations,
                        const lsf_light_filter_programs *programs)
{
    GLuint light = pass->light;
    float first = 7.0f * (pass->shared ? 1.0f + sqrtf(uncertainty_of(pass, iterations)) : 1.0f);
    for (int32_t i = 0; i < pass->params.steps; i++) {
        begin(plan, pass->turn_framebuffers[i % 2], programs->step);
        set_guide(pass);
        glUniform1i(1, 1 << i);
        glUniform1f(2, i < 2 ? fmaxf(pass->params.tolerance, first) : pass->params.tolerance);
        glUniform1f(4, correlation_before(i));
        lsf_bind_texture(2, light);
        lsf_draw_fullscreen(pass->context);
        light = pass->turns[i % 2];
    }
    return light;
}

/* Adds to the picture what the filter changes of the part. */
static void blend(lsf_light_filter *pass, const lsf_plan *plan, float iterations, GLuint filtered,
                  const lsf_light_filter_programs *programs)
{
    begin(plan, pass->picture_framebuffer, programs->blend);
    lsf_blend_add(1);
    set_guide(pass);
    glUniform1f(1, pass->params.limit ? uncertainty_of(pass, iterations) : -1.0f);
    lsf_bind_texture(2, pass->light);
    lsf_bind_texture(4, filtered);
    lsf_draw_fullscreen(pass->context);
}

void lsf_light_filter_run(lsf_light_filter *pass, const lsf_iteration *iteration,
                          uint32_t iterations, const lsf_light_filter_inputs *inputs)
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    glCopyImageSubData(inputs->picture, GL_TEXTURE_2D, 0, 0, 0, 0, pass->picture, GL_TEXTURE_2D, 0,
                       0, 0, 0, (GLsizei)plan->width, (GLsizei)plan->height, 1);
    lsf_bind_texture(0, inputs->guide);
    begin(plan, pass->slope_framebuffer, pass->slope_program);
    glUniform1f(1, (float)iterations);
    lsf_bind_texture(3, inputs->parts[0].factor);
    lsf_draw_fullscreen(pass->context);
    lsf_bind_texture(1, pass->slope);
    for (size_t i = 0; i < LSF_COUNT(inputs->parts); i++) {
        if (!inputs->parts[i].light)
            continue;
        const lsf_light_filter_programs *programs = &pass->programs[i];
        pass->lobe = i == 1;
        pass->shared = plan->pattern > 1;
        pass->kernel = inputs->kernel;
        divide(pass, plan, (float)iterations, inputs, &inputs->parts[i], programs);
        blend(pass, plan, (float)iterations, run_steps(pass, plan, (float)iterations, programs),
              programs);
    }
    lsf_timer_end(pass->timer);
}

void lsf_light_filter_destroy(lsf_light_filter *pass)
{
    if (!pass->context)
        return;
    GLuint *textures[] = {&pass->slope, &pass->light, &pass->turns[0], &pass->turns[1],
                          &pass->picture};
    GLuint *framebuffers[] = {&pass->slope_framebuffer, &pass->light_framebuffer,
                              &pass->turn_framebuffers[0], &pass->turn_framebuffers[1],
                              &pass->picture_framebuffer};
    for (size_t i = 0; i < LSF_COUNT(textures); i++) {
        lsf_texture_destroy(pass->context, textures[i]);
        lsf_framebuffer_destroy(pass->context, framebuffers[i]);
    }
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
