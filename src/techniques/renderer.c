#include <lightsheaf/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/vector.h"
#include "passes/accumulate.h"
#include "passes/tonemap.h"
#include "techniques/grain.h"
#include "techniques/setup.h"

#define MAX_PASSES (LSF_TECHNIQUE_MAX_PASSES + 2)

/* Seconds between two questions whether a long iteration shall go on. */
#define QUESTION_EVERY 0.1

struct lsf_renderer {
    lsf_context *context;
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    void *technique;
    lsf_technique_outputs outputs;
    lsf_accumulate accumulate;
    lsf_tonemap tonemap;
    uint32_t samples; /* iterations asked for so far */
    uint32_t next;    /* iteration to run next: fewer, where some have to be run again */
    bool grain_checked;
    double time_limit;
    uint32_t samples_wanted;
    lsf_progress progress;
    void *progress_user;
    double deadline, next_question; /* in seconds as lsf_now counts them */
    bool stopped;                   /* the iteration in progress is to be dropped */
    double compile_seconds, upload_seconds, render_seconds;
    lsf_pass_stats pass_stats[MAX_PASSES];
};

static bool create_resources(lsf_renderer *renderer, const lsf_render_params *params,
                             lsf_error *error)
{
    lsf_setup *setup = &renderer->setup;
    lsf_context *context = renderer->context;
    const lsf_state *previous = params->aovs & LSF_AOV_MOTION ? &setup->previous : NULL;
    double start = lsf_now();
    if (!lsf_plan_check(setup->plan, context, error) ||
        !lsf_scene_gpu_create(&renderer->scene, context, setup->plan, setup->scene, &setup->state,
                              previous, error) ||
        !lsf_iteration_create(&renderer->iteration, context, setup->plan, &renderer->scene,
                              &setup->state, previous, params->seed, error))
        return false;
    double uploaded = lsf_now();
    if (!setup->technique->create(&renderer->technique, context, setup->plan, &setup->pass_params,
                                  &renderer->scene, &setup->state, error) ||
        !lsf_accumulate_create(&renderer->accumulate, context, setup->plan, setup->layer_count,
                               setup->layer_names, error) ||
        (params->rgb8 && !lsf_tonemap_create(&renderer->tonemap, context, setup->plan, error)))
        return false;
    renderer->upload_seconds = uploaded - start;
    renderer->compile_seconds = lsf_now() - uploaded;
    return lsf_context_check(context, error);
}

lsf_renderer *lsf_renderer_create(lsf_context *context, const lsf_scene *scene,
                                  const lsf_render_params *params, lsf_error *error)
{
    lsf_renderer *renderer = lsf_alloc(1, sizeof *renderer);
    if (!renderer) {
        lsf_error_set(error, LSF_ERROR_RENDER, "out of memory");
        return NULL;
    }
    renderer->context = context;
    renderer->samples_wanted = params->samples;
    renderer->time_limit = params->time_limit;
    renderer->progress = params->progress;
    renderer->progress_user = params->progress_user;
    if (!lsf_setup_init(&renderer->setup, scene, params, error) ||
        !lsf_context_make_current(context, error) || !create_resources(renderer, params, error)) {
        lsf_renderer_destroy(renderer);
        return NULL;
    }
    const lsf_plan *plan = renderer->setup.plan;
    for (uint64_t i = 0; i < plan->remark_count; i++)
        lsf_log(LSF_LOG_INFO, "%s", plan->remarks[i]);
    return renderer;
}

void lsf_renderer_destroy(lsf_renderer *renderer)
{
    if (!renderer)
        return;
    lsf_tonemap_destroy(&renderer->tonemap);
    lsf_accumulate_destroy(&renderer->accumulate);
    if (renderer->setup.technique)
        renderer->setup.technique->destroy(renderer->technique);
    lsf_iteration_destroy(&renderer->iteration);
    lsf_scene_gpu_destroy(&renderer->scene);
    lsf_setup_finish(&renderer->setup);
    free(renderer);
}

const lsf_plan *lsf_renderer_plan(const lsf_renderer *renderer)
{
    return renderer->setup.plan;
}

