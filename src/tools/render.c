#include "base/base.h"
#include "tools/begin.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/sequence.h"
#include "tools/summary.h"
#include "tools/tools.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

typedef struct render_job {
    const lsf_settings *settings;
    lsf_destination *destination;
    const char *scene_path;
    lsf_scene *scene;
    lsf_context *context;
    lsf_renderer *renderer;
    bool maps_on_gpu; /* tones, for 8-bit output without alpha whose exposure is given */
    lsf_progress_bar bar;
    lsf_renderer_stats stats;
    double start;
    double load_seconds, context_seconds, save_seconds;
    double rendered_before; /* seconds of the frames before */
} render_job;

static bool load(render_job *job, lsf_error *error)
{
    job->scene = lsf_tool_load_scene(job->settings, job->scene_path, &job->load_seconds, error);
    return job->scene != NULL;
}

static bool start_gl(render_job *job, lsf_error *error)
{
    lsf_context_params params = lsf_settings_context_params(job->settings);
    double start = lsf_now();
    job->context = lsf_context_create(&params, error);
    job->context_seconds = lsf_now() - start;
    return job->context != NULL;
}

static bool start_renderer(render_job *job, lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(job->settings);
    job->maps_on_gpu = job->destination->format == LSF_IMAGE_FORMAT_PNG &&
                       params.background != LSF_BACKGROUND_TRANSPARENT &&
                       !job->settings->exposure.automatic;
    params.rgb8 = job->maps_on_gpu;
    params.progress = lsf_interrupt_progress;
    params.progress_user = &job->bar;
    job->renderer = lsf_renderer_create(job->context, job->scene, &params, error);
    return job->renderer != NULL;
}

static bool converge(render_job *job, const char *label, lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(job->settings);
    lsf_interrupt_begin_iterations();
    lsf_progress_bar_start(&job->bar, label, params.samples, params.time_limit);
    bool good = lsf_renderer_run(job->renderer, error);
    lsf_interrupt_end_iterations();
    lsf_progress_bar_clear();
    job->stats = lsf_renderer_get_stats(job->renderer);
    job->stats.render_seconds -= job->rendered_before;
    job->rendered_before += job->stats.render_seconds;
    return good && lsf_context_check(job->context, error);
}

static bool save_float(render_job *job, const lsf_imprint *imprint, lsf_error *error)
{
    lsf_image *image = lsf_renderer_read(job->renderer, error);
    if (image)
        lsf_destination_expose(job->destination, image);
    bool good = image && lsf_destination_save(job->destination, -1, image, imprint, error);
    lsf_image_destroy(image);
    return good;
}

/* Code value 25 is 1 % of white, 245 looks white. A background that is given is no overexposed
 * surface. */
static lsf_brightness brightness_of(const render_job *job, const uint8_t *rgb, uint64_t pixels)
{
    bool background = job->settings->background.kind != LSF_BACKGROUND_AUTO;
    lsf_brightness b = {.pixels = pixels};
    for (const uint8_t *p = rgb; p < rgb + 3 * pixels; p += 3) {
        b.seen += p[0] > 25 || p[1] > 25 || p[2] > 25;
        b.white += !background && p[0] >= 245 && p[1] >= 245 && p[2] >= 245;
    }
    return b;
}

/* The picture is tone-mapped on the GPU: only the bytes of the file are read back. */
static bool save_rgb8(render_job *job, const lsf_imprint *imprint, lsf_error *error)
{
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.texts = imprint->texts;
    params.text_count = imprint->text_count;
    uint32_t width = job->settings->resolution[0], height = job->settings->resolution[1];
    uint8_t *rgb = lsf_alloc((uint64_t)width * height, 3);
    bool good =
        rgb || lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", job->destination->path);
    good = good &&
           lsf_renderer_read_rgb8(job->renderer, job->destination->exposure,
                                  job->destination->curve, rgb, error) &&
           lsf_image_save_rgb8(rgb, width, height, job->destination->path, &params, error);
    if (good) {
        lsf_brightness b = brightness_of(job, rgb, (uint64_t)width * height);
        lsf_destination_warn(job->destination, &b);
    }
    if (good && job->stats.lost_pixels > 0) /* lsf_image_save says so by itself */
        lsf_log(LSF_LOG_WARNING, "%s: %llu of %llu pixels are not finite", job->destination->path,
                (unsigned long long)job->stats.lost_pixels, (unsigned long long)width * height);
    free(rgb);
    return good;
}

static bool save(render_job *job, lsf_error *error)
{
    if (!lsf_interrupt_may_save(job->stats.samples, error))
        return false;
    double start = lsf_now();
    lsf_imprint imprint;
    bool good =
        lsf_imprint_make(&imprint, job->settings, job->scene_path, job->settings->technique,
                         lsf_plan_bounces(lsf_renderer_plan(job->renderer)), job->stats.samples,
                         lsf_plan_weights(lsf_renderer_plan(job->renderer)), error);
    good = good &&
           (job->maps_on_gpu ? save_rgb8(job, &imprint, error) : save_float(job, &imprint, error));
    lsf_imprint_finish(&imprint);
    job->save_seconds = lsf_now() - start;
    return good;
}

