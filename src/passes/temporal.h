/* Light of earlier frames, carried along with the surfaces that it fell on and blended with a
 * frame's own. See temporal.md. */
#ifndef LSF_PASSES_TEMPORAL_H
#define LSF_PASSES_TEMPORAL_H

#include "frame/iteration.h"
#include "frame/maps.h"
#include "plan/option.h"

typedef struct lsf_temporal_params {
    int32_t frames;          /* most frames that light of earlier frames counts for */
    int32_t lag;             /* frames after which 1 % is left of lights that were changed */
    int32_t denoised_frames; /* most frames that denoised light of earlier frames counts for */
} lsf_temporal_params;

#define LSF_TEMPORAL_PARAMS_DEFAULTS .frames = 32, .lag = 8, .denoised_frames = 0

#define LSF_TEMPORAL_OPTION_COUNT 3
extern const lsf_option_row lsf_temporal_options[LSF_TEMPORAL_OPTION_COUNT];

/* Mean light and what it is multiplied by, as lsf_light_mean_part. */
typedef struct lsf_temporal_light {
    GLuint light, factor; /* 0: there is no such part */
} lsf_temporal_light;

typedef struct lsf_temporal_inputs {
    lsf_guide_maps guide;
    GLuint motion;               /* of lsf_gbuffer_maps, with depth and instance */
    GLuint picture;              /* RGBA32F mean of the whole picture */
    lsf_temporal_light parts[2]; /* diffuse, specular */
} lsf_temporal_inputs;

/* How a frame differs from the one before. */
typedef struct lsf_temporal_change {
    bool cut;    /* nothing is kept of earlier frames */
    bool moved;  /* something other than the camera */
    bool lights; /* lights or materials have changed */
} lsf_temporal_change;

typedef struct lsf_temporal_part {
    GLuint history; /* RGBA32F: light without tint; A: sum of squared deviations */
    GLuint count;   /* R32F: samples that it stands for */
    GLuint carried; /* RGBA32F: the history of the frame before, where it is now */
    GLuint light;   /* RGBA32F, output: with it, as lsf_light_mean_part of `iterations` */
    GLuint window;  /* RGBA32F: how far neighbours are from it */
    /* 0 where no network denoises: */
    GLuint denoised;         /* RGBA32F, output: with that of the frames before; A as it came */
    GLuint denoised_carried; /* RGBA32F: that of the frame before, where it is now; A: samples */
} lsf_temporal_part;

typedef struct lsf_temporal {
    lsf_context *context;
    lsf_temporal_params params;
    lsf_temporal_part parts[2];       /* diffuse, specular; specular 0 where nothing is glossy */
    GLuint guide;                     /* RGBA32UI: normal, depth and instance of the history */
    GLuint compared;                  /* RGBA32F: the frame's light with its history */
    GLuint reach;                     /* RGBA32F: samples that are carried, and drift of lobes */
    GLuint picture;                   /* RGBA32F, output: with light of the frames before */
    GLuint denoised_count;            /* RG32F: samples of both parts' denoised light */
    GLuint carried_picture, resolved; /* RGBA32F: that of the frame before; output of resolve */
    GLuint carry_framebuffer, compare_framebuffer, window_framebuffer, blend_framebuffer,
        picture_framebuffer, denoised_framebuffer, resolve_framebuffer;
    GLuint carry_program, compare_program, window_program, blend_program, picture_program,
        denoised_program, resolve_program;
    float independent;       /* neighbours whose noise differs, at most */
    lsf_camera_state camera; /* of the history, and of the frame in progress */
    lsf_camera_state next_camera;
    bool kept;              /* there is a history */
    float samples, carried; /* most samples that it stands for, now and in the frame before */
    uint32_t frames_since_lights, frames_since_change; /* 0: the frame in progress */
    uint32_t still_frames;                             /* frames that the mean has gone on for */
    lsf_timer *timer;
} lsf_temporal;

/* `denoised`: a network denoises light, which is blended as well. */
void lsf_temporal_plan(lsf_plan *plan, const lsf_temporal_params *params, bool denoised);
/* `independent`: pixels next to each other that have samples of their own; 0: all. */
bool lsf_temporal_create(lsf_temporal *pass, lsf_context *context, const lsf_plan *plan,
                         const lsf_temporal_params *params, uint32_t independent, lsf_error *error);
/* Goes over to another frame, of so many iterations (UINT32_MAX: that is open). Returns the samples
 * that the history will stand for in it, at most. */
float lsf_temporal_begin(lsf_temporal *pass, const lsf_temporal_change *change, uint32_t iterations,
                         const lsf_camera_state *camera);
/* Goes over to a frame in which nothing has changed: the mean goes on. */
void lsf_temporal_go_on(lsf_temporal *pass);
/* Carries the history to the current positions; to be called after a frame's first iteration. */
void lsf_temporal_carry(lsf_temporal *pass, const lsf_iteration *iteration,
                        const lsf_temporal_inputs *inputs);
/* Blends it with the mean of the frame's `iterations`, which becomes the history of the next one.
 */
void lsf_temporal_blend(lsf_temporal *pass, const lsf_iteration *iteration, uint32_t iterations,
                        const lsf_temporal_inputs *inputs);
/* Blends the denoised light of both parts with that of the frames before, where that is planned:
 * parts[].denoised. */
void lsf_temporal_blend_denoised(lsf_temporal *pass, const lsf_plan *plan, uint32_t iterations,
                                 const GLuint denoised[2]);
/* Blends the picture that was made of it with those of the frames before, in `resolved`. */
void lsf_temporal_resolve(lsf_temporal *pass, const lsf_plan *plan, uint32_t iterations,
                          GLuint picture);
void lsf_temporal_destroy(lsf_temporal *pass);

#endif