/* The texture of a layer; 0 when the technique has none, and the layer stays black. */
static GLuint layer_texture(const lsf_technique_outputs *outputs, uint32_t aov)
{
    switch (aov) {
    case LSF_AOV_ALBEDO:
    case LSF_AOV_NORMAL:
        return outputs->surface;
    case LSF_AOV_DEPTH:
        return outputs->depth;
    case LSF_LAYER_COVERAGE:
        return outputs->coverage;
    case LSF_AOV_EMISSION:
        return outputs->emission;
    case LSF_AOV_DIRECT:
        return outputs->direct;
    case LSF_AOV_INDIRECT_DIFFUSE:
        return outputs->indirect_diffuse;
    case LSF_AOV_INDIRECT_SPECULAR:
        return outputs->indirect_specular;
    case LSF_AOV_MOTION:
        return outputs->motion;
    case LSF_AOV_VOXEL_ALBEDO:
        return outputs->voxel_albedo;
    case LSF_AOV_VOXEL_NORMAL:
        return outputs->voxel_normal;
    case LSF_AOV_VOXEL_RADIANCE:
        return outputs->voxel_radiance;
    default:
        return outputs->picture;
    }
}

static void run_iteration(lsf_renderer *renderer)
{
    GLuint layers[LSF_ACCUMULATE_MAX_LAYERS];
    const lsf_setup *setup = &renderer->setup;
    lsf_iteration_begin(&renderer->iteration, renderer->next);
    setup->technique->run(renderer->technique, &renderer->iteration, &renderer->outputs);
    if (renderer->stopped)
        return;
    for (uint32_t i = 0; i < setup->layer_count; i++)
        layers[i] = layer_texture(&renderer->outputs, setup->layer_aovs[i]);
    if (!renderer->grain_checked)
        lsf_grain_check(&renderer->iteration, renderer->outputs.depth);
    renderer->grain_checked = true;
    lsf_accumulate_run(&renderer->accumulate, &renderer->iteration, layers, renderer->outputs.depth,
                       renderer->outputs.gate);
    renderer->next++;
}

/* Whether all that ran went into the means, as far as it is known. If not, `next` goes back. */
static bool settle(lsf_renderer *renderer, bool wait)
{
    const lsf_technique *technique = renderer->setup.technique;
    return renderer->next == 0 || !technique->settle ||
           technique->settle(renderer->technique, &renderer->iteration, wait, &renderer->next);
}

/* Until what was asked for went into the means; without `wait`, as far as it is known. */
static bool catch_up(lsf_renderer *renderer, bool wait, lsf_error *error)
{
    double start = lsf_now();
    do {
        while (renderer->next < renderer->samples && !renderer->stopped) {
            run_iteration(renderer);
            if (!lsf_context_check(renderer->context, error))
                return false;
        }
        if (renderer->stopped)
            renderer->samples = renderer->next;
    } while (!settle(renderer, wait));
    renderer->render_seconds += lsf_now() - start;
    return lsf_context_check(renderer->context, error);
}

bool lsf_renderer_iterate(lsf_renderer *renderer, lsf_error *error)
{
    renderer->stopped = false;
    renderer->samples++;
    return catch_up(renderer, false, error);
}

/* Until the GPU is done: what was handed to it so far counts as rendered. */
static void wait_for_gpu(lsf_renderer *renderer)
{
    double start = lsf_now();
    glFinish();
    renderer->render_seconds += lsf_now() - start;
}

static bool wants_more(const lsf_renderer *renderer, uint32_t done)
{
    return !renderer->progress ||
           renderer->progress(done, renderer->samples_wanted, renderer->progress_user);
}

/* Within an iteration. The limit leaves the first one whole: a late picture is better than none. */
static bool goes_on(void *user)
{
    lsf_renderer *renderer = user;
    if (renderer->stopped || lsf_now() < renderer->next_question)
        return !renderer->stopped;
    glFinish(); /* or the question would be about commands that are given, not about work */
    renderer->stopped = (renderer->next > 0 && lsf_now() >= renderer->deadline) ||
                        !wants_more(renderer, renderer->next);
    renderer->next_question = lsf_now() + QUESTION_EVERY;
    return !renderer->stopped;
}

static bool run_until_stopped(lsf_renderer *renderer, lsf_error *error)
{
    bool limited = isfinite(renderer->time_limit);
    while (renderer->samples < renderer->samples_wanted) {
        renderer->next_question = lsf_now() + QUESTION_EVERY;
        if (!lsf_renderer_iterate(renderer, error))
            return false;
        if (renderer->stopped || !wants_more(renderer, renderer->samples))
            break;
        /* A GPU takes commands faster than it runs them: without this, the limit would be one on
         * commands given. */
        if (limited)
            wait_for_gpu(renderer);
        if (lsf_now() >= renderer->deadline)
            break;
    }
    wait_for_gpu(renderer);
    return catch_up(renderer, true, error);
}

