#include "tools/sandbox.h"
#include "base/base.h"
#include "easel/easel.h"
#include "tools/begin.h"
#include "tools/interrupt.h"
#include "tools/output.h"
#include "tools/report.h"
#include "tools/sandbox_new.h"
#include "tools/scenes.h"
#include "tools/sequence.h"
#include "tools/tools.h"
#include "tools/watch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct sandbox_job {
    const lsf_settings *settings;
    lsf_destination *destination;
    lsf_scene *scene; /* NULL: none */
    lsf_context *context;
    lsf_sandbox *sandbox;
} sandbox_job;

const char *lsf_sandbox_shader(const lsf_settings *settings)
{
    return settings->sandbox ? settings->sandbox : settings->operands.items[0];
}

lsf_sandbox_params lsf_settings_sandbox_params(const lsf_settings *settings)
{
    lsf_sandbox_params params = {LSF_SANDBOX_PARAMS_DEFAULTS};
    params.path = lsf_sandbox_shader(settings);
    params.channels = settings->channels.items;
    params.channel_count = settings->channels.count;
    params.uniforms = settings->uniforms.items;
    params.uniform_count = settings->uniforms.count;
    params.render = lsf_settings_render_params(settings);
    return params;
}

/* --- pictures --- */

static lsf_sandbox_frame frame_of(const lsf_settings *settings, uint32_t number)
{
    lsf_sandbox_frame frame = {LSF_SANDBOX_FRAME_DEFAULTS};
    double since = (double)number / settings->fps;
    frame.number = number;
    frame.time = settings->time + since;
    frame.time_delta = 1.0 / settings->fps;
    for (int i = 0; i < 2; i++) {
        frame.mouse[i] = (float)settings->mouse[i];
        frame.mouse[2 + i] = i == 0 || number == 0 ? frame.mouse[i] : -frame.mouse[i];
    }
    /* The date is the first day of 2000, so that the picture is the same whenever it is made. */
    frame.date[0] = 2000.0f;
    frame.date[2] = 1.0f;
    frame.date[3] = (float)frame.time;
    return frame;
}

static bool save_display(sandbox_job *job, const lsf_imprint *imprint, lsf_error *error)
{
    const uint32_t *size = job->settings->resolution;
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.texts = imprint->texts;
    params.text_count = imprint->text_count;
    uint8_t *rgb = lsf_alloc((uint64_t)size[0] * size[1], 3);
    bool good =
        rgb || lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", job->destination->path);
    good = good && lsf_sandbox_read_rgb8(job->sandbox, 0.0f, LSF_TONE_CURVE_NONE, rgb, error) &&
           lsf_image_save_rgb8(rgb, size[0], size[1], job->destination->path, &params, error);
    free(rgb);
    return good;
}

static bool save_float(sandbox_job *job, const lsf_imprint *imprint, lsf_error *error)
{
    lsf_image *image = lsf_sandbox_read(job->sandbox, error);
    if (image)
        lsf_destination_expose(job->destination, image);
    bool good = image && lsf_destination_save(job->destination, -1, image, imprint, error);
    lsf_image_destroy(image);
    return good;
}

static bool save(sandbox_job *job, uint32_t number, lsf_error *error)
{
    const lsf_settings *settings = job->settings;
    bool display = job->destination->format == LSF_IMAGE_FORMAT_PNG &&
                   !lsf_sandbox_writes_radiance(job->sandbox);
    lsf_imprint imprint;
    char what[200];
    snprintf(what, sizeof what, "%s", job->destination->path);
    lsf_watch_step(what, false);
    bool good = lsf_imprint_make(&imprint, settings, lsf_sandbox_shader(settings), "sandbox", 0,
                                 number + 1, NULL, error);
    good =
        good && (display ? save_display(job, &imprint, error) : save_float(job, &imprint, error));
    lsf_imprint_finish(&imprint);
    return good;
}

static bool run_frame(sandbox_job *job, uint32_t number, bool wanted, lsf_error *error)
{
    lsf_sandbox_frame frame = frame_of(job->settings, number);
    char what[200];
    snprintf(what, sizeof what, "%.150s: frame %u", lsf_sandbox_shader(job->settings), number);
    lsf_watch_step(what, true);
    return lsf_sandbox_run(job->sandbox, &frame, error) &&
           (!wanted || (lsf_destination_go_to(job->destination, job->settings, number, error) &&
                        save(job, number, error)));
}

/* Frames that are not asked for run where later frames depend on them. */
static bool run_frames(sandbox_job *job, lsf_error *error)
{
    const lsf_settings *settings = job->settings;
    const lsf_sequence sequence = lsf_sequence_of(settings);
    uint32_t first = sequence.wanted ? sequence.first : settings->frame;
    uint64_t last = sequence.wanted ? sequence.last : settings->frame;
    uint64_t start = lsf_sandbox_feeds_back(job->sandbox) ? 0 : first;
    double begun = lsf_now();
    for (uint64_t number = start; number <= last; number++)
        if (!run_frame(job, (uint32_t)number, number >= first, error))
            return false;
    lsf_report_line("%s: %ux%u, %s%llu of %s, in %.2f s on %s", job->destination->path,
                    settings->resolution[0], settings->resolution[1],
                    last > first ? "frames up to " : "frame ", (unsigned long long)last,
                    lsf_sandbox_shader(settings), lsf_now() - begun,
                    lsf_context_get_info(job->context).renderer);
    return true;
}

