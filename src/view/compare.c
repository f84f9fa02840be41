/* A second picture beside the first: of another technique, or of the path tracer, which runs on a
 * thread of its own. */
#include "view/app.h"

#include "base/base.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define SLICE 0.08 /* seconds of iterations between two frames */
#define FIRST_SAMPLES 4u
#define MORE_SAMPLES 4u /* times as many, from one picture of the path tracer to the next */

/* --- the path tracer --- */

typedef struct lsf_viewer_tracer {
    pthread_t thread;
    const lsf_scene *scene;
    lsf_render_params params;
    float position[3], target[3];
    char camera[16];
    atomic_bool stop, ended;
    lsf_image *image; /* NULL: it failed, or was stopped */
    lsf_error error;
} tracer;

static bool goes_on(uint32_t done, uint32_t total, void *user)
{
    tracer *t = user;
    (void)done, (void)total;
    return !atomic_load(&t->stop);
}

static void *trace(void *user)
{
    tracer *t = user;
    lsf_reference_result result;
    t->image = lsf_reference_render(t->scene, &t->params, 0, &result, &t->error);
    atomic_store(&t->ended, true);
    return NULL;
}

static void start_tracer(lsf_viewer *viewer, uint32_t samples)
{
    lsf_viewer_compare *compare = &viewer->compare;
    tracer *t = lsf_alloc(1, sizeof *t);
    if (!t)
        return;
    t->scene = viewer->scene;
    t->params = lsf_viewer_params(viewer, viewer->still.width, viewer->still.height);
    t->params.samples = samples;
    t->params.aovs = 0;
    t->params.options = NULL;
    t->params.option_count = 0;
    t->params.progress = goes_on;
    t->params.progress_user = t;
    /* The viewer goes on meanwhile. */
    memcpy(t->position, viewer->camera.position, sizeof t->position);
    memcpy(t->target, viewer->camera.target, sizeof t->target);
    memcpy(t->camera, viewer->camera_name, sizeof t->camera);
    t->params.camera = t->camera;
    t->params.camera_position = viewer->camera.own ? t->position : NULL;
    t->params.camera_target = viewer->camera.own ? t->target : NULL;
    if (pthread_create(&t->thread, NULL, trace, t) == 0)
        compare->tracer = t;
    else
        free(t);
}

/* Its picture, which is the caller's; NULL: there is none. */
static lsf_image *end_tracer(lsf_viewer *viewer, lsf_error *error)
{
    tracer *t = viewer->compare.tracer;
    if (!t)
        return NULL;
    bool stopped = !atomic_load(&t->ended);
    atomic_store(&t->stop, true);
    pthread_join(t->thread, NULL);
    lsf_image *image = t->image;
    if (!image)
        *error = t->error;
    if (stopped) {
        lsf_image_destroy(image);
        image = NULL;
    }
    free(t);
    viewer->compare.tracer = NULL;
    return image;
}

void lsf_viewer_stop_rival(lsf_viewer *viewer)
{
    lsf_error error;
    lsf_image_destroy(end_tracer(viewer, &error));
}

void lsf_viewer_drop_rival(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    lsf_viewer_stop_rival(viewer);
    lsf_renderer_destroy(compare->picture.renderer);
    lsf_canvas_destroy(&compare->picture.canvas);
    lsf_canvas_destroy(&compare->apart);
    lsf_image_destroy(compare->image);
    compare->picture = (lsf_viewer_picture){0};
    compare->image = NULL;
    compare->measured = false;
    compare->traced = 0;
}

/* --- metrics and the difference --- */

static bool show_image(lsf_viewer *viewer, const lsf_image *image, lsf_canvas *canvas,
                       float exposure, lsf_tone_curve curve, lsf_error *error)
{
    (void)viewer;
    uint8_t *rgb = lsf_alloc((uint64_t)image->width * image->height, 3);
    bool good = rgb && lsf_image_to_rgb8(image, exposure, curve, rgb, error) &&
                lsf_canvas_resize(canvas, image->width, image->height, error);
    if (good)
        lsf_canvas_write(canvas, rgb);
    free(rgb);
    return good;
}

