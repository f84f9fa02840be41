/* Two renderers of what is shown: one that is quick, and keeps light from frame to frame, for what
 * moves; and one that makes, bit by bit, the picture that `lightsheaf render` makes. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUIET 0.12 /* seconds without a change, after which nothing moves any more */
#define SLICE 0.08 /* seconds of iterations between two frames of a still picture */
/* Iterations of the still picture from which on it is better than the quick one. */
enum { ENOUGH = 4 };

/* Options that are coarser while things move, step by step; those that the user has set stay. */
static const char *const coarser[][LSF_BUDGET_COARSEST + 1] = {
    {"environment.directions", "4", "2", "1"},
    {"interleave.size", "3", "2", "2"},
    {"rsm.resolution", "128", "128", "64"},
    {"vpl.shadow_resolution", "128", "128", "64"},
    {"bundle.resolution", "192", "128", "64"},
    {"voxel.resolution", "96", "64", "32"},
    {"cone.count", "6", "4", "4"},
    {"sparse.grid", "1", "2", "2"},
    {"voxel_path.max_samples", "3", "2", "1"},
    {"cloud.count", "65536", "32768", "16384"},
    {"light_tree.samples", "2", "1", "1"},
};

void lsf_viewer_touch(lsf_viewer *viewer)
{
    viewer->stale = true;
}

void lsf_viewer_touch_settings(lsf_viewer *viewer)
{
    viewer->settings_version++;
    viewer->plan_wanted = true;
    lsf_viewer_touch(viewer);
}

lsf_render_params lsf_viewer_params(lsf_viewer *viewer, uint32_t width, uint32_t height)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    lsf_viewer_settings_params(&viewer->settings, &params, &viewer->assignments);
    lsf_viewer_camera_params(&viewer->camera, &params);
    lsf_print(viewer->camera_name, sizeof viewer->camera_name, "%u", viewer->file_camera);
    params.camera = viewer->camera_name;
    params.width = width;
    params.height = height;
    params.time = viewer->time;
    params.present = true;
    return params;
}

static void drop(lsf_viewer_picture *picture)
{
    lsf_renderer_destroy(picture->renderer);
    lsf_canvas_destroy(&picture->canvas);
    *picture = (lsf_viewer_picture){0};
}

void lsf_viewer_drop_pictures(lsf_viewer *viewer)
{
    drop(&viewer->lively);
    drop(&viewer->still);
    lsf_viewer_drop_rival(viewer);
    viewer->stale = true;
}

/* --- times of passes --- */

static uint32_t column_of(lsf_viewer_times *times, const char *name)
{
    for (uint32_t i = 0; i < times->pass_count; i++)
        if (strcmp(times->names[i], name) == 0)
            return i;
    if (times->pass_count == LSF_VIEWER_PASSES)
        return LSF_VIEWER_PASSES - 1;
    lsf_print(times->names[times->pass_count], sizeof times->names[0], "%s", name);
    return times->pass_count++;
}

static void take_times(lsf_viewer *viewer, lsf_renderer *renderer)
{
    lsf_viewer_times *times = &viewer->times;
    const lsf_pass_time *passes;
    uint32_t count = lsf_renderer_poll_times(renderer, &passes);
    float *row = times->milliseconds[times->next];
    memset(row, 0, sizeof times->milliseconds[0]);
    for (uint32_t i = 0; i < count; i++)
        if (passes[i].runs > 0)
            row[column_of(times, passes[i].name)] += (float)passes[i].milliseconds;
    times->next = (times->next + 1) % LSF_VIEWER_HISTORY;
    for (uint32_t i = 0; i < times->pass_count; i++)
        times->mean[i] += 0.1f * (row[i] - times->mean[i]);
}

/* --- both pictures --- */

bool lsf_viewer_adopt(lsf_viewer *viewer, lsf_viewer_picture *picture,
                      const lsf_render_params *params)
{
    bool good;
    picture->error = (lsf_error){LSF_OK, ""};
    if (picture->renderer)
        good = lsf_renderer_change(picture->renderer, params, &picture->error);
    else
        good = (picture->renderer = lsf_renderer_create(viewer->context, viewer->scene, params,
                                                        &picture->error)) != NULL;
    picture->width = params->width;
    picture->height = params->height;
    picture->samples = params->samples;
    picture->version = viewer->settings_version;
    picture->begun = good;
    picture->done = 0;
    return good &&
           lsf_canvas_resize(&picture->canvas, params->width, params->height, &picture->error);
}

