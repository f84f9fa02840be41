/* A recurrent autoencoder that goes on from what light_filter has filtered. See denoise.md. */
#ifndef LSF_PASSES_DENOISE_H
#define LSF_PASSES_DENOISE_H

#include "denoiser/module.h"
#include "denoiser/net.h"
#include "frame/iteration.h"
#include "plan/option.h"

/* What runs the network. */
typedef enum lsf_denoise_processor {
    LSF_DENOISE_AUTO, /* the CPU where OpenGL is software and the module is there, else OpenGL */
    LSF_DENOISE_GL,
    LSF_DENOISE_CPU,
} lsf_denoise_processor;

typedef struct lsf_denoise_params {
    int32_t processor; /* lsf_denoise_processor */
} lsf_denoise_params;

#define LSF_DENOISE_PARAMS_DEFAULTS .processor = LSF_DENOISE_AUTO

#define LSF_DENOISE_OPTION_COUNT 1
extern const lsf_option_row lsf_denoise_options[LSF_DENOISE_OPTION_COUNT];

/* RGBA32F; the second of each pair is specular, 0 where materials have no lobes. */
typedef struct lsf_denoise_inputs {
    GLuint mean;            /* lsf_light_mean.guide */
    GLuint specular_factor; /* as lsf_light_mean_part; A: roughness */
    GLuint light[2];        /* without tint; A: variance, below 0: it tells nothing */
    GLuint filtered[2];     /* the same after light_filter's steps */
    GLuint factors[2];      /* what it is multiplied by to be light in the picture */
} lsf_denoise_inputs;

/* A feature map, by where its bytes are. */
typedef struct lsf_denoise_map {
    GLuint buffer;
    uint64_t offset, bytes;
} lsf_denoise_map;

typedef struct lsf_denoise_layout lsf_denoise_layout;

typedef struct lsf_denoise {
    lsf_context *context;
    const lsf_net *net; /* NULL: what would go into one is recorded */
    GLuint light[2];    /* output: RGBA32F, as filtered */
    GLuint exchange;    /* what goes into the network, then what comes out of it */
    GLuint features, states[2], weights, partial, total; /* buffers */
    GLuint scale, total_program, input, convolve, twice, apply, gain;
    lsf_denoise_layout *layout; /* NULL where the CPU runs it */
    const lsf_denoiser_module *module;
    void *processor;                 /* of the module */
    float *host_input, *host_output; /* the same */
    uint32_t width, height;          /* padded */
    bool recurrent, kept, fresh;     /* state is kept at all; of a frame before; of this one */
    lsf_timer *timer;
} lsf_denoise;

/* `net` NULL: there is none, and what it would get is recorded. */
void lsf_denoise_plan(lsf_plan *plan, const lsf_net *net);
/* Where the CPU runs the network, the plan is rid of what OpenGL would need for it. */
bool lsf_denoise_create(lsf_denoise *pass, lsf_context *context, lsf_plan *plan,
                        const lsf_denoise_params *params, const lsf_net *net, lsf_error *error);
/* Goes over to another frame; with `cut` nothing of those before is kept. */
void lsf_denoise_begin(lsf_denoise *pass, bool cut);
void lsf_denoise_run(lsf_denoise *pass, const lsf_iteration *iteration,
                     const lsf_denoise_inputs *inputs);
void lsf_denoise_destroy(lsf_denoise *pass);

/* Where LIGHTSHEAF_DENOISER_RECORD has what goes into the network written; NULL: nowhere. */
const char *lsf_denoise_record_path(void);

#endif