/* Of the finished picture against the rival's. */
static void measure(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    const lsf_viewer_settings *settings = &viewer->settings;
    const lsf_compare_params params = {LSF_COMPARE_PARAMS_DEFAULTS, .exposure = settings->exposure,
                                       .curve = (lsf_tone_curve)settings->curve};
    lsf_error error = {LSF_OK, ""};
    lsf_image *image = lsf_renderer_read(viewer->still.renderer, &error);
    compare->measured =
        image && lsf_compare(image, compare->image, &params, &compare->result, &error);
    lsf_image *apart = compare->measured
                           ? lsf_compare_difference(image, compare->image, compare->gain, &error)
                           : NULL;
    if (apart)
        show_image(viewer, apart, &compare->apart, settings->exposure, LSF_TONE_CURVE_NONE, &error);
    lsf_image_destroy(apart);
    lsf_image_destroy(image);
    if (error.code != LSF_OK)
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
}

static void take_image(lsf_viewer *viewer, lsf_image *image)
{
    lsf_viewer_compare *compare = &viewer->compare;
    lsf_image_destroy(compare->image);
    compare->image = image;
    compare->measured = false;
}

/* --- a frame --- */

static void refine_reference(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    const lsf_viewer_settings *settings = &viewer->settings;
    uint32_t most = settings->samples;
    if (compare->tracer && atomic_load(&compare->tracer->ended)) {
        uint32_t samples = compare->tracer->params.samples;
        lsf_image *image = end_tracer(viewer, &compare->picture.error);
        if (image && show_image(viewer, image, &compare->picture.canvas, settings->exposure,
                                (lsf_tone_curve)settings->curve, &compare->picture.error)) {
            take_image(viewer, image);
            compare->traced = samples;
        }
    }
    if (compare->tracer || compare->picture.error.code != LSF_OK || compare->traced >= most)
        return;
    uint32_t next = compare->traced ? MORE_SAMPLES * compare->traced : FIRST_SAMPLES;
    start_tracer(viewer, next < most ? next : most);
}

static bool slice_goes_on(uint32_t done, uint32_t total, void *user)
{
    lsf_viewer *viewer = user;
    lsf_viewer_picture *picture = &viewer->compare.picture;
    (void)total;
    bool between = done > picture->done;
    picture->done = done;
    return !lsf_window_waits(viewer->window) && !(between && lsf_now() >= viewer->slice_end);
}

static void refine_technique(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    lsf_viewer_picture *picture = &compare->picture;
    const lsf_viewer_settings *settings = &viewer->settings;
    if (picture->error.code != LSF_OK || (picture->begun && picture->done >= picture->samples))
        return;
    if (!picture->begun) {
        lsf_render_params params =
            lsf_viewer_params(viewer, viewer->still.width, viewer->still.height);
        params.technique = lsf_technique_name((uint32_t)(compare->rival - LSF_VIEWER_TECHNIQUE));
        params.aovs = 0;
        params.progress = slice_goes_on;
        params.progress_user = viewer;
        picture->begun = lsf_viewer_adopt(viewer, picture, &params);
    }
    viewer->slice_end = lsf_now() + SLICE;
    const int32_t viewport[4] = {0, 0, (int32_t)picture->width, (int32_t)picture->height};
    if (!picture->begun || !lsf_renderer_run(picture->renderer, &picture->error) ||
        picture->done == 0)
        return;
    lsf_renderer_present(picture->renderer, picture->canvas.framebuffer, viewport,
                         settings->exposure, (lsf_tone_curve)settings->curve, &picture->error);
    if (picture->done >= picture->samples)
        take_image(viewer, lsf_renderer_read(picture->renderer, &picture->error));
}

bool lsf_viewer_rival_finished(const lsf_viewer *viewer)
{
    const lsf_viewer_compare *compare = &viewer->compare;
    if (compare->rival == LSF_VIEWER_ALONE || compare->picture.error.code != LSF_OK)
        return true;
    uint32_t done =
        compare->rival == LSF_VIEWER_REFERENCE ? compare->traced : compare->picture.done;
    return done >= viewer->settings.samples && compare->measured;
}

void lsf_viewer_refine_rival(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    const lsf_viewer_picture *still = &viewer->still;
    if (compare->rival == LSF_VIEWER_ALONE || !viewer->scene)
        return;
    if (!still->begun || viewer->moving) { /* the picture is another one from now on */
        lsf_viewer_stop_rival(viewer);
        compare->picture.begun = compare->measured = false;
        compare->picture.done = compare->traced = 0;
        compare->picture.error = (lsf_error){LSF_OK, ""};
        return;
    }
    if (compare->rival == LSF_VIEWER_REFERENCE)
        refine_reference(viewer);
    else if (still->done >= still->samples)
        refine_technique(viewer);
    if (compare->image && !compare->measured && still->done >= still->samples &&
        compare->image->width == still->width && compare->image->height == still->height)
        measure(viewer);
}