static bool present(lsf_viewer *viewer, lsf_viewer_picture *picture)
{
    const lsf_viewer_settings *settings = &viewer->settings;
    const int32_t viewport[4] = {0, 0, (int32_t)picture->width, (int32_t)picture->height};
    if (settings->layer > 0) {
        uint32_t texture =
            lsf_renderer_texture(picture->renderer, 1u << (settings->layer - 1), &picture->error);
        if (texture == 0)
            return false;
        lsf_viewer_show_layer(viewer, texture, &picture->canvas);
        return true;
    }
    return lsf_renderer_present(picture->renderer, picture->canvas.framebuffer, viewport,
                                settings->exposure, (lsf_tone_curve)settings->curve,
                                &picture->error);
}

/* --- the fast renderer --- */

static void make_coarser(lsf_viewer *viewer, lsf_render_params *params)
{
    lsf_viewer_assignments *storage = &viewer->assignments;
    const lsf_viewer_settings *settings = &viewer->settings;
    uint32_t coarse = lsf_budget_coarse(&viewer->budget);
    for (size_t row = 0; coarse > 0 && row < LSF_COUNT(coarser); row++)
        for (uint32_t i = 0; i < settings->option_count; i++) {
            const lsf_viewer_option *option = &settings->options[i];
            if (strcmp(option->key, coarser[row][0]) != 0 || lsf_viewer_option_changed(option))
                continue;
            char *text = storage->text[storage->count];
            lsf_print(text, sizeof storage->text[0], "%s=%s", option->key, coarser[row][coarse]);
            storage->items[storage->count++] = text;
        }
    params->option_count = storage->count;
}

/* No power of two where another size will do: llvmpipe compiles shaders for textures of such sides
 * and for others apart, which takes seconds when the budget comes by one. */
static uint32_t scaled(uint32_t pixels, double scale)
{
    double size = floor((double)pixels * scale + 0.5);
    if (scale == 1.0 || size < 1.0)
        return size < 1.0 ? 1u : pixels;
    uint32_t whole = (uint32_t)size;
    return whole > 2 && (whole & (whole - 1)) == 0 ? whole + 1 : whole;
}

/* `goes_on`: the frame before was one, too. The first one after a pause takes longer. */
static void make_lively(lsf_viewer *viewer, uint32_t width, uint32_t height, bool goes_on)
{
    lsf_viewer_picture *picture = &viewer->lively;
    double scale = lsf_budget_scale(&viewer->budget);
    lsf_render_params params =
        lsf_viewer_params(viewer, scaled(width, scale), scaled(height, scale));
    params.samples = 1;
    params.raw = false;
    params.temporal = true;
    make_coarser(viewer, &params);
    bool other = !picture->renderer || picture->width != params.width ||
                 picture->height != params.height || picture->version != viewer->settings_version;
    lsf_view view = lsf_viewer_camera_view(&viewer->camera);
    const lsf_frame frame = {
        .time = viewer->time, .view = viewer->camera.own ? &view : NULL, .cut = viewer->cut};
    bool good = other ? lsf_viewer_adopt(viewer, picture, &params)
                      : lsf_renderer_begin_frame(picture->renderer, &frame, &picture->error);
    good = good && lsf_renderer_iterate(picture->renderer, &picture->error) &&
           present(viewer, picture);
    viewer->cut = false;
    picture->done = good;
    viewer->spent = good && goes_on;
    if (good)
        take_times(viewer, picture->renderer);
}

/* What is drawn otherwise, or is another scene, has other prices. */
static void follow_settings(lsf_viewer *viewer)
{
    if (viewer->budget_version == viewer->settings_version)
        return;
    viewer->budget_version = viewer->settings_version;
    lsf_budget_start(&viewer->budget, viewer->budget.seconds, viewer->device.software);
}

void lsf_viewer_spend(lsf_viewer *viewer, double seconds)
{
    if (viewer->spent && lsf_budget_measure(&viewer->budget, seconds))
        viewer->lively.version = 0; /* its options follow */
    viewer->spent = false;
}

/* --- the converging renderer --- */

typedef struct slice {
    lsf_viewer *viewer;
    uint32_t done; /* iterations */
    double end;
} slice;

/* Between iterations, and within long ones, which are dropped when the user wants something. */
static bool goes_on(uint32_t done, uint32_t total, void *user)
{
    slice *s = user;
    (void)total;
    bool between = done > s->done;
    s->done = done;
    return !lsf_window_waits(s->viewer->window) && !(between && lsf_now() >= s->end);
}

static void begin_still(lsf_viewer *viewer, uint32_t width, uint32_t height, slice *s)
{
    lsf_render_params params = lsf_viewer_params(viewer, width, height);
    params.progress = goes_on;
    params.progress_user = s;
    lsf_viewer_adopt(viewer, &viewer->still, &params);
}

