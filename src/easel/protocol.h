/* The messages between the window and the process that runs the shader: a request, then its
 * answer, one at a time, through a socket that keeps messages whole; pixels are in shared
 * memory. */
#ifndef LSF_EASEL_PROTOCOL_H
#define LSF_EASEL_PROTOCOL_H

#include <lightsheaf/lightsheaf.h>

#include "view/camera.h"

enum {
    LSF_EASEL_SOCKET = 100, /* file descriptors of the process that runs the shader */
    LSF_EASEL_PIXELS = 101,
    LSF_EASEL_UNIFORMS = 32,
    LSF_EASEL_PASSES = 16,
    LSF_EASEL_NAME = 64
};

typedef struct lsf_easel_uniform {
    char name[LSF_EASEL_NAME];
    bool integer, slider;
    uint32_t components;
    float minimum, maximum, value[4];
} lsf_easel_uniform;

typedef struct lsf_easel_request {
    uint32_t width, height;
    bool restart; /* buffers begin anew */
    bool look;    /* whether files have changed: if not, nothing is drawn */
    lsf_sandbox_frame frame;
    uint8_t keys[3][LSF_SANDBOX_KEYS];
    bool has_view;
    lsf_view view;
    float exposure;
    uint32_t uniform_count; /* those that were set, by name and value */
    lsf_easel_uniform uniforms[LSF_EASEL_UNIFORMS];
} lsf_easel_request;

typedef struct lsf_easel_answer {
    bool drawn;      /* there are pixels: 3 bytes each, rows from the top */
    uint32_t number; /* of the frame */
    double milliseconds;
    char error[LSF_ERROR_MESSAGE_SIZE]; /* "": none; otherwise the last good shader goes on */
    char renderer[128];
    bool has_camera; /* there is a scene */
    lsf_viewer_camera camera;
    uint32_t uniform_count;
    lsf_easel_uniform uniforms[LSF_EASEL_UNIFORMS];
    uint32_t pass_count;
    struct lsf_easel_pass {
        char name[32];
        float milliseconds;
    } passes[LSF_EASEL_PASSES];
} lsf_easel_answer;

#endif