bool lsf_renderer_run(lsf_renderer *renderer, lsf_error *error)
{
    renderer->deadline = lsf_now() + renderer->time_limit;
    renderer->iteration.question = goes_on;
    renderer->iteration.question_user = renderer;
    bool good = run_until_stopped(renderer, error);
    renderer->iteration.question = NULL;
    return good;
}

/* Names of an image's channels: those of the picture, then of each layer. */
static uint32_t name_channels(const lsf_setup *setup, char (*names)[LSF_CHANNEL_NAME_SIZE])
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < setup->layer_count; i++) {
        const char *letters = "RGB";
        if (setup->layer_aovs[i] & (LSF_AOV_NORMAL | LSF_AOV_VOXEL_NORMAL))
            letters = "XYZ";
        else if (setup->layer_aovs[i] == LSF_AOV_MOTION)
            letters = "XY";
        else if (setup->layer_aovs[i] == LSF_AOV_DEPTH)
            letters = "Z";
        else if (setup->layer_aovs[i] == LSF_LAYER_COVERAGE)
            letters = "A";
        for (; *letters; letters++)
            if (i == 0 || setup->layer_aovs[i] == LSF_LAYER_COVERAGE)
                snprintf(names[count++], LSF_CHANNEL_NAME_SIZE, "%c", *letters);
            else
                snprintf(names[count++], LSF_CHANNEL_NAME_SIZE, "%s.%c", setup->layer_names[i],
                         *letters);
    }
    return count;
}

/* Textures are read back in strips of whole rows of about this size: OpenGL's sizes are signed
 * 32-bit numbers, and after a long rendering memory may be short. */
enum { STRIP_BYTES = 1 << 18 };

static uint32_t strip_rows(uint32_t width, uint32_t texel_bytes)
{
    uint32_t rows = STRIP_BYTES / (width * texel_bytes);
    return rows > 0 ? rows : 1;
}

/* Calls `take` with rows of R, G, B and alpha, bottom row first. */
static bool read_strips(GLuint texture, uint32_t width, uint32_t height,
                        void (*take)(const float *texels, uint32_t first_row, uint32_t rows,
                                     void *user),
                        void *user)
{
    uint32_t most = strip_rows(width, 16);
    float *texels = lsf_alloc((uint64_t)most * width, 16);
    for (uint32_t y = 0; texels && y < height; y += most) {
        uint32_t rows = height - y < most ? height - y : most;
        glGetTextureSubImage(texture, 0, 0, (GLint)y, 0, (GLsizei)width, (GLsizei)rows, 1, GL_RGBA,
                             GL_FLOAT, (GLsizei)(rows * width * 16), texels);
        take(texels, y, rows, user);
    }
    free(texels);
    return texels != NULL;
}

/* Where a layer goes in an image, whose rows run from the top. */
typedef struct layer_target {
    lsf_image *image;
    uint32_t first_channel, channels;
} layer_target;

static void copy_layer(const float *texels, uint32_t first_row, uint32_t rows, void *user)
{
    const layer_target *target = user;
    lsf_image *image = target->image;
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t x = 0; x < image->width; x++) {
            size_t y = image->height - 1 - (first_row + row);
            float *pixel = image->pixels + (y * image->width + x) * image->channel_count;
            memcpy(pixel + target->first_channel, texels + ((size_t)row * image->width + x) * 4,
                   target->channels * sizeof(float));
        }
}

static uint32_t channels_of(uint32_t aov)
{
    switch (aov) {
    case LSF_AOV_DEPTH:
    case LSF_LAYER_COVERAGE:
        return 1;
    case LSF_AOV_MOTION:
        return 2;
    default:
        return 3;
    }
}

lsf_image *lsf_renderer_read(lsf_renderer *renderer, lsf_error *error)
{
    const lsf_setup *setup = &renderer->setup;
    const lsf_plan *plan = setup->plan;
    char names[3 * LSF_ACCUMULATE_MAX_LAYERS][LSF_CHANNEL_NAME_SIZE];
    const char *name_list[3 * LSF_ACCUMULATE_MAX_LAYERS];
    uint32_t channel_count = name_channels(setup, names);
    for (uint32_t i = 0; i < channel_count; i++)
        name_list[i] = names[i];
    if (!catch_up(renderer, true, error))
        return NULL;
    lsf_image *image = lsf_image_create(plan->width, plan->height, channel_count, name_list, error);
    bool good = image != NULL;
    for (uint32_t i = 0, channel = 0; good && i < setup->layer_count; i++) {
        uint32_t channels = channels_of(setup->layer_aovs[i]);
        bool present = layer_texture(&renderer->outputs, setup->layer_aovs[i]) != 0;
        layer_target target = {image, channel, channels};
        if (present && !read_strips(renderer->accumulate.means[i], plan->width, plan->height,
                                    copy_layer, &target))
            good =
                lsf_error_set(error, LSF_ERROR_RENDER, "no memory left to read the picture back");
        channel += channels;
    }
    if (!good || !lsf_context_check(renderer->context, error)) {
        lsf_image_destroy(image);
        return NULL;
    }
    return image;
}

