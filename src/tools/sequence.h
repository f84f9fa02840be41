/* The frames of a sequence: their numbers, times and views, and the pictures they go to. */
#ifndef LSF_TOOLS_SEQUENCE_H
#define LSF_TOOLS_SEQUENCE_H

#include "tools/options.h"

typedef struct lsf_sequence {
    bool wanted; /* else there is one picture, and nothing below counts */
    uint32_t first, last;
    double start, step; /* seconds: the time of frame 0, and from one to the next */
    uint32_t turntable; /* frames of a turn; 0: the camera is the scene's */
    bool resume;
    bool temporal;
} lsf_sequence;

lsf_sequence lsf_sequence_of(const lsf_settings *settings);

/* Whether the output has a conversion for a frame's number exactly once; and none where no
 * sequence is wanted. LSF_ERROR_USAGE. */
bool lsf_sequence_check_output(const lsf_sequence *sequence, const char *output, lsf_error *error);

/* The output's path with the frame's number in it. malloc'ed; NULL without memory. */
char *lsf_sequence_path(const char *output, uint32_t frame);

/* Where a turntable is wanted, turns `view`, the camera's of frame 0, to that of another, about the
 * vertical axis through the scene's centre; else the camera is the scene's own at that time, and
 * the result is NULL. `turned` has room for it. */
const lsf_view *lsf_sequence_view(const lsf_sequence *sequence, const lsf_scene *scene,
                                  const lsf_view *view, uint32_t frame, lsf_view *turned);

/* The frame as a renderer takes it. Its random numbers follow those of the frame before. */
lsf_frame lsf_sequence_frame(const lsf_sequence *sequence, uint32_t frame, uint32_t samples,
                             const lsf_view *view);

#endif
