#include "tools/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "tools/measure_reference.h"
#include "tools/sequence.h"

enum { FRAMES = 8 }; /* of a turn, where none are given */

/* Frames that are asked for; 0: none. */
static uint32_t first_and_count(const lsf_sequence *sequence, const lsf_settings *settings,
                                uint32_t *first)
{
    uint32_t count = sequence->last - sequence->first + 1;
    *first = sequence->first;
    if (!sequence->wanted)
        return 0;
    return settings->frames.given || count < FRAMES ? count : FRAMES;
}

/* The view of a frame, by parameters that the path tracer takes as well. */
static bool prepare_frame(lsf_measure_job *job, const lsf_sequence *sequence,
                          const lsf_view *camera, uint32_t number, uint32_t index, lsf_error *error)
{
    lsf_path_frame *frame = &job->frames[index];
    lsf_kept_reference *kept = &job->frame_references[index];
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    lsf_view turned;
    float position[3], target[3];
    char key[33] = "";
    const lsf_view *view = lsf_sequence_view(sequence, job->scene, camera, number, &turned);
    const double *center = lsf_scene_get_requirements(job->scene)->center;
    params.time = sequence->start + number * sequence->step;
    if (view) {
        double distance = 0.0, length = 0.0;
        for (int axis = 0; axis < 3; axis++) {
            double offset = center[axis] - view->position[axis];
            distance += offset * offset;
            length += (double)view->forward[axis] * (double)view->forward[axis];
        }
        for (int axis = 0; axis < 3; axis++) {
            position[axis] = (float)view->position[axis];
            target[axis] = (float)(view->position[axis] +
                                   sqrt(distance / length) * (double)view->forward[axis]);
        }
        params.camera_position = position;
        params.camera_target = target;
    }
    frame->time = params.time;
    if (!lsf_render_params_view(job->scene, &params, &frame->view, error) ||
        !lsf_measure_trace(&job->settings, job->scene, &params, kept, key, error))
        return false;
    frame->halves[0] = kept->halves[0];
    frame->halves[1] = kept->halves[1];
    lsf_string_add(&job->path_key, " %s %u", key, (unsigned)kept->samples[0]);
    return true;
}

bool lsf_measure_begin_path(lsf_measure_job *job, lsf_error *error)
{
    const lsf_sequence sequence = lsf_sequence_of(&job->settings);
    lsf_render_params params = lsf_settings_render_params(&job->settings);
    lsf_view camera;
    uint32_t first, count = first_and_count(&sequence, &job->settings, &first);
    if (count == 0)
        return true;
    job->frames = lsf_alloc(count, sizeof *job->frames);
    job->frame_references = lsf_alloc(count, sizeof *job->frame_references);
    job->frame_count = count;
    bool good = (job->frames && job->frame_references) ||
                lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && lsf_render_params_view(job->scene, &params, &camera, error);
    lsf_string_add(&job->path_key, "\npath%s", job->settings.temporal ? " temporal" : "");
    for (uint32_t i = 0; good && i < count; i++)
        good = prepare_frame(job, &sequence, &camera, first + i, i, error);
    return good;
}

void lsf_measure_end_path(lsf_measure_job *job)
{
    for (uint32_t i = 0; job->frame_references && i < job->frame_count; i++)
        lsf_kept_reference_finish(&job->frame_references[i]);
    free(job->frame_references);
    free(job->frames);
    free(job->path_key.text);
}
