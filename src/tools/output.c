#include "tools/output.h"

#include "base/base.h"
#include "tools/report.h"
#include "tools/scenes.h"
#include "tools/sequence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* The last dot of the file's name, or its end. */
static size_t stem_length(const char *path)
{
    const char *name = strrchr(path, '/');
    name = name ? name + 1 : path;
    const char *dot = strrchr(name, '.');
    return dot && dot != name ? (size_t)(dot - path) : strlen(path);
}

static lsf_image_format format_of(const char *path)
{
    static const struct {
        const char *ending;
        lsf_image_format format;
    } endings[] = {
        {".exr", LSF_IMAGE_FORMAT_EXR},
        {".hdr", LSF_IMAGE_FORMAT_HDR},
        {".png", LSF_IMAGE_FORMAT_PNG},
    };
    const char *ending = path + stem_length(path);
    for (size_t i = 0; i < LSF_COUNT(endings); i++)
        if (strcasecmp(ending, endings[i].ending) == 0)
            return endings[i].format;
    return LSF_IMAGE_FORMAT_AUTO;
}

static bool check_format(lsf_destination *destination, const lsf_settings *settings,
                         lsf_error *error)
{
    const char *path = destination->path;
    bool standard = strcmp(path, "-") == 0;
    destination->format = (lsf_image_format)settings->format;
    if (destination->format == LSF_IMAGE_FORMAT_AUTO)
        destination->format = standard ? LSF_IMAGE_FORMAT_EXR : format_of(path);
    if (destination->format == LSF_IMAGE_FORMAT_AUTO)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--output %s: no format has that ending; use .exr, .hdr or .png, or "
                             "give --format",
                             path);
    if (settings->aovs && destination->format != LSF_IMAGE_FORMAT_EXR)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--aov: only .exr holds layers, and --output is %s; leave --aov out "
                             "or write .exr",
                             path);
    if (settings->background.kind == LSF_BACKGROUND_TRANSPARENT &&
        destination->format == LSF_IMAGE_FORMAT_HDR)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--background transparent: .hdr holds no alpha; write .exr or .png");
    if (destination->format != LSF_IMAGE_FORMAT_PNG)
        destination->exposure = NAN;
    if (standard && isatty(STDOUT_FILENO))
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--output -: standard output is a terminal; redirect it into a file "
                             "or a pipe");
    return true;
}

static bool check_halves(lsf_destination *destination, lsf_error *error)
{
    const char *path = destination->path;
    if (strcmp(path, "-") == 0)
        return lsf_error_set(
            error, LSF_ERROR_USAGE,
            "--halves: cannot write three pictures to standard output; give a file to --output");
    size_t stem = stem_length(path);
    for (int half = 0; half < 2; half++) {
        destination->half_paths[half] =
            lsf_format("%.*s_%c%s", (int)stem, path, 'a' + half, path + stem);
        if (!destination->half_paths[half])
            return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", path);
        if (!lsf_file_can_write(destination->half_paths[half], error))
            return false;
    }
    return true;
}

static bool check_json(const lsf_destination *destination, const char *json, lsf_error *error)
{
    bool same = strcmp(json, destination->path) == 0;
    for (int half = 0; half < 2; half++)
        same = same ||
               (destination->half_paths[half] && strcmp(json, destination->half_paths[half]) == 0);
    if (same)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--json %s: this is the path of the picture; use another one", json);
    return true;
}

/* The scene's name in place of each %s. */
static char *fill_in(const char *output, const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const char *name = strcmp(scene, "-") == 0 ? "stdin" : slash ? slash + 1 : scene;
    lsf_string path = {0};
    for (const char *c = output; *c; c++) {
        if (c[0] == '%' && c[1] == 's') {
            lsf_string_add_bytes(&path, name, stem_length(name));
            c++;
        } else {
            lsf_string_add_bytes(&path, c, 1);
        }
    }
    return path.text;
}

static float exposure_of(const lsf_settings *settings)
{
    return settings->exposure.automatic ? NAN : settings->exposure.ev;
}

bool lsf_destination_go_to(lsf_destination *destination, const lsf_settings *settings,
                           uint32_t frame, lsf_error *error)
{
    free(destination->path);
    destination->path = lsf_sequence_path(destination->output, frame);
    if (destination->format == LSF_IMAGE_FORMAT_PNG)
        destination->exposure = exposure_of(settings);
    return destination->path || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
}

static bool prepare(lsf_destination *destination, const lsf_settings *settings, uint32_t scene,
                    lsf_error *error)
{
    char *scene_path = lsf_tool_scene_path(settings, scene, error);
    if (!scene_path)
        return false;
    const lsf_sequence sequence = lsf_sequence_of(settings);
    *destination = (lsf_destination){.output = fill_in(settings->output, scene_path),
                                     .exposure = exposure_of(settings),
                                     .curve = (lsf_tone_curve)settings->tonemap};
    free(scene_path);
    if (!destination->output)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    if (!lsf_sequence_check_output(&sequence, settings->output, error))
        return false;
    destination->path = sequence.wanted ? lsf_sequence_path(destination->output, sequence.first)
                                        : strdup(destination->output);
    if (!destination->path)
        return lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    if (!check_format(destination, settings, error) ||
        !lsf_file_can_write(destination->path, error) ||
        (settings->halves && !check_halves(destination, error)) ||
        (settings->json_path && !check_json(destination, settings->json_path, error)))
        return false;
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.format = destination->format;
    return lsf_image_can_save(settings->resolution[0], settings->resolution[1], destination->path,
                              &params, error);
}

