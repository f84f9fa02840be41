/* Declarations that the files of the window share. */
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

/* Clicks on a labelled thing take three frames: move, press, release; drags move before the
 * release. */
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
    lsf_error *error; /* error of lsf_window_run, for failures in a callback */

    lsf_event events[LSF_EVENTS_A_FRAME]; /* events that wait for the next frame */
    uint32_t event_count;
    lsf_input input;
    const char *dropped[LSF_DROPPED_A_FRAME];
    char *dropped_copies[LSF_DROPPED_A_FRAME]; /* of a user's files */
    uint32_t dropped_copy_count;
    bool button[LSF_BUTTON_COUNT]; /* as the device reports, including those over panels */
    bool just_pressed[LSF_BUTTON_COUNT];
    double wheel;
    uint32_t characters[LSF_CHARACTERS_A_FRAME], character_count;
    double clicked_at, clicked_x, clicked_y; /* the last left click */

    FILE *record;
    bool replaying;
    lsf_replay replay;
    uint64_t script_frame; /* frame number of the replay: it stands still while a click or the
                            * client takes time */
    lsf_press press;
    const lsf_event *pressed; /* or set */
    bool settling;
    uint32_t patience; /* frames for which a label has been looked for */

    bool busy;
    double rest;    /* seconds that the next frame may wait */
    uint32_t awake; /* frames that panels still need to react to the input */
    double start, before;
    int restored[4]; /* position and size outside of full screen */
    char *capture, *captured;
    lsf_error capture_error;
};

/* --- input.c --- */

void lsf_window_listen(lsf_window *window); /* installs GLFW's callbacks */
void lsf_window_push(lsf_window *window, lsf_event event);
/* Turns the waiting events, or the replay's next frame, into window->input. False: the replay
 * cannot go on. */
bool lsf_window_take_input(lsf_window *window, lsf_error *error);
/* Removes the input that panels have taken; called between lsf_ui_begin and the client's frame. */
void lsf_window_hide_taken(lsf_window *window);

#endif
