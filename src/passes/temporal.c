#include "passes/temporal.h"

#include <math.h>
#include <string.h>

#include "base/base.h"
#include "frame/sparse_grid.h"

const lsf_option_row lsf_temporal_options[LSF_TEMPORAL_OPTION_COUNT] = {
    {"temporal.frames", LSF_OPTION_INT, offsetof(lsf_temporal_params, frames), 1, 65536, NULL,
     "frames", "largest weight of light from earlier frames"},
    {"temporal.lag", LSF_OPTION_INT, offsetof(lsf_temporal_params, lag), 1, 65536, NULL, "frames",
     "frames after which 1 % is left of lights that were changed"},
    {"temporal.denoised_frames", LSF_OPTION_INT, offsetof(lsf_temporal_params, denoised_frames), 0,
     65536, NULL, "frames",
     "largest weight of denoised light from earlier frames, less where its brightness changes; "
     "with light_filter.kind=network; 0: none"},
};

#define AT(member) offsetof(lsf_temporal, member)
#define DENOISED 2u /* a network denoises light */

static const lsf_texture_row textures[] = {
    {"temporal.guide", GL_RGBA32UI, AT(guide), 0, "what the light of the frame before fell on"},
    {"temporal.compared", GL_RGBA32F, AT(compared), 0,
     "light of the frame with that of those before"},
    {"temporal.reach", GL_RGBA32F, AT(reach), 0, "samples that are carried to a frame"},
    {"temporal.diffuse_history", GL_RGBA32F, AT(parts[0].history), 0, "light of frames before"},
    {"temporal.diffuse_count", GL_R32F, AT(parts[0].count), 0, "of its samples"},
    {"temporal.diffuse_carried", GL_RGBA32F, AT(parts[0].carried), 0, "to where it is now"},
    {"temporal.diffuse_window", GL_RGBA32F, AT(parts[0].window), 0, "the same of neighbours"},
    {"temporal.diffuse", GL_RGBA32F, AT(parts[0].light), 0, "for light_filter"},
    {"temporal.specular_history", GL_RGBA32F, AT(parts[1].history), LSF_TEXTURE_SPECULAR,
     "light of frames before"},
    {"temporal.specular_count", GL_R32F, AT(parts[1].count), LSF_TEXTURE_SPECULAR,
     "of its samples"},
    {"temporal.specular_carried", GL_RGBA32F, AT(parts[1].carried), LSF_TEXTURE_SPECULAR,
     "to where it is now"},
    {"temporal.specular_window", GL_RGBA32F, AT(parts[1].window), LSF_TEXTURE_SPECULAR,
     "the same of neighbours"},
    {"temporal.specular", GL_RGBA32F, AT(parts[1].light), LSF_TEXTURE_SPECULAR, "for light_filter"},
    {"temporal.denoised_diffuse", GL_RGBA32F, AT(parts[0].denoised), DENOISED,
     "denoised light with that of frames before"},
    {"temporal.denoised_specular", GL_RGBA32F, AT(parts[1].denoised),
     DENOISED | LSF_TEXTURE_SPECULAR, "denoised light with that of frames before"},
    {"temporal.denoised_diffuse_carried", GL_RGBA32F, AT(parts[0].denoised_carried), DENOISED,
     "to where it is now"},
    {"temporal.denoised_specular_carried", GL_RGBA32F, AT(parts[1].denoised_carried),
     DENOISED | LSF_TEXTURE_SPECULAR, "to where it is now"},
    {"temporal.denoised_count", GL_RG32F, AT(denoised_count), DENOISED, "of its samples"},
    {"temporal.picture", GL_RGBA32F, AT(picture), 0, "with light of frames before"},
    {"temporal.picture_carried", GL_RGBA32F, AT(carried_picture), 0, "that of the frame before"},
    {"temporal.resolved", GL_RGBA32F, AT(resolved), 0, "the result"},
};

