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

#define AT(member) offsetof(lsf_light_filter, member)

static const lsf_texture_row textures[] = {
    {"light_filter.light", GL_RGBA32F, AT(light), 0, "without tint, and its variance"},
    {"light_filter.turn_0", GL_RGBA32F, AT(turns[0]), 0, "after a step"},
    {"light_filter.turn_1", GL_RGBA32F, AT(turns[1]), 0, "after the next one"},
    {"light_filter.window_0", GL_RGBA32F, AT(windows[0]), 0, "what neighbours are asked for"},
    {"light_filter.window_1", GL_RGBA32F, AT(windows[1]), 0, "means of it over a few"},
    {"light_filter.picture", GL_RGBA32F, AT(picture), 0, "the result"},
};

static void add_switches(lsf_plan *plan, bool lobe)
{
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", lobe, "light of a specular lobe");
}

void lsf_light_filter_plan(lsf_plan *plan, const lsf_light_filter_params *params)
{
    lsf_plan_pass_add(plan, "light_filter", "%d steps over the mean of light, once a picture",
                      params->steps);
    lsf_plan_reads(plan, "view light_mean light_guide temporal");
    add_switches(plan, false);
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->width, plan->height);
    if (!plan->requirements.specular)
        return;
    lsf_plan_pass_add(plan, "light_filter_specular", "the same for specular light");
    lsf_plan_reads(plan, "view light_mean light_guide temporal");
    add_switches(plan, true);
}

static bool create_framebuffers(lsf_light_filter *pass, lsf_error *error)
{
    const struct {
        const char *label;
        GLuint *framebuffer, colors[2];
    } rows[] = {
        {"light_filter.divided", &pass->divided_framebuffer, {pass->turns[0], pass->windows[0]}},
        {"light_filter.light", &pass->light_framebuffer, {pass->light}},
        {"light_filter.turn_0", &pass->turn_framebuffers[0], {pass->turns[0]}},
        {"light_filter.turn_1", &pass->turn_framebuffers[1], {pass->turns[1]}},
        {"light_filter.window_0", &pass->window_framebuffers[0], {pass->windows[0]}},
        {"light_filter.window_1", &pass->window_framebuffers[1], {pass->windows[1]}},
        {"light_filter.picture", &pass->picture_framebuffer, {pass->picture}},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        lsf_framebuffer_desc desc = {.label = rows[i].label, .color_count = 2, .layer = -1};
        memcpy(desc.colors, rows[i].colors, sizeof rows[i].colors);
        if (!(*rows[i].framebuffer = lsf_framebuffer_create(pass->context, &desc, error)))
            return false;
    }
    return true;
}

/* A part's programs. */
static bool create_programs(lsf_light_filter *pass, const lsf_plan *plan, const char *name,
                            lsf_light_filter_programs *programs, lsf_error *error)
{
    const struct {
        const char *file;
        GLuint *program;
    } rows[] = {
        {"passes/light_filter_divide.frag.glsl", &programs->divide},
        {"passes/light_filter_window.frag.glsl", &programs->window},
        {"passes/light_filter_variance.frag.glsl", &programs->variance},
        {"passes/light_filter_step.frag.glsl", &programs->step},
        {"passes/light_filter_change.frag.glsl", &programs->change},
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
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !create_framebuffers(pass, error) ||
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

/* What programs with a guide have in common. */
static void set_guide(const lsf_light_filter *pass)
{
    glUniform2f(0, pass->params.depth_weight, pass->params.normal_weight);
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

/* Means of `windows[0]` over the 3 x 3 neighbours, the first of two steps: sets `windows[1]`. */
static void gather_window(const lsf_light_filter *pass, const lsf_plan *plan, bool moments,
                          const lsf_light_filter_programs *programs)
{
    begin(plan, pass->window_framebuffers[1], programs->window);
    set_guide(pass);
    glUniform1i(1, moments);
    lsf_bind_texture(2, pass->windows[0]);
    lsf_draw_fullscreen(pass->context);
}

/* Sets `light` to the part without tint, with its variance. */
static void divide(lsf_light_filter *pass, const lsf_plan *plan, float iterations,
                   const lsf_light_filter_inputs *inputs, const lsf_light_filter_part *part,
                   const lsf_light_filter_programs *programs)
{
    bool alone = iterations < 1.5f;
    float rest = fmaxf(iterations - (float)inputs->half_count, 1.0f);
    begin(plan, pass->divided_framebuffer, programs->divide);
    glUniform1f(1, iterations);
    glUniform1f(2, inputs->half ? (float)inputs->half_count / rest : -1.0f);
    lsf_bind_texture(2, part->light);
    lsf_bind_texture(3, part->factor);
    lsf_bind_texture(4, inputs->half);
    lsf_draw_fullscreen(pass->context);
    gather_window(pass, plan, alone, programs);
    begin(plan, pass->light_framebuffer, programs->variance);
    set_guide(pass);
    glUniform1i(1, alone);
    glUniform1f(2, uncertainty_of(pass, iterations));
    glUniform1i(3, inputs->half != 0);
    lsf_bind_texture(2, pass->windows[1]);
    lsf_bind_texture(3, pass->turns[0]);
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
                  GLuint factor, const lsf_light_filter_programs *programs)
{
    if (pass->params.limit) {
        begin(plan, pass->window_framebuffers[0], programs->change);
        lsf_bind_texture(2, pass->light);
        lsf_bind_texture(3, filtered);
        lsf_draw_fullscreen(pass->context);
        gather_window(pass, plan, false, programs);
    }
    begin(plan, pass->picture_framebuffer, programs->blend);
    lsf_blend_add(1);
    set_guide(pass);
    glUniform1i(1, false);
    glUniform1f(2, pass->params.limit ? uncertainty_of(pass, iterations) : -1.0f);
    lsf_bind_texture(2, pass->windows[1]);
    lsf_bind_texture(3, pass->light);
    lsf_bind_texture(4, filtered);
    lsf_bind_texture(5, factor);
    lsf_draw_fullscreen(pass->context);
}

void lsf_light_filter_run(lsf_light_filter *pass, const lsf_iteration *iteration,
                          uint32_t iterations, const lsf_light_filter_inputs *inputs)
{
    const lsf_plan *plan = iteration->plan;
    float n = (float)iterations;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    glCopyImageSubData(inputs->picture, GL_TEXTURE_2D, 0, 0, 0, 0, pass->picture, GL_TEXTURE_2D, 0,
                       0, 0, 0, (GLsizei)plan->width, (GLsizei)plan->height, 1);
    lsf_bind_texture(0, inputs->guide);
    lsf_bind_texture(1, inputs->slope);
    for (size_t i = 0; i < LSF_COUNT(inputs->parts); i++) {
        const lsf_light_filter_part *part = &inputs->parts[i];
        const lsf_light_filter_programs *programs = &pass->programs[i];
        if (!part->light)
            continue;
        pass->shared = plan->pattern > 1;
        divide(pass, plan, n, inputs, part, programs);
        blend(pass, plan, n, run_steps(pass, plan, n, programs), part->factor, programs);
    }
    lsf_timer_end(pass->timer);
}

void lsf_light_filter_destroy(lsf_light_filter *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    GLuint *framebuffers[] = {&pass->divided_framebuffer,    &pass->light_framebuffer,
                              &pass->turn_framebuffers[0],   &pass->turn_framebuffers[1],
                              &pass->window_framebuffers[0], &pass->window_framebuffers[1],
                              &pass->picture_framebuffer};
    for (size_t i = 0; i < LSF_COUNT(framebuffers); i++)
        lsf_framebuffer_destroy(pass->context, framebuffers[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