static bool start(sandbox_job *job, lsf_error *error)
{
    const lsf_settings *settings = job->settings;
    lsf_context_params gl = lsf_settings_context_params(settings);
    lsf_sandbox_params params = lsf_settings_sandbox_params(settings);
    double seconds;
    char what[200];
    snprintf(what, sizeof what, "%.180s: compiling", params.path);
    lsf_watch_step(what, false);
    if (settings->operands.count > 1)
        job->scene = lsf_tool_load_scene(settings, settings->operands.items[1], &seconds, error);
    if (settings->operands.count > 1 && !job->scene)
        return false;
    job->context = lsf_context_create(&gl, error);
    if (!job->context)
        return false;
    lsf_watch_step(what, true);
    job->sandbox = lsf_sandbox_create(job->context, job->scene, &params, error);
    return job->sandbox != NULL;
}

static int work(void *user)
{
    sandbox_job *job = user;
    lsf_error error;
    lsf_watch_step(lsf_sandbox_shader(job->settings), false);
    job->destination = lsf_destinations_create(job->settings, 1, &error);
    bool good = job->destination && start(job, &error) && run_frames(job, &error);
    lsf_destinations_destroy(job->destination, 1);
    lsf_sandbox_destroy(job->sandbox);
    lsf_context_destroy(job->context);
    lsf_scene_destroy(job->scene);
    return good ? 0 : lsf_report_error(&error);
}

/* --- in a window --- */

/* The default width leaves space for the panel beside a picture. */
enum { WINDOW_WIDTH = 1024, WINDOW_HEIGHT = 576 };

static lsf_easel_start easel_start(const lsf_settings *settings)
{
    lsf_easel_start start = {.sandbox = lsf_settings_sandbox_params(settings),
                             .scene = lsf_settings_scene_params(settings),
                             .context = lsf_settings_context_params(settings),
                             .exposure = settings->exposure.ev,
                             .curve = (lsf_tone_curve)settings->tonemap,
                             .watchdog = settings->watchdog,
                             .window = {LSF_WINDOW_PARAMS_DEFAULTS}};
    if (settings->operands.count > 1)
        start.scene_path = settings->operands.items[1];
    start.window.title = start.sandbox.path;
    bool sized = lsf_settings_given(settings, "resolution");
    start.window.width = sized ? settings->resolution[0] : WINDOW_WIDTH;
    start.window.height = sized ? settings->resolution[1] : WINDOW_HEIGHT;
    start.window.full_screen = settings->full_screen;
    start.window.shader_dir = settings->shader_dir;
    start.window.record = settings->record;
    start.window.replay = settings->replay;
    start.window.coverage = settings->coverage;
    return start;
}

/* The command line as a program of its own has it. NULL without memory. */
static char **whole_command(int argc, char **argv)
{
    char **command = lsf_alloc((uint64_t)argc + 2, sizeof *command);
    if (command) {
        command[0] = (char *)"lightsheaf";
        memcpy(command + 1, argv, (size_t)argc * sizeof *command);
    }
    return command;
}

static int show(const lsf_settings *settings, int argc, char **argv)
{
    static const void *table;
    lsf_error error;
    lsf_easel_start start = easel_start(settings);
    const lsf_easel_module *module =
        lsf_module_table(LSF_WINDOW_MODULE_NAME, LSF_EASEL_MODULE_TABLE,
                         "it comes with Lightsheaf, and needs libglfw3", &table, &error);
    if (!module)
        return lsf_report_error(&error);
    if (getenv(LSF_EASEL_WORKER))
        return module->work(&start);
    char **command = whole_command(argc, argv);
    start.command = command;
    bool good = command ? module->show(&start, &error)
                        : lsf_error_set(&error, LSF_ERROR_RENDER, "no memory left");
    free(command);
    return good ? 0 : lsf_report_error(&error);
}

static int run(const lsf_settings *settings, int argc, char **argv)
{
    lsf_error error;
    sandbox_job job = {.settings = settings};
    if (settings->new_shader)
        return lsf_sandbox_new(settings->new_shader, &error) ? 0 : lsf_report_error(&error);
    if (!settings->output)
        return show(settings, argc, argv);
    return lsf_watch(work, &job, settings->watchdog);
}

int lsf_tool_sandbox(int argc, char **argv)
{
    lsf_settings settings;
    int status = lsf_tool_begin(&settings, LSF_COMMAND_SANDBOX, argc, argv);
    if (status == LSF_GO_ON)
        status = run(&settings, argc, argv);
    lsf_settings_finish(&settings);
    return status;
}
