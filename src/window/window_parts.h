/* What the files of the window share. */
#ifndef LSF_WINDOW_WINDOW_PARTS_H
#define LSF_WINDOW_WINDOW_PARTS_H

#include <stdio.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "window/event.h"
#include "window/window.h"

#define LSF_EVENTS_A_FRAME 256
#define LSF_DROPPED_A_FRAME 64
#define LSF_CHARACTERS_A_FRAME 32

/* Clicks on a labelled thing take three frames: there, down, up; drags go on before they let go. */
typedef enum lsf_press {
    LSF_PRESS_NONE,
    LSF_PRESS_MOVE,
    LSF_PRESS_DOWN,
    LSF_PRESS_DRAG,
    LSF_PRESS_UP
} lsf_press;

struct lsf_window {
    const lsf_window_params *params;
    const lsf_window_client *client;
    GLFWwindow *handle;
    lsf_context *context;
    bool lost, closing, failed;
    lsf_error *error; /* of lsf_window_run, for what fails in a callback */

    lsf_event events[LSF_EVENTS_A_FRAME]; /* that wait for the next frame */
    uint32_t event_count;
    lsf_input input;
    const char *dropped[LSF_DROPPED_A_FRAME];
    char *dropped_copies[LSF_DROPPED_A_FRAME]; /* of a user's files */
    uint32_t dropped_copy_count;
    bool button[LSF_BUTTON_COUNT]; /* as the device says, of panels as well */
    bool just_pressed[LSF_BUTTON_COUNT];
    double wheel;
    uint32_t characters[LSF_CHARACTERS_A_FRAME], character_count;
    double clicked_at, clicked_x, clicked_y; /* the last left click */

    FILE *record;
    bool replaying;
    lsf_replay replay;
    uint64_t
        script_frame; /* of the replay: it stands still while a click or the client takes time */
    lsf_press press;
    const lsf_event *pressed; /* or set */
    bool settling;
    uint32_t patience; /* frames that a label has been looked for */

    bool busy;
    double rest;    /* seconds that the next frame may wait */
    uint32_t awake; /* frames that panels still need to follow what happened */
    double start, before;
    int restored[4]; /* place and size outside of full screen */
    char *capture, *captured;
    lsf_error capture_error;
};

/* --- input.c --- */

void lsf_window_listen(lsf_window *window); /* installs GLFW's callbacks */
void lsf_window_push(lsf_window *window, lsf_event event);
/* Turns what waits, or the replay's next frame, into window->input. False: a replay cannot go on.
 */
bool lsf_window_take_input(lsf_window *window, lsf_error *error);
/* Leaves out what panels have taken; between lsf_ui_begin and the client's frame. */
void lsf_window_hide_taken(lsf_window *window);

#endif
