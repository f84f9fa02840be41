/* The viewer: scenes in a window, by the library's public functions alone. */
#ifndef LSF_VIEW_VIEW_H
#define LSF_VIEW_VIEW_H

#include <lightsheaf/lightsheaf.h>

#include "window/window.h"

/* The command line's options. */
typedef struct lsf_viewer_start {
    const char *const *paths; /* of scenes */
    uint32_t path_count;      /* 0: a page of the scenes that come with Lightsheaf */
    const char *scene_folder; /* where those lie; NULL: nowhere */
    lsf_scene_params scene;
    const char *const *edits; /* of the scene, as lsf_scene_edit takes them */
    uint32_t edit_count;
    lsf_render_params render; /* size and progress are the window's own */
    bool auto_exposure;
    float exposure; /* EV */
    lsf_tone_curve curve;
    double budget;           /* seconds of a frame while things move; 0: by the device */
    const char *frame_times; /* file that gets a line for each frame; NULL: none */
    lsf_window_params window;
} lsf_viewer_start;

typedef struct lsf_viewer_key_row {
    const char *keys, *effect;
} lsf_viewer_key_row;

/* What the module exports as LSF_WINDOW_MODULE_TABLE. */
typedef struct lsf_window_module {
    bool (*view)(const lsf_viewer_start *start, lsf_error *error);
    /* Keys and buttons of the viewer; false past the end. */
    bool (*view_key)(uint32_t index, lsf_viewer_key_row *row);
} lsf_window_module;

#define LSF_WINDOW_MODULE_NAME "lightsheaf-window"
#define LSF_WINDOW_MODULE_TABLE "lsf_window_module_table"

extern const lsf_window_module lsf_window_module_table __attribute__((visibility("default")));

#endif
