/* Declarations that the files of the sandbox's window share. */
#ifndef LSF_EASEL_APP_H
#define LSF_EASEL_APP_H

#include "easel/process.h"
#include "window/canvas.h"
#include "window/ui.h"

#include <time.h>

typedef struct lsf_easel {
    const lsf_easel_start *start;
    lsf_window *window;
    const lsf_input *input;
    lsf_easel_process process;
    lsf_easel_request request; /* sent last, and what the next one goes on from */
    lsf_easel_answer answer;   /* that came last */
    lsf_canvas canvas;
    uint32_t canvas_frames; /* pictures that were shown */
    struct timespec stamp;  /* of the shader's file, when its process was started */

    /* The clock of the shader. */
    bool playing, step; /* step: one frame more */
    bool restart;
    double time, time_of_last;
    uint32_t number; /* of the next frame */
    bool dirty;      /* the picture is out of date */

    bool set[LSF_EASEL_UNIFORMS]; /* which uniforms the user has set since the last request */
    lsf_viewer_camera camera;
    bool has_camera;
    float mouse[4];
    bool was_down;
    uint8_t keys[3][LSF_SANDBOX_KEYS];
    float exposure;
    int reduction; /* window pixels along the side of one of the picture's */

    char trouble[LSF_ERROR_MESSAGE_SIZE]; /* of the process, or of a file that was to be written */
    char said[LSF_ERROR_MESSAGE_SIZE];    /* the message printed to stderr last */
    bool panels;
    double frame_seconds; /* smoothed, from one picture to the next */
    double shown_at, looked_at;
    uint32_t shots;
} lsf_easel;

/* Keys, mouse and camera. */
void lsf_easel_handle(lsf_easel *easel);
void lsf_easel_list_keys(void); /* for what covers them (window/reach.h) */
void lsf_easel_restart(lsf_easel *easel);
void lsf_easel_show_panels(lsf_easel *easel);

#endif
