/* The user's actions, one at a time, and their text: the lines of --record. */
#ifndef LSF_WINDOW_EVENT_H
#define LSF_WINDOW_EVENT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include <lightsheaf/error.h>

typedef enum lsf_event_kind {
    LSF_EVENT_KEY_DOWN, /* code: the key */
    LSF_EVENT_KEY_UP,
    LSF_EVENT_TEXT,        /* code: a Unicode character */
    LSF_EVENT_MOVE,        /* x, y: pixels from the upper left */
    LSF_EVENT_BUTTON_DOWN, /* code: an lsf_button */
    LSF_EVENT_BUTTON_UP,
    LSF_EVENT_SCROLL, /* y: notches */
    LSF_EVENT_DROP,   /* text: a path */
    LSF_EVENT_SIZE,   /* x, y: size of the window */
    LSF_EVENT_STEP,   /* x: seconds since the frame before */
    LSF_EVENT_CLOSE,
    /* Events of replays alone, written by hand. */
    LSF_EVENT_PRESS,    /* text: the label of a button, a menu or the like, which is clicked */
    LSF_EVENT_DRAG,     /* text: the label of what is dragged by x, y */
    LSF_EVENT_SET,      /* text: label = value, of a slider or a choice */
    LSF_EVENT_SETTLE,   /* the events that follow wait until the client is idle */
    LSF_EVENT_SNAPSHOT, /* text: a name, under which the client saves what it shows */
    LSF_EVENT_MINIMISE,
    LSF_EVENT_LOSE, /* the context is treated as lost */
    LSF_EVENT_COUNT
} lsf_event_kind;

typedef struct lsf_event {
    lsf_event_kind kind;
    int code;
    double x, y;
    const char *text; /* the queue's, or the replay's */
} lsf_event;

/* Writes the line of an event in a frame. */
void lsf_event_write(FILE *file, uint64_t frame, const lsf_event *event);

/* A file of such lines, read at once. */
typedef struct lsf_replay {
    char *content;
    struct lsf_replay_line {
        uint64_t frame;
        lsf_event event;
    } * lines;
    uint64_t count, capacity, next;
} lsf_replay;

/* LSF_ERROR_FILE names the line that is wrong. Finish it in either case. */
bool lsf_replay_load(lsf_replay *replay, const char *path, lsf_error *error);
/* The next event of that frame, or of one before; NULL: none. */
const lsf_event *lsf_replay_take(lsf_replay *replay, uint64_t frame);
bool lsf_replay_ended(const lsf_replay *replay);
void lsf_replay_finish(lsf_replay *replay);

/* "Enter", "F12", "A"; NULL where a key has no name here. */
const char *lsf_key_name(int key);

#endif