static void make_still(lsf_viewer *viewer, uint32_t width, uint32_t height)
{
    lsf_viewer_picture *picture = &viewer->still;
    static slice s; /* the renderer keeps its address */
    if (picture->error.code != LSF_OK)
        return;
    if (!picture->begun)
        begin_still(viewer, width, height, &s);
    s = (slice){viewer, picture->done, lsf_now() + SLICE};
    if (!picture->begun || picture->done >= picture->samples)
        return;
    if (lsf_renderer_run(picture->renderer, &picture->error)) {
        picture->done = s.done;
        take_times(viewer, picture->renderer);
        if (picture->done > 0)
            present(viewer, picture);
    }
}

static void expose(lsf_viewer *viewer)
{
    lsf_error error;
    lsf_image *image = lsf_renderer_read(viewer->still.renderer, &error);
    if (image)
        viewer->settings.exposure = roundf(100.0f * lsf_image_auto_exposure(image)) / 100.0f;
    lsf_image_destroy(image);
    viewer->expose_wanted = false;
    viewer->tones_changed = true;
}

/* --- what is shown --- */

const lsf_viewer_picture *lsf_viewer_shown(const lsf_viewer *viewer)
{
    const lsf_viewer_picture *still = &viewer->still;
    uint32_t enough = still->samples < ENOUGH ? still->samples : ENOUGH;
    bool ready = still->begun && still->done >= enough && still->done > 0;
    return ready && !viewer->moving ? still : &viewer->lively;
}

bool lsf_viewer_finished(const lsf_viewer *viewer)
{
    const lsf_viewer_picture *still = &viewer->still;
    return !viewer->scene || still->error.code != LSF_OK ||
           (!viewer->moving && !viewer->stale && still->begun && still->done >= still->samples &&
            lsf_viewer_rival_finished(viewer));
}

void lsf_viewer_refine(lsf_viewer *viewer)
{
    uint32_t width = (uint32_t)viewer->area.width, height = (uint32_t)viewer->area.height;
    lsf_viewer_picture *still = &viewer->still;
    if (!viewer->scene || viewer->area.width < 1.0f || viewer->area.height < 1.0f)
        return;
    bool resized = still->begun && (still->width != width || still->height != height);
    if (viewer->stale || resized) {
        viewer->quiet_since = viewer->input->time;
        still->begun = false;
        still->error = (lsf_error){LSF_OK, ""};
        viewer->stale = false;
    }
    bool moved = viewer->moving;
    viewer->moving = viewer->playing || viewer->input->time - viewer->quiet_since < QUIET;
    follow_settings(viewer);
    if (viewer->moving)
        make_lively(viewer, width, height, moved);
    else
        make_still(viewer, width, height);
    if (viewer->expose_wanted && !viewer->moving && still->begun && still->done >= ENOUGH)
        expose(viewer);
    if (viewer->tones_changed && !viewer->moving && still->begun && still->done > 0)
        present(viewer, still);
    if (viewer->tones_changed && lsf_viewer_shown(viewer) == &viewer->lively &&
        viewer->lively.renderer && viewer->lively.done > 0)
        present(viewer, &viewer->lively);
    viewer->tones_changed = false;
}

static bool save_rgb8(const lsf_canvas *canvas, const char *path,
                      const lsf_image_save_params *params, lsf_error *error)
{
    uint8_t *rgb = lsf_alloc((uint64_t)canvas->width * canvas->height, 3);
    if (rgb)
        lsf_canvas_read(canvas, rgb);
    bool good = rgb ? lsf_image_save_rgb8(rgb, canvas->width, canvas->height, path, params, error)
                    : lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    free(rgb);
    return good;
}

/* With alpha, which a canvas has not. */
static bool save_transparent(const lsf_viewer *viewer, const char *path,
                             const lsf_image_save_params *params, lsf_error *error)
{
    lsf_image *image = lsf_renderer_read(viewer->still.renderer, error);
    bool good = image && lsf_image_save(image, path, params, error);
    lsf_image_destroy(image);
    return good;
}

void lsf_viewer_save_picture(lsf_viewer *viewer, const char *path)
{
    const lsf_viewer_settings *settings = &viewer->settings;
    char *command = lsf_viewer_command(viewer);
    lsf_error error = {LSF_ERROR_RENDER, "no memory left"};
    const lsf_image_text texts[] = {{"lightsheaf.version", lsf_version()},
                                    {"lightsheaf.command", command ? command : ""}};
    const lsf_image_save_params params = {
        LSF_IMAGE_SAVE_PARAMS_DEFAULTS, .exposure = settings->exposure,
        .curve = (lsf_tone_curve)settings->curve, .texts = texts, .text_count = LSF_COUNT(texts)};
    bool transparent = settings->background == LSF_BACKGROUND_TRANSPARENT && settings->layer == 0;
    bool good = command && (transparent ? save_transparent(viewer, path, &params, &error)
                                        : save_rgb8(&viewer->still.canvas, path, &params, &error));
    if (good)
        lsf_viewer_say(viewer, LSF_UI_TEXT, "Saved %s", path);
    else
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
    free(command);
}
