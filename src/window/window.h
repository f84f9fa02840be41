/* A window with an OpenGL 4.5 context, the user's input, and a loop of frames. It knows nothing
 * of scenes: its clients do, which draw into it and lay panels over that (ui.h). */
#ifndef LSF_WINDOW_WINDOW_H
#define LSF_WINDOW_WINDOW_H

#include <stdbool.h>
#include <stdint.h>

#include <lightsheaf/context.h>
#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_window lsf_window;

/* Keys that print something are the character in upper case: 'A', '1', ' '. The others, and all of
 * their numbers, are those of GLFW. */
typedef enum lsf_key {
    LSF_KEY_ESCAPE = 256,
    LSF_KEY_ENTER = 257,
    LSF_KEY_TAB = 258,
    LSF_KEY_BACKSPACE = 259,
    LSF_KEY_DELETE = 261,
    LSF_KEY_RIGHT = 262,
    LSF_KEY_LEFT = 263,
    LSF_KEY_DOWN = 264,
    LSF_KEY_UP = 265,
    LSF_KEY_PAGE_UP = 266,
    LSF_KEY_PAGE_DOWN = 267,
    LSF_KEY_HOME = 268,
    LSF_KEY_END = 269,
    LSF_KEY_F1 = 290, /* F2 is 291, and so on up to F12 */
    LSF_KEY_F5 = 294,
    LSF_KEY_F11 = 300,
    LSF_KEY_F12 = 301,
    LSF_KEY_PAD_0 = 320, /* the others follow up to 9 */
    LSF_KEY_PAD_ENTER = 335,
    LSF_KEY_LIMIT = 349
} lsf_key;

typedef enum lsf_button { LSF_BUTTON_LEFT, LSF_BUTTON_RIGHT, LSF_BUTTON_MIDDLE } lsf_button;
#define LSF_BUTTON_COUNT 3

enum { LSF_SHIFT = 1, LSF_CONTROL = 2, LSF_ALT = 4 };

#define LSF_KEYS_A_FRAME 16

/* The events since the frame before, and the current state of the input. Input that panels take,
 * such as a click on a button or keys while text is typed, is left out. */
typedef struct lsf_input {
    uint64_t frame;              /* from 0 */
    double time, step;           /* seconds since the start, and since the frame before */
    uint32_t width, height;      /* of the window, in pixels; at least 1 */
    float scale;                 /* of text and panels: 1 on a screen of usual density */
    double x, y, dx, dy;         /* cursor, and how far it moved; pixels from the upper left */
    double scroll;               /* notches of the wheel, away from the user */
    bool down[LSF_BUTTON_COUNT]; /* held, pressed outside of panels */
    bool pressed[LSF_BUTTON_COUNT], released[LSF_BUTTON_COUNT];
    bool double_clicked; /* left */
    uint32_t modifiers;  /* LSF_SHIFT and others, held */
    uint32_t key_count;  /* keys that went down, or repeat */
    int keys[LSF_KEYS_A_FRAME];
    bool held[LSF_KEY_LIMIT]; /* keys that are down */
    uint32_t dropped_count;   /* files dropped on the window; valid during the frame */
    const char *const *dropped;
    const char *snapshot; /* name under which a replay asks for a snapshot of this frame; NULL:
                           * it does not */
} lsf_input;

/* Whether that key was pressed, with exactly these modifiers. */
bool lsf_input_key(const lsf_input *input, int key, uint32_t modifiers);

typedef struct lsf_window_client {
    void *user;
    /* Called when OpenGL is available: at the start, and again after the context was lost. False
     * ends the window with the error. */
    bool (*open)(void *user, lsf_window *window, lsf_error *error);
    /* Destroys the objects of OpenGL that `open` and `frame` created, which may be lost already.
     * Also called after a failed `open`. */
    void (*close)(void *user);
    /* Draws one frame: of the client's own into framebuffer 0 or canvases (canvas.h), then panels
     * (ui.h), which lie over it. False ends the window with the error. */
    bool (*frame)(void *user, lsf_window *window, const lsf_input *input, lsf_error *error);
} lsf_window_client;

typedef struct lsf_window_params {
    const char *title;
    uint32_t width, height; /* screen coordinates: pixels, but where a display has two densities */
    bool full_screen;
    const char *shader_dir; /* as lsf_context_params has it */
    const char *record;     /* file for the user's actions; NULL: none */
    const char *replay;     /* file of actions that replaces the user; the window closes at its
                             * end */
    const char *coverage;   /* file for the list of keys and parts of panels that were used
                             * (reach.h) */
} lsf_window_params;

#define LSF_WINDOW_PARAMS_DEFAULTS                                                                 \
    .title = "Lightsheaf", .width = 1280, .height = 800, .full_screen = false, .shader_dir = NULL, \
    .record = NULL, .replay = NULL, .coverage = NULL

/* Opens a window and runs it until it is closed. On the main thread. LSF_ERROR_NO_GL where there is
 * no display or no OpenGL 4.5. */
bool lsf_window_run(const lsf_window_params *params, const lsf_window_client *client,
                    lsf_error *error);

/* --- functions for its client, during a call --- */

/* The window's context, wrapped; it belongs to the window, and is valid until `close`. */
lsf_context *lsf_window_context(lsf_window *window);
void lsf_window_close(lsf_window *window); /* after this frame */
void lsf_window_set_title(lsf_window *window, const char *title);
void lsf_window_toggle_full_screen(lsf_window *window);
void lsf_window_copy(lsf_window *window, const char *text); /* to the clipboard */

/* Saves the window's content at the end of this frame as PNG. lsf_window_captured tells the
 * result in the next frame. */
void lsf_window_capture(lsf_window *window, const char *path);
/* The path that was written since the last call, or NULL; `error` where that failed, code LSF_OK
 * where there was nothing to do. */
const char *lsf_window_captured(lsf_window *window, lsf_error *error);

/* Tells at the end of a frame whether the client is busy: then the next frame follows at once.
 * Else the window waits for up to `seconds` until the user does something. A replay's `settle`
 * ends when the client is not busy. */
void lsf_window_rest(lsf_window *window, bool busy, double seconds);

/* Whether input waits for the next frame: may be asked within a long iteration, also from
 * lsf_progress. It makes no call of OpenGL. */
bool lsf_window_waits(lsf_window *window);

#ifdef __cplusplus
}
#endif
#endif
