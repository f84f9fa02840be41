/* Declarations that the files of the sandbox share. */
#ifndef LSF_SANDBOX_SANDBOX_H
#define LSF_SANDBOX_SANDBOX_H

#include "sandbox/version.h"

/* The textures that a pass draws to: where it is kept, this frame's and the one's before. */
typedef struct lsf_sandbox_target {
    GLuint textures[2], framebuffers[2];
    uint32_t now; /* which of them was drawn last */
    lsf_timer *timer;
} lsf_sandbox_target;

/* A value that was set, for as long as there may be such a uniform. */
typedef struct lsf_sandbox_value {
    char *name;
    float value[4];
} lsf_sandbox_value;

#define LSF_SANDBOX_TIMERS (LSF_SANDBOX_PASSES + LSF_SANDBOX_ENGINE_TIMERS)

struct lsf_sandbox {
    lsf_context *context;
    const lsf_scene *scene;
    lsf_sandbox_params params; /* strings and lists in it are owned */
    float camera_position[3], camera_target[3];
    lsf_sandbox_version version;
    lsf_sandbox_text failed; /* text of a version that could not be made since; else empty */
    lsf_sandbox_target targets[LSF_SANDBOX_PASSES];
    GLuint keyboard, black;
    lsf_tonemap tonemap;
    lsf_sandbox_value *values;
    uint64_t value_count, value_capacity;
    lsf_pass_time times[LSF_SANDBOX_TIMERS];
};

/* Textures of the plan's passes. Those that exist already stay. */
bool lsf_sandbox_targets_create(lsf_sandbox *sandbox, lsf_error *error);
void lsf_sandbox_targets_destroy(lsf_sandbox *sandbox, bool all);
void lsf_sandbox_targets_clear(lsf_sandbox *sandbox);
/* Runs the shader's passes, once the engine's have run. */
void lsf_sandbox_draw(lsf_sandbox *sandbox, const lsf_sandbox_frame *frame);

/* Gives the uniforms that were set to the programs, which may be new. */
void lsf_sandbox_apply_values(const lsf_sandbox *sandbox);
/* Sets "name=value". */
bool lsf_sandbox_assign(lsf_sandbox *sandbox, const char *assignment, lsf_error *error);

#endif
