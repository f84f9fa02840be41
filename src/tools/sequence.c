#include "tools/sequence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"

/* Random numbers are this far apart from frame to frame where a time limit leaves the samples
 * open. */
#define OPEN_SAMPLES 65536u

lsf_sequence lsf_sequence_of(const lsf_settings *settings)
{
    uint32_t turntable_frames = settings->turntable;
    lsf_sequence sequence = {.wanted = settings->frames.given || turntable_frames > 0,
                             .first = settings->frames.first,
                             .last = settings->frames.last,
                             .start = settings->time,
                             .step = 1.0 / settings->fps,
                             .turntable = turntable_frames,
                             .resume = settings->resume,
                             .temporal = settings->temporal};
    if (!settings->frames.given)
        sequence.last = turntable_frames > 0 ? turntable_frames - 1 : 0;
    return sequence;
}

/* The length of a conversion as %d or %04d at the start of `text`; 0: it begins with none. */
static size_t conversion_length(const char *text)
{
    size_t length = 1;
    if (text[0] != '%')
        return 0;
    while (text[length] >= '0' && text[length] <= '9' && length < 4)
        length++;
    return text[length] == 'd' ? length + 1 : 0;
}

static uint32_t count_conversions(const char *output)
{
    uint32_t count = 0;
    for (const char *c = output; *c; c++)
        count += conversion_length(c) > 0;
    return count;
}

bool lsf_sequence_check_output(const lsf_sequence *sequence, const char *output, lsf_error *error)
{
    uint32_t count = count_conversions(output);
    if (sequence->wanted && count != 1)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--output %s: write %%d, or %%04d for leading zeros, once in place of "
                             "the frame's number, as "
                             "in -o 'frame_%%04d.png'",
                             output);
    if (!sequence->wanted && count > 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--output %s: contains %%d for a frame's number, but there are no "
                             "frames; add --frames or "
                             "--turntable",
                             output);
    if (sequence->temporal && sequence->resume)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--resume and --temporal exclude each other: a frame needs the light "
                             "of those before it, "
                             "which no file contains; leave one out");
    return sequence->wanted || (!sequence->resume && !sequence->temporal) ||
           lsf_error_set(error, LSF_ERROR_USAGE,
                         "--%s: there are no frames; add --frames or --turntable",
                         sequence->resume ? "resume" : "temporal");
}

char *lsf_sequence_path(const char *output, uint32_t frame)
{
    lsf_string path = {0};
    for (const char *c = output; *c; c++) {
        size_t length = conversion_length(c);
        if (length == 0) {
            lsf_string_add_bytes(&path, c, 1);
            continue;
        }
        lsf_string_add(&path, "%0*u", atoi(c + 1), frame);
        c += length - 1;
    }
    return path.text;
}

static void rotate(double *x, double *z, double angle)
{
    double turned = cos(angle) * *x + sin(angle) * *z;
    *z = -sin(angle) * *x + cos(angle) * *z;
    *x = turned;
}

static void rotate_direction(float direction[3], double angle)
{
    double x = (double)direction[0], z = (double)direction[2];
    rotate(&x, &z, angle);
    direction[0] = (float)x;
    direction[2] = (float)z;
}

const lsf_view *lsf_sequence_view(const lsf_sequence *sequence, const lsf_scene *scene,
                                  const lsf_view *view, uint32_t frame, lsf_view *turned)
{
    const double *center = lsf_scene_get_requirements(scene)->center;
    if (sequence->turntable == 0)
        return NULL;
    double angle = 2.0 * M_PI * frame / sequence->turntable;
    double x = view->position[0] - center[0], z = view->position[2] - center[2];
    rotate(&x, &z, angle);
    *turned = *view;
    turned->position[0] = center[0] + x;
    turned->position[2] = center[2] + z;
    rotate_direction(turned->forward, angle);
    rotate_direction(turned->up, angle);
    return turned;
}

lsf_frame lsf_sequence_frame(const lsf_sequence *sequence, uint32_t frame, uint32_t samples,
                             const lsf_view *view)
{
    return (lsf_frame){.time = sequence->start + frame * sequence->step,
                       .view = view,
                       .first_sample = frame * (samples == UINT32_MAX ? OPEN_SAMPLES : samples)};
}