void lsf_temporal_plan(lsf_plan *plan, const lsf_temporal_params *params, bool denoised)
{
    denoised = denoised && params->denoised_frames > 0;
    lsf_plan_pass_add(plan, "temporal", "blends light with that of the frames before");
    lsf_plan_reads(plan, "view gbuffer light_mean light_guide accumulate light_filter");
    if (denoised)
        lsf_plan_reads(plan, "denoise");
    lsf_plan_switch_add(plan, "LSF_ORTHOGRAPHIC", plan->orthographic, "the camera is orthographic");
    lsf_plan_switch_add(plan, "LSF_LOBE", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_sparse_grid_pixel_switch(plan);
    lsf_plan_switch_add(plan, "LSF_DENOISED", denoised, "a network denoises light");
    lsf_plan_textures_add(plan, textures, LSF_COUNT(textures), denoised ? DENOISED : 0, plan->width,
                          plan->height);
}

static bool create_framebuffers(lsf_temporal *pass, lsf_error *error)
{
    lsf_temporal_part *diffuse = &pass->parts[0], *specular = &pass->parts[1];
    const struct {
        const char *label;
        GLuint *framebuffer, colors[6];
    } rows[] = {
        {"temporal.carried",
         &pass->carry_framebuffer,
         {diffuse->carried, pass->reach, pass->carried_picture, specular->carried,
          diffuse->denoised_carried, specular->denoised_carried}},
        {"temporal.compared", &pass->compare_framebuffer, {pass->compared}},
        {"temporal.window", &pass->window_framebuffer, {diffuse->window, specular->window}},
        {"temporal.blended",
         &pass->blend_framebuffer,
         {diffuse->history, specular->history, diffuse->light, specular->light, diffuse->count,
          specular->count}},
        {"temporal.picture", &pass->picture_framebuffer, {pass->picture, pass->guide}},
        {"temporal.denoised",
         &pass->denoised_framebuffer,
         {diffuse->denoised, specular->denoised, pass->denoised_count}},
        {"temporal.resolved", &pass->resolve_framebuffer, {pass->resolved}},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        lsf_framebuffer_desc desc = {.label = rows[i].label, .color_count = 6, .layer = -1};
        memcpy(desc.colors, rows[i].colors, sizeof rows[i].colors);
        bool used = rows[i].framebuffer != &pass->denoised_framebuffer || diffuse->denoised;
        if (used && !(*rows[i].framebuffer = lsf_framebuffer_create(pass->context, &desc, error)))
            return false;
    }
    return true;
}

static bool create_programs(lsf_temporal *pass, const lsf_plan *plan, lsf_error *error)
{
    const struct {
        const char *file;
        GLuint *program;
        bool used;
    } rows[] = {
        {"passes/temporal_carry.frag.glsl", &pass->carry_program, true},
        {"passes/temporal_picture.frag.glsl", &pass->picture_program, true},
        {"passes/temporal_denoised.frag.glsl", &pass->denoised_program, pass->parts[0].denoised},
        {"passes/temporal_resolve.frag.glsl", &pass->resolve_program, true},
        {"passes/temporal_compare.frag.glsl", &pass->compare_program, true},
        {"passes/temporal_window.frag.glsl", &pass->window_program, true},
        {"passes/temporal_blend.frag.glsl", &pass->blend_program, true},
    };
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        const char *const files[5] = {"lib/fullscreen.vert.glsl", rows[i].file};
        if (rows[i].used &&
            !(*rows[i].program = lsf_plan_program(plan, pass->context, "temporal", files, error)))
            return false;
    }
    return true;
}

bool lsf_temporal_create(lsf_temporal *pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_temporal_params *params, uint32_t independent, lsf_error *error)
{
    *pass = (lsf_temporal){.context = context,
                           .params = *params,
                           .independent = independent ? (float)independent : 1e9f,
                           .frames_since_lights = UINT32_MAX,
                           .frames_since_change = UINT32_MAX,
                           .still_frames = 1};
    if (!lsf_plan_create_textures(plan, context, textures, LSF_COUNT(textures), pass, error) ||
        !create_framebuffers(pass, error) || !create_programs(pass, plan, error))
        return false;
    pass->timer = lsf_timer_create(context, "temporal", error);
    return pass->timer != NULL;
}

/* --- frames --- */

/* Frames since something happened, one more unless it happens now; UINT32_MAX: it never did. */
static void count_frames(uint32_t *frames, bool now)
{
    if (now)
        *frames = 0;
    else if (*frames < UINT32_MAX)
        ++*frames;
}

void lsf_temporal_go_on(lsf_temporal *pass)
{
    pass->still_frames++;
}

static bool lags(const lsf_temporal *pass, uint32_t frames)
{
    return frames < (uint32_t)pass->params.lag;
}

