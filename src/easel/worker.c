/* The process that runs the shader. */
#include "easel/worker.h"

#include "base/base.h"
#include "easel/protocol.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct worker {
    const lsf_easel_start *start;
    lsf_sandbox_params params;
    lsf_context *context;
    lsf_scene *scene;
    lsf_sandbox *sandbox; /* NULL: none could be made yet */
    struct timespec tried;
    uint8_t *pixels;
    size_t mapped;
    lsf_easel_answer answer;
} worker;

static bool start_worker(worker *w, lsf_error *error)
{
    const lsf_easel_start *start = w->start;
    w->context = lsf_context_create(&start->context, error);
    if (!w->context)
        return false;
    if (start->scene_path)
        w->scene = lsf_scene_load(start->scene_path, &start->scene, error);
    if (start->scene_path && !w->scene)
        return false;
    w->answer.has_camera =
        w->scene && lsf_viewer_camera_reset(&w->answer.camera, w->scene, &w->params.render, error);
    snprintf(w->answer.renderer, sizeof w->answer.renderer, "%s",
             lsf_context_get_info(w->context).renderer);
    return !w->scene || w->answer.has_camera;
}

/* Maps the memory for the pixels of a picture, which the window has made. */
static bool map_pixels(worker *w, size_t bytes)
{
    if (bytes <= w->mapped)
        return true;
    if (w->pixels)
        munmap(w->pixels, w->mapped);
    void *mapped = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, LSF_EASEL_PIXELS, 0);
    w->pixels = mapped == MAP_FAILED ? NULL : mapped;
    w->mapped = w->pixels ? bytes : 0;
    return w->pixels != NULL;
}

/* Whether the file has changed since reading it failed. */
static bool try_again(worker *w)
{
    struct stat status = {0};
    (void)stat(w->params.path, &status);
    bool changed =
        status.st_mtim.tv_sec != w->tried.tv_sec || status.st_mtim.tv_nsec != w->tried.tv_nsec;
    w->tried = status.st_mtim;
    return changed;
}

/* Reads the shader again where it has changed; one that is wrong leaves the last good one.
 * False: nothing has changed. */
static bool follow_files(worker *w, const lsf_easel_request *request)
{
    lsf_error error = {0};
    bool good = true;
    if (!w->sandbox && try_again(w)) {
        w->params.render.width = request->width;
        w->params.render.height = request->height;
        w->sandbox = lsf_sandbox_create(w->context, w->scene, &w->params, &error);
        good = w->sandbox != NULL;
    } else if (w->sandbox && lsf_sandbox_changed(w->sandbox)) {
        good = lsf_sandbox_reload(w->sandbox, &error);
    } else {
        return false;
    }
    snprintf(w->answer.error, sizeof w->answer.error, "%s", good ? "" : error.message);
    return true;
}

static void set_uniforms(worker *w, const lsf_easel_request *request)
{
    for (uint32_t i = 0; i < request->uniform_count; i++)
        lsf_sandbox_set_uniform(w->sandbox, request->uniforms[i].name, request->uniforms[i].value,
                                NULL);
}

static void list_uniforms(worker *w)
{
    lsf_sandbox_uniform uniform;
    uint32_t count = 0;
    while (count < LSF_EASEL_UNIFORMS && lsf_sandbox_get_uniform(w->sandbox, count, &uniform)) {
        lsf_easel_uniform *to = &w->answer.uniforms[count++];
        *to = (lsf_easel_uniform){.integer = uniform.integer,
                                  .slider = uniform.slider,
                                  .components = uniform.components,
                                  .minimum = uniform.minimum,
                                  .maximum = uniform.maximum};
        memcpy(to->value, uniform.value, sizeof to->value);
        snprintf(to->name, sizeof to->name, "%s", uniform.name);
    }
    w->answer.uniform_count = count;
}

static void list_times(worker *w)
{
    const lsf_pass_time *times;
    uint32_t count = lsf_sandbox_poll_times(w->sandbox, &times);
    w->answer.pass_count = count < LSF_EASEL_PASSES ? count : LSF_EASEL_PASSES;
    for (uint32_t i = 0; i < w->answer.pass_count; i++) {
        snprintf(w->answer.passes[i].name, sizeof w->answer.passes[i].name, "%s", times[i].name);
        w->answer.passes[i].milliseconds = (float)times[i].milliseconds;
    }
}

static bool draw(worker *w, const lsf_easel_request *request, lsf_error *error)
{
    const lsf_render_params *now = &w->params.render;
    bool resized = now->width != request->width || now->height != request->height;
    if (resized && !lsf_sandbox_resize(w->sandbox, request->width, request->height, error))
        return false;
    w->params.render.width = request->width;
    w->params.render.height = request->height;
    set_uniforms(w, request);
    if (request->restart)
        lsf_sandbox_restart(w->sandbox);
    lsf_sandbox_frame frame = request->frame;
    frame.keys = (const uint8_t(*)[LSF_SANDBOX_KEYS])request->keys;
    frame.view = request->has_view && w->scene ? &request->view : NULL;
    return lsf_sandbox_run(w->sandbox, &frame, error) &&
           lsf_sandbox_read_rgb8(w->sandbox, request->exposure, w->start->curve, w->pixels, error);
}

static void serve(worker *w, const lsf_easel_request *request)
{
    double begun = lsf_now();
    w->answer.drawn = false;
    bool changed = follow_files(w, request);
    if (request->look && !changed)
        return;
    w->answer.number = request->frame.number;
    if (w->sandbox && map_pixels(w, (size_t)request->width * request->height * 3)) {
        lsf_error error;
        w->answer.drawn = draw(w, request, &error);
        if (!w->answer.drawn)
            snprintf(w->answer.error, sizeof w->answer.error, "%s", error.message);
        list_uniforms(w);
        list_times(w);
    }
    w->answer.milliseconds = 1e3 * (lsf_now() - begun);
}

int lsf_easel_work(const lsf_easel_start *start)
{
    static lsf_easel_request request; /* they are large */
    static worker w;
    lsf_error error;
    w = (worker){.start = start, .params = start->sandbox};
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    bool started = start_worker(&w, &error);
    if (!started)
        snprintf(w.answer.error, sizeof w.answer.error, "%s", error.message);
    bool lost = false; /* the context: another process gets a new one */
    while (!lost &&
           recv(LSF_EASEL_SOCKET, &request, sizeof request, 0) == (ssize_t)sizeof request) {
        if (started)
            serve(&w, &request);
        if (send(LSF_EASEL_SOCKET, &w.answer, sizeof w.answer, 0) < 0)
            break;
        lost = started && !lsf_context_check(w.context, &error);
    }
    lsf_sandbox_destroy(w.sandbox);
    lsf_context_destroy(w.context);
    lsf_scene_destroy(w.scene);
    return 0;
}
