#include "tools/measure_reference.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/base.h"
#include "sweep/errors.h"
#include "tools/interrupt.h"
#include "tools/summary.h"

/* Samples of each half; and those of a round, after which an interrupt loses nothing. */
enum { REFERENCE_SAMPLES = 256, ROUND = 256 };

/* --- the cache --- */

/* Where users' caches go (XDG Base Directory Specification); NULL: nowhere. */
static char *default_folder(void)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    if (cache && cache[0] == '/')
        return lsf_format("%s/lightsheaf", cache);
    return home && home[0] == '/' ? lsf_format("%s/.cache/lightsheaf", home) : NULL;
}

/* With all folders above it. What fails shows when a file is written. */
static void make_folder(const char *path)
{
    char *copy = strdup(path);
    for (char *slash = copy ? strchr(copy + 1, '/') : NULL; slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(copy, 0777);
        *slash = '/';
    }
    if (copy)
        mkdir(copy, 0777);
    free(copy);
}

/* The file of this reference; NULL: none is kept. */
static char *cache_path(const lsf_settings *settings, const lsf_scene *scene,
                        const lsf_render_params *params, char key[33])
{
    lsf_scene_params scene_params = lsf_settings_scene_params(settings);
    const char *wanted = settings->cache;
    char hash[33], *path = NULL;
    if (!lsf_scene_content_hash(scene, hash) ||
        !lsf_reference_key(hash, &scene_params, params, lsf_summary_bounces(settings, scene), key))
        return NULL;
    if (wanted && strcmp(wanted, "none") == 0)
        return NULL;
    char *folder = wanted ? strdup(wanted) : default_folder();
    if (folder) {
        make_folder(folder);
        path = lsf_format("%s/%s.reference", folder, key);
    }
    free(folder);
    return path;
}

static void load_cached(lsf_kept_reference *kept, const char *path, const lsf_settings *settings)
{
    lsf_error error;
    if (!path || access(path, F_OK) != 0)
        return;
    if (!lsf_kept_reference_load(kept, path, &error)) {
        lsf_log(LSF_LOG_WARNING, "%s; the reference is traced again", error.message);
    } else if (kept->width != settings->resolution[0] || kept->height != settings->resolution[1]) {
        lsf_log(LSF_LOG_WARNING, "%s: has another size; the reference is traced again", path);
        lsf_kept_reference_finish(kept);
    }
}

/* --- tracing --- */

static bool trace(const lsf_settings *settings, const lsf_scene *scene,
                  const lsf_render_params *view, const char *path, lsf_kept_reference *kept,
                  lsf_error *error)
{
    lsf_progress_bar bar;
    lsf_render_params params = *view;
    uint64_t wanted = settings->reference_samples ? settings->reference_samples : REFERENCE_SAMPLES;
    bool good = true, warned = false;
    params.progress = lsf_interrupt_progress;
    params.progress_user = &bar;
    while (good && kept->samples[0] < wanted && !lsf_interrupted()) {
        uint64_t left = wanted - kept->samples[0];
        uint32_t round = (uint32_t)(left < ROUND ? left : ROUND);
        lsf_error cause;
        lsf_progress_bar_start(&bar, "reference", round, INFINITY);
        good = lsf_kept_reference_trace(kept, scene, &params, round, error);
        lsf_progress_bar_clear();
        if (good && path && !warned && !lsf_kept_reference_save(kept, path, &cause)) {
            lsf_log(LSF_LOG_WARNING, "%s; the reference is not kept", cause.message);
            warned = true;
        }
    }
    return lsf_interrupted()
               ? lsf_error_set(
                     error, LSF_ERROR_RENDER,
                     "interrupted before the reference was complete; nothing was measured%s",
                     path && kept->rounds > 0 ? ", but its samples so far are cached" : "")
               : good;
}

/* --- what it is --- */

static void describe(const lsf_kept_reference *kept, lsf_measurement *measurement)
{
    lsf_measured_reference *reference = &measurement->reference;
    lsf_reference_halves halves = {.width = kept->width,
                                   .height = kept->height,
                                   .halves = {kept->halves[0]->pixels, kept->halves[1]->pixels}};
    lsf_reference_halves_derive(&halves);
    memcpy(reference->samples, kept->samples, sizeof reference->samples);
    memcpy(reference->mean, halves.mean, sizeof reference->mean);
    reference->seconds = kept->seconds;
    reference->rmse = halves.rmse;
    measurement->relmse_epsilon = halves.epsilon;
}

static bool save_one(const lsf_image *image, const lsf_settings *settings, const char *name,
                     char **path, lsf_error *error)
{
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.exposure = settings->exposure.ev;
    *path = lsf_format("%s/%s", settings->picture_folder, name);
    return *path ? lsf_image_save(image, *path, &params, error)
                 : lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

/* The halves, and their mean. */
static bool save(const lsf_settings *settings, const lsf_kept_reference *kept,
                 lsf_measured_reference *reference, lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    const lsf_image *a = kept->halves[0], *b = kept->halves[1];
    const char *folder = settings->picture_folder;
    if (!folder)
        return true;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return lsf_error_set(error, LSF_ERROR_FILE, "--pictures %s: cannot create the folder: %s",
                             folder, strerror(errno));
    lsf_image *mean = lsf_image_create(a->width, a->height, 3, names, error);
    for (size_t i = 0; mean && i < (size_t)3 * a->width * a->height; i++)
        mean->pixels[i] = 0.5f * (a->pixels[i] + b->pixels[i]);
    bool good = mean && save_one(mean, settings, "reference.exr", &reference->picture, error) &&
                save_one(mean, settings, "reference.png", &reference->preview, error) &&
                save_one(a, settings, "reference_a.exr", &reference->halves[0], error) &&
                save_one(b, settings, "reference_b.exr", &reference->halves[1], error);
    lsf_image_destroy(mean);
    return good;
}

bool lsf_measure_trace(const lsf_settings *settings, const lsf_scene *scene,
                       const lsf_render_params *params, lsf_kept_reference *kept, char key[33],
                       lsf_error *error)
{
    char *path = cache_path(settings, scene, params, key);
    load_cached(kept, path, settings);
    bool good = trace(settings, scene, params, path, kept, error);
    free(path);
    return good;
}

bool lsf_measure_reference(const lsf_settings *settings, const lsf_scene *scene,
                           lsf_measurement *measurement, lsf_kept_reference *kept, lsf_error *error)
{
    lsf_measured_reference *reference = &measurement->reference;
    lsf_render_params params = lsf_settings_render_params(settings);
    if (!lsf_measure_trace(settings, scene, &params, kept, reference->key, error))
        return false;
    describe(kept, measurement);
    reference->cached = !kept->traced;
    return save(settings, kept, reference, error);
}