/* The picture and its halves; NULL where there is none. */
static const char *path_of(const lsf_destination *destination, int which)
{
    return which < 2 ? destination->half_paths[which] : destination->path;
}

static bool check_distinct(const lsf_destination *destinations, uint32_t last,
                           const lsf_settings *settings, lsf_error *error)
{
    const lsf_list_setting *scenes = &settings->operands;
    for (uint32_t i = 0; i < last; i++)
        for (int pair = 0; pair < 9; pair++) {
            const char *a = path_of(&destinations[i], pair % 3);
            const char *b = path_of(&destinations[last], pair / 3);
            if (a && b && strcmp(a, b) == 0)
                return lsf_error_set(
                    error, LSF_ERROR_USAGE,
                    "--output %s: the pictures of %s and %s have the same path, %s; %s",
                    settings->output, scenes->items[i], scenes->items[last], a,
                    strstr(settings->output, "%s")
                        ? "render them separately"
                        : "write %s in place of the scene's name, as in -o '%s.png'");
        }
    return true;
}

lsf_destination *lsf_destinations_create(const lsf_settings *settings, uint32_t count,
                                         lsf_error *error)
{
    if (!settings->output) {
        lsf_error_set(
            error, LSF_ERROR_USAGE,
            "--output: missing; give the file of the picture: -o picture.exr, .hdr, .png, or - for "
            "standard output");
        return NULL;
    }
    lsf_destination *destinations = lsf_alloc(count, sizeof *destinations);
    if (!destinations)
        lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    for (uint32_t i = 0; destinations && i < count; i++)
        if (!prepare(&destinations[i], settings, i, error) ||
            !check_distinct(destinations, i, settings, error)) {
            lsf_destinations_destroy(destinations, count);
            destinations = NULL;
        }
    return destinations;
}

void lsf_destinations_destroy(lsf_destination *destinations, uint32_t count)
{
    for (uint32_t i = 0; destinations && i < count; i++) {
        free(destinations[i].output);
        free(destinations[i].path);
        free(destinations[i].half_paths[0]);
        free(destinations[i].half_paths[1]);
    }
    free(destinations);
}

void lsf_destination_expose(lsf_destination *destination, const lsf_image *image)
{
    if (destination->format != LSF_IMAGE_FORMAT_PNG || !isnan(destination->exposure))
        return;
    destination->exposure = lsf_image_auto_exposure(image);
    lsf_report_line("%s: exposure %+.2f EV, which brings the log-average luminance to 0.18",
                    destination->path, (double)destination->exposure);
}

void lsf_destination_warn(const lsf_destination *destination, const lsf_brightness *b)
{
    bool exposed = destination->format == LSF_IMAGE_FORMAT_PNG;
    if (exposed && 2 * b->white > b->seen)
        lsf_log(LSF_LOG_WARNING,
                "%s: overexposed: %.0f %% of what is not black is white; use --exposure auto or a "
                "lower EV",
                destination->path, 100.0 * (double)b->white / (double)b->seen);
    if (100 * b->seen < b->pixels)
        lsf_log(LSF_LOG_WARNING,
                "%s: nearly black: less than 1 in 100 pixels shows more than 1 %% of white%s; "
                "%s--default-light always adds light",
                destination->path, exposed ? "" : ", a radiance of 0.01",
                exposed ? "use --exposure auto for a dimly lit scene; " : "");
}

/* Least radiance of the channels from which a pixel looks white: `neutral` shows a grey of 1.25 as
 * code value 245. */
#define WHITE 1.25f

static void look_at_brightness(const lsf_destination *destination, const lsf_image *image)
{
    int rgb[3] = {lsf_image_channel(image, "R"), lsf_image_channel(image, "G"),
                  lsf_image_channel(image, "B")};
    int alpha = lsf_image_channel(image, "A");
    bool exposed = destination->format == LSF_IMAGE_FORMAT_PNG;
    float unit = exp2f(exposed ? -destination->exposure : 0.0f), least = 0.01f * unit;
    lsf_brightness b = {0};
    for (uint64_t i = 0; i < (uint64_t)image->width * image->height; i++) {
        const float *pixel = image->pixels + i * image->channel_count;
        if (alpha >= 0 && !(pixel[alpha] > 0.0f))
            continue;
        float red = pixel[rgb[0]], green = pixel[rgb[1]], blue = pixel[rgb[2]];
        b.pixels++;
        b.seen += red > least || green > least || blue > least;
        b.white += fminf(red, fminf(green, blue)) >= WHITE * unit;
    }
    lsf_destination_warn(destination, &b);
}

bool lsf_destination_save(const lsf_destination *destination, int half, const lsf_image *image,
                          const lsf_imprint *imprint, lsf_error *error)
{
    lsf_image_save_params params = {LSF_IMAGE_SAVE_PARAMS_DEFAULTS};
    params.format = destination->format;
    params.texts = imprint->texts;
    params.text_count = imprint->text_count;
    params.exposure = destination->exposure;
    params.curve = destination->curve;
    if (!lsf_image_save(image, half < 0 ? destination->path : destination->half_paths[half],
                        &params, error))
        return false;
    if (half < 0)
        look_at_brightness(destination, image);
    return true;
}