bool lsf_renderer_read_rgb8(lsf_renderer *renderer, float exposure, lsf_tone_curve curve,
                            uint8_t *rgb, lsf_error *error)
{
    if (!renderer->tonemap.display)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "8-bit output was not asked for; set rgb8 in lsf_render_params");
    const lsf_plan *plan = renderer->setup.plan;
    if (!catch_up(renderer, true, error))
        return false;
    lsf_tonemap_run(&renderer->tonemap, renderer->accumulate.means[0], exposure, curve);
    uint32_t most = strip_rows(plan->width, 3);
    for (uint32_t y = 0; y < plan->height; y += most) {
        uint32_t rows = plan->height - y < most ? plan->height - y : most;
        glGetTextureSubImage(renderer->tonemap.display, 0, 0, (GLint)y, 0, (GLsizei)plan->width,
                             (GLsizei)rows, 1, GL_RGB, GL_UNSIGNED_BYTE,
                             (GLsizei)(rows * plan->width * 3),
                             rgb + (uint64_t)y * plan->width * 3);
    }
    return lsf_context_check(renderer->context, error);
}

typedef struct pixel_tally {
    uint32_t width;
    double lost, kept;    /* luminance */
    uint64_t lost_pixels; /* those that are not finite */
} pixel_tally;

static void tally_rows(const float *texels, uint32_t first_row, uint32_t rows, void *user)
{
    (void)first_row;
    pixel_tally *tally = user;
    for (const float *t = texels; t < texels + (size_t)4 * tally->width * rows; t += 4) {
        tally->lost += (double)t[3];
        tally->kept += (double)lsf_f3_luminance(lsf_f3_load(t));
        tally->lost_pixels += !isfinite(t[0]) || !isfinite(t[1]) || !isfinite(t[2]);
    }
}

/* Goes over the picture: how much of its luminance bounds took away,
 * which alpha holds, and how many pixels are not finite. */
static void look_at_pixels(const lsf_renderer *renderer, double *lost_share, uint64_t *lost_pixels)
{
    const lsf_plan *plan = renderer->setup.plan;
    pixel_tally tally = {.width = plan->width};
    read_strips(renderer->accumulate.means[0], plan->width, plan->height, tally_rows, &tally);
    bool lost = renderer->outputs.bounded && tally.lost > 0.0;
    *lost_share = lost ? tally.lost / (tally.lost + tally.kept) : 0.0;
    *lost_pixels = tally.lost_pixels;
}

lsf_renderer_stats lsf_renderer_get_stats(lsf_renderer *renderer)
{
    lsf_pass_report reports[MAX_PASSES];
    lsf_error ignored = {0}; /* whoever reads the picture meets it again */
    catch_up(renderer, true, &ignored);
    uint32_t count = renderer->setup.technique->report(renderer->technique, reports);
    reports[count++] = (lsf_pass_report){.timer = renderer->accumulate.timer};
    if (renderer->tonemap.timer)
        reports[count++] = (lsf_pass_report){.timer = renderer->tonemap.timer};
    double iterations = renderer->samples ? renderer->samples : 1;
    for (uint32_t i = 0; i < count; i++)
        renderer->pass_stats[i] = (lsf_pass_stats){
            .name = lsf_timer_name(reports[i].timer),
            .runs = lsf_timer_runs(reports[i].timer),
            .milliseconds = lsf_timer_milliseconds(reports[i].timer) / iterations,
            .count_count = reports[i].count_count,
            .count_names = reports[i].count_names,
            .counts = reports[i].counts,
        };
    double lost_share;
    uint64_t lost_pixels;
    look_at_pixels(renderer, &lost_share, &lost_pixels);
    return (lsf_renderer_stats){.samples = renderer->samples,
                                .compile_seconds = renderer->compile_seconds,
                                .upload_seconds = renderer->upload_seconds,
                                .render_seconds = renderer->render_seconds,
                                .lost_share = lost_share,
                                .lost_pixels = lost_pixels,
                                .pass_count = count,
                                .passes = renderer->pass_stats};
}
