#include "passes/light_filter.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "shared/light_filter.h"

const lsf_option_row lsf_light_filter_options[LSF_LIGHT_FILTER_OPTION_COUNT] = {
    {"light_filter.kind", LSF_OPTION_ENUM, offsetof(lsf_light_filter_params, kind), 0, 0,
     "atrous|network", "",
     "filter that removes noise; network: atrous, and then a trained network"},
    {"light_filter.steps", LSF_OPTION_INT, offsetof(lsf_light_filter_params, steps), 0, 8, NULL, "",
     "steps of the filter, each twice as wide as the one before, at most as many as fit into the "
     "picture; 0: no filter"},
    {"light_filter.tolerance", LSF_OPTION_FLOAT, offsetof(lsf_light_filter_params, tolerance), 1e-3,
     1e3, NULL, "standard deviations", "differences between neighbours that count as noise"},
    {"light_filter.depth_weight", LSF_OPTION_FLOAT, offsetof(lsf_light_filter_params, depth_weight),
     1e-3, 1e3, NULL, "pixels",
     "height of a neighbour above the pixel's plane, per pixel of its distance, that halves its "
     "weight"},
    {"light_filter.normal_weight", LSF_OPTION_FLOAT,
     offsetof(lsf_light_filter_params, normal_weight), 0.0, 1e4, NULL, "",
     "exponent of the cosine between the normals of neighbours"},
    {"light_filter.limit", LSF_OPTION_BOOL, offsetof(lsf_light_filter_params, limit), 0, 1, NULL,
     "", "changes light by no more than its noise explains"},
};

#define AT(member) offsetof(lsf_light_filter, member)

static const lsf_texture_row textures[] = {
    {"light_filter.diffuse", GL_RGBA32F, AT(light[0]), 0, "without tint, and its variance"},
    {"light_filter.diffuse_0", GL_RGBA32F, AT(ping_pong[0][0]), 0, "after a step"},
    {"light_filter.diffuse_1", GL_RGBA32F, AT(ping_pong[1][0]), 0, "after the next one"},
    {"light_filter.specular", GL_RGBA32F, AT(light[1]), LSF_TEXTURE_SPECULAR,
     "without tint, and its variance"},
    {"light_filter.specular_0", GL_RGBA32F, AT(ping_pong[0][1]), LSF_TEXTURE_SPECULAR,
     "after a step"},
    {"light_filter.specular_1", GL_RGBA32F, AT(ping_pong[1][1]), LSF_TEXTURE_SPECULAR,
     "after the next one"},
    {"light_filter.lone", GL_RG8, AT(lone), 0, "which pixels are lone, of both parts"},
    {"light_filter.lost", GL_RGBA32F, AT(lost), 0, "light taken out of lone pixels"},
    {"light_filter.picture", GL_RGBA32F, AT(picture), 0, "the result"},
};

static const lsf_texture_row block_textures[] = {
    {"light_filter.lost_sums", GL_RGBA32F, AT(lost_sums[0]), 0, "the same, summed over blocks"},
    {"light_filter.lost_squares", GL_R32F, AT(lost_sums[1]), 0, "its squares, summed over blocks"},
};

static uint32_t blocks_along(uint32_t pixels)
{
    return (pixels + LSF_LOST_BLOCK - 1) / LSF_LOST_BLOCK;
}

void lsf_light_filter_plan(lsf_plan *plan, const lsf_light_filter_params *params)
{
    lsf_plan_pass_add(plan, "light_filter", "%d steps over the mean of light, once a picture",
                      params->steps);
    lsf_plan_reads(plan, "view light_mean light_guide temporal");
    lsf_plan_reads(plan, "temporal.denoised_diffuse|denoise");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), 0, plan->width, plan->height);
    lsf_plan_textures_add(plan, block_textures, LSF_COUNT(block_textures), 0,
                          blocks_along(plan->width), blocks_along(plan->height));
}