/* The share of changed lights that is left after `lag` frames, in each of what is kept. Each frame
 * keeps w of it, w^lag = x, and light and picture in turn keep x (1 + lag (1 - w)) < x (1 - ln x):
 * 1 %. With denoised light between them it is x (1 + lag (1 - w) + lag (lag + 1) (1 - w)^2 / 2) <
 * x (1 - ln x + (ln x)^2 / 2). */
#define LEFT_OF_TWO 0.0013f
#define LEFT_OF_THREE 0.00022f

/* Samples that the history may stand for, for each of the frame's. */
static float history_limit(const lsf_temporal *pass, uint32_t frames_since)
{
    float limit = (float)pass->params.frames;
    if (!lags(pass, frames_since))
        return limit;
    float all = pass->parts[0].denoised ? LEFT_OF_THREE : LEFT_OF_TWO;
    float left = powf(all, (float)pass->still_frames / (float)pass->params.lag);
    return fminf(limit, left / (1.0f - left));
}

static float kept_samples(const lsf_temporal *pass, float iterations)
{
    return fminf(pass->carried, history_limit(pass, pass->frames_since_lights) * iterations);
}

float lsf_temporal_begin(lsf_temporal *pass, const lsf_temporal_change *change, uint32_t iterations,
                         const lsf_camera_state *camera)
{
    pass->camera = pass->next_camera;
    pass->next_camera = *camera;
    pass->kept = pass->kept && !change->cut;
    pass->carried = pass->kept ? pass->samples : 0.0f;
    pass->still_frames = 1;
    count_frames(&pass->frames_since_lights, change->lights);
    count_frames(&pass->frames_since_change, change->lights || change->moved);
    return kept_samples(pass, iterations == UINT32_MAX ? 1.0f : (float)iterations);
}

/* --- runs --- */

/* Binds the inputs of all programs. */
static void begin(const lsf_plan *plan, GLuint framebuffer, GLuint program,
                  const lsf_temporal_inputs *inputs)
{
    lsf_begin_fullscreen(framebuffer, plan->width, plan->height, program);
    lsf_guide_maps_bind(&inputs->guide);
    lsf_bind_texture(2, inputs->motion);
}

/* Binds a texture of either part. */
static void bind_parts(GLuint binding, GLuint diffuse, GLuint specular)
{
    lsf_bind_texture(binding, diffuse);
    lsf_bind_texture(binding + 1, specular);
}

/* For lib/light_guide.glsl: half a pixel off the plane for each that a neighbour is away, and half
 * the weight at 12 degrees. */
static void set_guide(void)
{
    glUniform2f(0, 0.5f, 32.0f);
}

static void set_former_eye(const lsf_camera_state *c)
{
    if (c->orthographic)
        glUniform4f(5, c->forward[0], c->forward[1], c->forward[2], 0.0f);
    else
        glUniform4f(5, c->start[0] - c->start_depth * c->forward[0],
                    c->start[1] - c->start_depth * c->forward[1],
                    c->start[2] - c->start_depth * c->forward[2], 1.0f);
}

