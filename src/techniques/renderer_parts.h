/* Declarations that the files of the renderer share. */
#ifndef LSF_TECHNIQUES_RENDERER_PARTS_H
#define LSF_TECHNIQUES_RENDERER_PARTS_H

#include "passes/accumulate.h"
#include "passes/tonemap.h"
#include "techniques/setup.h"

#define LSF_RENDERER_MAX_PASSES (LSF_TECHNIQUE_MAX_PASSES + 7)

/* Compilation at the first uses of shaders, which drivers put off when they link. Software OpenGL
 * compiles on the thread that calls it, and draws on others. So what the calling thread computes in
 * the first iterations of a run beyond the least of them is compilation; after one, it is all that
 * it has computed, at most. */
typedef struct lsf_first_uses {
    uint32_t iterations;
    double sum, least; /* processor seconds of the calling thread in these iterations */
    double allowed;    /* seconds by which the deadline was put off for it */
} lsf_first_uses;

struct lsf_renderer {
    lsf_context *context;
    lsf_setup setup;
    lsf_scene_gpu scene;
    lsf_iteration iteration;
    void *technique;
    lsf_technique_outputs outputs;
    lsf_accumulate accumulate;
    lsf_light_mean light_mean; /* this and the next four are empty unless the plan has them */
    lsf_light_guide light_guide;
    lsf_temporal temporal;
    lsf_light_filter light_filter;
    lsf_denoise denoise;
    bool finished; /* their picture is made of the current mean */
    lsf_tonemap tonemap;
    bool broken; /* no frame is in progress: going over to another plan has failed */
    bool grain_checked;
    uint32_t samples; /* iterations of the mean that were asked for so far */
    uint32_t kept;    /* iterations of earlier frames, where the mean goes on */
    bool begun;       /* random numbers were taken since the last cut */
    bool unchanged;   /* the frame before was equal to its own predecessor */
    uint32_t next; /* iteration of the mean to run next: fewer, where some have to be run again */
    uint64_t iterations;            /* asked for in all frames, since the passes were made */
    double deadline, next_question; /* in seconds as lsf_now counts them */
    double grace;                   /* seconds after the deadline in which an iteration may end */
    bool stopped;                   /* the iteration in progress is to be dropped */
    lsf_first_uses first_uses;      /* in the run in progress */
    double compile_seconds, upload_seconds, render_seconds;
    lsf_pass_stats pass_stats[LSF_RENDERER_MAX_PASSES];
    lsf_pass_time pass_times[LSF_RENDERER_MAX_PASSES];
};

/* Makes what depends on the plan but for the scene on the GPU; and ends it, also after a failure,
 * or where there is none. */
bool lsf_renderer_create_technique(lsf_renderer *renderer, lsf_error *error);
void lsf_renderer_destroy_technique(lsf_renderer *renderer);
void lsf_renderer_log_remarks(const lsf_plan *plan);
/* lsf_context_enter for a function that needs a frame. */
lsf_context *lsf_renderer_enter(lsf_renderer *renderer, lsf_error *error);
/* Runs until all iterations asked for are in the means; without `wait`, as far as is known. */
bool lsf_renderer_catch_up(lsf_renderer *renderer, bool wait, lsf_error *error);
/* The mean of the picture, with light of the frames before and filtered where the plan says so. Of
 * a renderer that has caught up. */
GLuint lsf_renderer_picture(lsf_renderer *renderer);
/* The texture of a layer; 0 when the technique has none, and the layer stays black. */
GLuint lsf_renderer_layer(const lsf_technique_outputs *outputs, uint32_t aov);

#endif