static bool create_framebuffers(lsf_light_filter *pass, lsf_error *error)
{
    const GLuint *light = pass->light, *before = pass->ping_pong[0], *after = pass->ping_pong[1];
    const struct {
        const char *label;
        GLuint *framebuffer, colors[4];
    } rows[] = {
        {"light_filter.light", &pass->light_framebuffer, {light[0], light[1], pass->lone}},
        {"light_filter.ping", &pass->ping_pong_framebuffers[0], {before[0], before[1]}},
        {"light_filter.pong", &pass->ping_pong_framebuffers[1], {after[0], after[1]}},
        {"light_filter.divided",
         &pass->divided_framebuffer,
         {before[0], before[1], light[0], light[1]}},
        {"light_filter.picture", &pass->picture_framebuffer, {pass->picture, pass->lost}},
        {"light_filter.lost", &pass->lost_framebuffer, {pass->lost_sums[0], pass->lost_sums[1]}},
        {"light_filter.spread", &pass->spread_framebuffer, {pass->picture}},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        lsf_framebuffer_desc desc = {.label = rows[i].label, .color_count = 4, .layer = -1};
        memcpy(desc.colors, rows[i].colors, sizeof rows[i].colors);
        if (!(*rows[i].framebuffer = lsf_framebuffer_create(pass->context, &desc, error)))
            return false;
    }
    return true;
}

static bool create_programs(lsf_light_filter *pass, const lsf_plan *plan, lsf_error *error)
{
    const struct {
        const char *file;
        GLuint *program;
    } rows[] = {
        {"passes/light_filter_divide.frag.glsl", &pass->divide},
        {"passes/light_filter_window.frag.glsl", &pass->window},
        {"passes/light_filter_variance.frag.glsl", &pass->variance},
        {"passes/light_filter_step.frag.glsl", &pass->step},
        {"passes/light_filter_change.frag.glsl", &pass->change},
        {"passes/light_filter_blend.frag.glsl", &pass->blend},
        {"passes/light_filter_pool.frag.glsl", &pass->pool},
        {"passes/light_filter_spread.frag.glsl", &pass->spread},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        const char *const files[5] = {"lib/fullscreen.vert.glsl", rows[i].file};
        if (!(*rows[i].program =
                  lsf_plan_program(plan, pass->context, "light_filter", files, error)))
            return false;
    }
    return true;
}

bool lsf_light_filter_create(lsf_light_filter *pass, lsf_context *context, const lsf_plan *plan,
                             const lsf_light_filter_params *params, lsf_error *error)
{
    *pass = (lsf_light_filter){.context = context, .params = *params};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !lsf_plan_create_textures(plan, context, block_textures, LSF_COUNT(block_textures), pass,
                                  error) ||
        !create_framebuffers(pass, error) || !create_programs(pass, plan, error))
        return false;
    pass->timer = lsf_timer_create(context, "light_filter", error);
    return pass->timer != NULL;
}

static void begin(const lsf_plan *plan, GLuint framebuffer, GLuint program)
{
    lsf_begin_fullscreen(framebuffer, plan->width, plan->height, program);
}

static void bind_parts(GLuint binding, const GLuint parts[2])
{
    lsf_bind_texture(binding, parts[0]);
    lsf_bind_texture(binding + 1, parts[1]);
}

/* Uniforms that programs with a guide share. */
static void set_guide(const lsf_light_filter *pass)
{
    glUniform2f(0, pass->params.depth_weight, pass->params.normal_weight);
}

/* Kurtosis of noise: that of an exponential distribution, and that of a light that one sample in 64
 * finds. */
static const float KURTOSIS = 9.0f, KURTOSIS_RARE = 64.0f;

/* Relative variance of a variance that is known from so many iterations of heavy-tailed noise:
 * (kurtosis - 1) / (n - 1). One iteration tells next to nothing. */
static float uncertainty_of(float iterations, float kurtosis)
{
    return (kurtosis - 1.0f) / (iterations > 1.5f ? iterations - 1.0f : 0.01f);
}