void lsf_temporal_carry(lsf_temporal *pass, const lsf_iteration *iteration,
                        const lsf_temporal_inputs *inputs)
{
    bool lobe = pass->parts[1].history != 0;
    lsf_timer_begin(pass->timer);
    begin(iteration->plan, pass->carry_framebuffer, pass->carry_program, inputs);
    if (lobe)
        set_former_eye(&pass->camera);
    glUniform1i(4, pass->kept);
    glUniform1i(6, lags(pass, pass->frames_since_change));
    lsf_bind_texture(4, pass->guide);
    lsf_bind_texture(5, pass->parts[0].history);
    lsf_bind_texture(6, pass->parts[0].count);
    lsf_bind_texture(7, pass->parts[1].history);
    lsf_bind_texture(8, pass->parts[1].count);
    lsf_bind_texture(9, pass->resolved);
    if (pass->denoised_count) {
        bind_parts(10, pass->parts[0].denoised, pass->parts[1].denoised);
        lsf_bind_texture(12, pass->denoised_count);
    }
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

/* Binds the inputs of compare and blend. */
static void bind_light(const lsf_temporal *pass, const lsf_temporal_inputs *inputs)
{
    const lsf_temporal_light *now = inputs->parts;
    bind_parts(2, now[0].light, now[1].light);
    bind_parts(4, now[0].factor, now[1].factor);
    bind_parts(6, pass->parts[0].carried, pass->parts[1].carried);
    lsf_bind_texture(8, pass->reach);
}

/* Sets the histories, and the parts' light. */
static void blend_light(const lsf_temporal *pass, const lsf_plan *plan, uint32_t iterations,
                        const lsf_temporal_inputs *inputs)
{
    begin(plan, pass->compare_framebuffer, pass->compare_program, inputs);
    glUniform1f(1, (float)iterations);
    bind_light(pass, inputs);
    lsf_draw_fullscreen(pass->context);

    begin(plan, pass->window_framebuffer, pass->window_program, inputs);
    set_guide();
    glUniform1f(1, (float)iterations);
    lsf_bind_texture(2, pass->compared);
    lsf_draw_fullscreen(pass->context);

    begin(plan, pass->blend_framebuffer, pass->blend_program, inputs);
    set_guide();
    glUniform1f(1, (float)iterations);
    glUniform1f(2, history_limit(pass, pass->frames_since_lights));
    glUniform1f(4, pass->independent);
    glUniform1i(5, lags(pass, pass->frames_since_change));
    bind_light(pass, inputs);
    bind_parts(9, pass->parts[0].window, pass->parts[1].window);
    lsf_draw_fullscreen(pass->context);
}

void lsf_temporal_blend(lsf_temporal *pass, const lsf_iteration *iteration, uint32_t iterations,
                        const lsf_temporal_inputs *inputs)
{
    const lsf_plan *plan = iteration->plan;
    lsf_timer_begin(pass->timer);
    lsf_iteration_bind_view(iteration);
    blend_light(pass, plan, iterations, inputs);
    begin(plan, pass->picture_framebuffer, pass->picture_program, inputs);
    glUniform1f(1, (float)iterations);
    lsf_bind_texture(4, inputs->picture);
    lsf_bind_texture(5, inputs->parts[0].light);
    lsf_bind_texture(6, pass->parts[0].light);
    lsf_bind_texture(7, inputs->parts[1].light);
    lsf_bind_texture(8, pass->parts[1].light);
    lsf_draw_fullscreen(pass->context);
    pass->kept = true;
    pass->samples = (float)iterations + kept_samples(pass, (float)iterations);
    lsf_timer_end(pass->timer);
}

void lsf_temporal_blend_denoised(lsf_temporal *pass, const lsf_plan *plan, uint32_t iterations,
                                 const GLuint denoised[2])
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->denoised_framebuffer, plan->width, plan->height,
                         pass->denoised_program);
    glUniform1f(1, (float)iterations);
    glUniform1f(2, fminf((float)pass->params.denoised_frames,
                         history_limit(pass, pass->frames_since_lights)));
    bind_parts(2, denoised[0], denoised[1]);
    bind_parts(4, pass->parts[0].denoised_carried, pass->parts[1].denoised_carried);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_temporal_resolve(lsf_temporal *pass, const lsf_plan *plan, uint32_t iterations,
                          GLuint picture)
{
    lsf_timer_begin(pass->timer);
    lsf_begin_fullscreen(pass->resolve_framebuffer, plan->width, plan->height,
                         pass->resolve_program);
    glUniform1f(1, (float)iterations);
    /* What surfaces cover of a pixel is told for the frame alone, and has to fit its picture. */
    glUniform1f(2,
                plan->background.coverage ? 0.0f : history_limit(pass, pass->frames_since_change));
    lsf_bind_texture(0, picture);
    lsf_bind_texture(1, pass->carried_picture);
    lsf_draw_fullscreen(pass->context);
    lsf_timer_end(pass->timer);
}

void lsf_temporal_destroy(lsf_temporal *pass)
{
    if (!pass->context)
        return;
    lsf_textures_destroy(pass->context, textures, LSF_COUNT(textures), pass);
    GLuint *framebuffers[] = {&pass->carry_framebuffer,   &pass->compare_framebuffer,
                              &pass->window_framebuffer,  &pass->blend_framebuffer,
                              &pass->picture_framebuffer, &pass->denoised_framebuffer,
                              &pass->resolve_framebuffer};
    for (size_t i = 0; i < LSF_COUNT(framebuffers); i++)
        lsf_framebuffer_destroy(pass->context, framebuffers[i]);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