static void report(const render_job *job, lsf_json *json)
{
    lsf_context_info device = lsf_context_get_info(job->context);
    double total = lsf_now() - job->start;
    uint32_t bounces = lsf_plan_bounces(lsf_renderer_plan(job->renderer));
    const lsf_summary_seconds seconds[] = {
        {"load", job->load_seconds},
        {"context", job->context_seconds},
        {"compile", job->stats.compile_seconds},
        {"upload", job->stats.upload_seconds},
        {"render", job->stats.render_seconds},
        {"save", job->save_seconds},
        {"total", total},
    };
    char light[32] = "";
    if (bounces > 0)
        snprintf(light, sizeof light, " with %u bounce%s", bounces, lsf_plural(bounces));
    lsf_report_line("%s: %ux%u, %u sample%s%s of %s%s, rendered in %.2f s of %.2f s on %s",
                    job->destination->path, job->settings->resolution[0],
                    job->settings->resolution[1], job->stats.samples,
                    lsf_plural(job->stats.samples), lsf_interrupted() ? " (interrupted)" : "",
                    job->settings->technique, light, job->stats.render_seconds, total,
                    device.renderer);
    if (job->stats.lost_share > 0.0)
        lsf_report_line("%s: bounds removed %.3g %% of the light", job->destination->path,
                        100.0 * job->stats.lost_share);
    lsf_summary summary = {
        .settings = job->settings,
        .scene = job->scene,
        .scene_path = job->scene_path,
        .output = job->destination->path,
        .technique = job->settings->technique,
        .bounces = bounces,
        .samples = job->stats.samples,
        .weights = lsf_plan_weights(lsf_renderer_plan(job->renderer)),
        .interrupted = lsf_interrupted(),
        .exposure = job->destination->exposure,
        .seconds = seconds,
        .seconds_count = LSF_COUNT(seconds),
        .device = &device,
        .stats = &job->stats,
        .plan_bytes = lsf_plan_bytes(lsf_renderer_plan(job->renderer)),
    };
    lsf_summary_add(json, &summary);
}

/* What the scenes of a run share. */
typedef struct render_run {
    lsf_settings settings;
    lsf_destination *destinations;
    double start; /* of what has not been counted for a scene before */
} render_run;

static bool exists(const char *path)
{
    return access(path, F_OK) == 0;
}

/* Renders one frame of a sequence. A frame that is interrupted is not kept: all files are whole. */
static bool render_frame(render_job *job, const lsf_sequence *sequence, uint32_t number,
                         const lsf_view *camera, lsf_json *json, lsf_error *error)
{
    char label[32];
    lsf_view turned;
    const lsf_view *view = lsf_sequence_view(sequence, job->scene, camera, number, &turned);
    lsf_render_params params = lsf_settings_render_params(job->settings);
    lsf_frame frame = lsf_sequence_frame(sequence, number, params.samples, view);
    snprintf(label, sizeof label, "frame %u", number);
    job->start = lsf_now();
    if (!lsf_renderer_begin_frame(job->renderer, &frame, error) || !converge(job, label, error))
        return false;
    if (lsf_interrupted())
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "interrupted in frame %u of %u to %u; --resume continues with it",
                             number, sequence->first, sequence->last);
    if (!save(job, error))
        return false;
    report(job, json);
    return true;
}

static bool render_sequence(render_job *job, const lsf_sequence *sequence, lsf_json *json,
                            lsf_error *error)
{
    lsf_render_params params = lsf_settings_render_params(job->settings);
    lsf_view camera;
    uint64_t there = 0;
    bool good = lsf_render_params_view(job->scene, &params, &camera, error);
    lsf_json_begin(json, NULL, '[');
    for (uint64_t number = sequence->first; good && number <= sequence->last; number++) {
        good = lsf_destination_go_to(job->destination, job->settings, (uint32_t)number, error);
        bool skipped = good && sequence->resume && exists(job->destination->path);
        there += skipped;
        if (good && !skipped)
            good = render_frame(job, sequence, (uint32_t)number, &camera, json, error);
    }
    lsf_json_end(json, ']');
    if (good && there > 0)
        lsf_report_line("%llu frame%s %s there already", (unsigned long long)there,
                        lsf_plural(there), there == 1 ? "was" : "were");
    return good;
}

static bool render_scene(void *user, uint32_t index, const char *path, lsf_json *json,
                         lsf_error *error)
{
    render_run *run = user;
    render_job job = {.settings = &run->settings,
                      .destination = &run->destinations[index],
                      .scene_path = path,
                      .start = run->start};
    const lsf_sequence sequence = lsf_sequence_of(&run->settings);
    bool good = load(&job, error) && start_gl(&job, error) && start_renderer(&job, error);
    if (good && sequence.wanted) {
        good = render_sequence(&job, &sequence, json, error);
    } else if (good) {
        good = converge(&job, "render", error) && save(&job, error);
        if (good)
            report(&job, json);
    }
    lsf_renderer_destroy(job.renderer);
    lsf_context_destroy(job.context);
    lsf_scene_destroy(job.scene);
    run->start = lsf_now();
    return good;
}

int lsf_tool_render(int argc, char **argv)
{
    render_run run = {.start = lsf_now()};
    lsf_error error;
    int status = lsf_tool_begin(&run.settings, LSF_COMMAND_RENDER, argc, argv);
    if (status == LSF_GO_ON) {
        uint32_t count = lsf_tool_scene_count(&run.settings);
        run.destinations = lsf_destinations_create(&run.settings, count, &error);
        status = run.destinations ? lsf_tool_for_each_scene(&run.settings, render_scene, &run)
                                  : lsf_report_error(&error);
        lsf_destinations_destroy(run.destinations, count);
    }
    lsf_settings_finish(&run.settings);
    return status;
}