/* Whether light that bounces is filtered. */
static bool bounces(const lsf_plan *plan)
{
    return lsf_plan_switch_value(plan, "light_mean", "LSF_INDIRECT");
}

/* Whether neighbours that take different samples of light that bounces share them with others of
 * the same place in the pattern: what one of these finds alone stands out from all around it. */
static bool shares_samples(const lsf_plan *plan)
{
    return plan->pattern > 1 && bounces(plan);
}

/* Sets `light` to the parts without tint, with their variances. */
static void divide(const lsf_light_filter *pass, const lsf_plan *plan, float iterations,
                   const lsf_light_filter_inputs *inputs)
{
    const lsf_light_filter_part *parts = inputs->parts;
    bool alone = iterations < 1.5f;
    float rest = fmaxf(iterations - (float)inputs->half_count, 1.0f);
    begin(plan, pass->divided_framebuffer, pass->divide);
    glUniform1f(1, iterations);
    glUniform1f(2, inputs->half ? (float)inputs->half_count / rest : -1.0f);
    bind_parts(2, (GLuint[]){parts[0].light, parts[1].light});
    bind_parts(4, (GLuint[]){parts[0].factor, parts[1].factor});
    lsf_bind_texture(6, inputs->half);
    lsf_draw_fullscreen(pass->context);

    begin(plan, pass->ping_pong_framebuffers[1], pass->window);
    set_guide(pass);
    glUniform1i(1, alone);
    bind_parts(2, pass->light);
    lsf_draw_fullscreen(pass->context);

    begin(plan, pass->light_framebuffer, pass->variance);
    set_guide(pass);
    glUniform1i(1, alone);
    glUniform1f(2, uncertainty_of(iterations, KURTOSIS));
    /* Halves of shared samples tell little: a light that was found twice may be in both. */
    glUniform1i(3, inputs->half != 0 && !shares_samples(plan));
    bind_parts(2, pass->ping_pong[1]);
    bind_parts(4, pass->ping_pong[0]);
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

/* The least tolerance of the first two steps. A single noisy pixel of 49 is 7 standard deviations
 * away; of one iteration the variance is that among neighbours, and says less. */
static float first_tolerance(const lsf_plan *plan, float iterations)
{
    bool unknown = shares_samples(plan) || (iterations < 1.5f && bounces(plan));
    return 7.0f * (unknown ? 1.0f + sqrtf(uncertainty_of(iterations, KURTOSIS)) : 1.0f);
}

/* Tolerance of pixels that an edge crosses, relative to light_filter.tolerance: jitter has its part
 * in their variance. */
#define LSF_EDGE_TOLERANCE 3.0f

/* Steps that stay among pixels of the same noise: light of points that are several pixels apart is
 * spread over the pixels between. */
static int32_t steps_of_points(const lsf_iteration *iteration)
{
    int32_t steps = 0;
    uint32_t apart = iteration->grid.stride / iteration->plan->pixel_side;
    for (; apart > 1; apart /= 2)
        steps++;
    return steps;
}

/* Sets `filtered`. */
static void run_steps(lsf_light_filter *pass, const lsf_iteration *iteration, float iterations)
{
    const lsf_plan *plan = iteration->plan;
    const GLuint *light = pass->light;
    float first = first_tolerance(plan, iterations);
    int32_t within = steps_of_points(iteration);
    for (int32_t i = 0; i < pass->params.steps; i++) {
        begin(plan, pass->ping_pong_framebuffers[i % 2], pass->step);
        set_guide(pass);
        glUniform1i(1, 1 << i);
        float tolerance = pass->params.tolerance;
        float most = i < 2 + within ? fmaxf(tolerance, first) : tolerance;
        glUniform2f(2, most, fminf(most, LSF_EDGE_TOLERANCE * tolerance));
        glUniform1f(4, i < within ? 1.0f : correlation_before(i - within));
        bind_parts(2, light);
        lsf_bind_texture(4, pass->lone);
        lsf_draw_fullscreen(pass->context);
        light = pass->ping_pong[i % 2];
    }
    memcpy(pass->filtered, light, sizeof pass->filtered);
}

/* Adds to the picture the change made by the filter. */
static void blend(const lsf_light_filter *pass, const lsf_plan *plan, float iterations,
                  const lsf_light_filter_inputs *inputs, const GLuint filtered[2])
{
    const lsf_light_filter_part *parts = inputs->parts;
    int32_t window = pass->params.steps % 2; /* the one without filtered light */
    if (pass->params.limit) {
        begin(plan, pass->ping_pong_framebuffers[window], pass->change);
        set_guide(pass);
        glUniform1i(1, false);
        bind_parts(2, pass->light);
        bind_parts(4, filtered);
        lsf_draw_fullscreen(pass->context);
    }
    begin(plan, pass->picture_framebuffer, pass->blend);
    lsf_blend_add_color();
    set_guide(pass);
    glUniform1i(1, false);
    float kurtosis = shares_samples(plan) ? KURTOSIS_RARE : KURTOSIS;
    glUniform1f(2, pass->params.limit ? uncertainty_of(iterations, kurtosis) : -1.0f);
    glUniform1i(3, plan->pattern > 1);
    bind_parts(2, pass->ping_pong[window]);
    bind_parts(4, pass->light);
    bind_parts(6, filtered);
    bind_parts(8, (GLuint[]){parts[0].factor, parts[1].factor});
    lsf_bind_texture(10, pass->lone);
    lsf_draw_fullscreen(pass->context);
}

/* Gives what lone pixels have lost to those around them. */
static void spread(const lsf_light_filter *pass, const lsf_plan *plan)
{
    lsf_begin_fullscreen(pass->lost_framebuffer, blocks_along(plan->width),
                         blocks_along(plan->height), pass->pool);
    lsf_bind_texture(0, pass->lost);
    lsf_draw_fullscreen(pass->context);
    begin(plan, pass->spread_framebuffer, pass->spread);
    lsf_blend_add(1);
    lsf_bind_texture(0, pass->lost);
    bind_parts(1, pass->lost_sums);
    lsf_draw_fullscreen(pass->context);
}

void lsf_light_filter_run(lsf_light_filter *pass, const lsf_iteration *iteration,
                          uint32_t iterations, const lsf_light_filter_inputs *inputs)
{
    const lsf_plan *plan = iteration->plan;
    float n = (float)iterations;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    lsf_guide_maps_bind(&inputs->guide);
    divide(pass, plan, n, inputs);
    run_steps(pass, iteration, n);
    lsf_timer_end(pass->timer);
}

void lsf_light_filter_finish(lsf_light_filter *pass, const lsf_iteration *iteration,
                             uint32_t iterations, const lsf_light_filter_inputs *inputs,
                             const GLuint filtered[2])
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    glCopyImageSubData(inputs->picture, GL_TEXTURE_2D, 0, 0, 0, 0, pass->picture, GL_TEXTURE_2D, 0,
                       0, 0, 0, (GLsizei)plan->width, (GLsizei)plan->height, 1);
    lsf_guide_maps_bind(&inputs->guide);
    blend(pass, plan, (float)iterations, inputs, filtered);
    /* A network has changed lone pixels in its own way. */
    if (filtered == pass->filtered)
        spread(pass, plan);
    lsf_timer_end(pass->timer);
}

void lsf_light_filter_destroy(lsf_light_filter *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    lsf_textures_destroy(pass->context, block_textures, LSF_COUNT(block_textures), pass);
    GLuint *framebuffers[] = {&pass->light_framebuffer,         &pass->ping_pong_framebuffers[0],
                              &pass->ping_pong_framebuffers[1], &pass->divided_framebuffer,
                              &pass->picture_framebuffer,       &pass->lost_framebuffer,
                              &pass->spread_framebuffer};
    for (size_t i = 0; i < LSF_COUNT(framebuffers); i++)
        lsf_framebuffer_destroy(pass->context, framebuffers[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
