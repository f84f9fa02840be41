/* The sandbox in a window: the shader runs in a process of its own, so that a shader that hangs
 * or crashes its driver does not take the window with it. */
#ifndef LSF_EASEL_EASEL_H
#define LSF_EASEL_EASEL_H

#include <lightsheaf/lightsheaf.h>

#include "view/view.h"
#include "window/window.h"

/* The command line's options. */
typedef struct lsf_easel_start {
    lsf_sandbox_params sandbox;
    const char *scene_path; /* NULL: there is none */
    lsf_scene_params scene;
    lsf_context_params context; /* of the shader's process */
    float exposure;             /* EV */
    lsf_tone_curve curve;
    double watchdog; /* seconds; 0: no limit */
    lsf_window_params window;
    char *const *command; /* that runs the same program with the same arguments, which then finds
                           * LSF_EASEL_WORKER in its environment */
} lsf_easel_start;

/* Name of an environment variable that is set for the process that runs the shader. */
#define LSF_EASEL_WORKER "LIGHTSHEAF_SANDBOX_WORKER"

/* What the window's module exports as LSF_EASEL_MODULE_TABLE. */
typedef struct lsf_easel_module {
    bool (*show)(const lsf_easel_start *start, lsf_error *error);
    /* Serves the window that started this process, until that is gone. Returns the exit status. */
    int (*work)(const lsf_easel_start *start);
} lsf_easel_module;

#define LSF_EASEL_MODULE_TABLE "lsf_easel_module_table"

extern const lsf_easel_module lsf_easel_module_table __attribute__((visibility("default")));

#endif
