/* An 8-bit picture on the GPU that a client draws into and ui.h shows; rows from the bottom. */
#ifndef LSF_WINDOW_CANVAS_H
#define LSF_WINDOW_CANVAS_H

#include <stdbool.h>
#include <stdint.h>

#include <lightsheaf/error.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_canvas {
    uint32_t texture, framebuffer; /* GL names; 0: not made yet */
    uint32_t width, height;
} lsf_canvas;

/* Creates it, or creates it anew where the size differs; then it is black. It is shown pixel by
 * pixel at its own size, and interpolated at others. */
bool lsf_canvas_resize(lsf_canvas *canvas, uint32_t width, uint32_t height, lsf_error *error);
void lsf_canvas_destroy(lsf_canvas *canvas); /* also of one that was never made */
/* 3 bytes a pixel, rows from the top. */
void lsf_canvas_write(lsf_canvas *canvas, const uint8_t *rgb);
/* Reads the pixels back in the same layout. */
void lsf_canvas_read(const lsf_canvas *canvas, uint8_t *rgb);

/* How values are mapped to colours. */
typedef enum lsf_tint {
    LSF_TINT_COLOR,    /* linear R, G, B times `scale` */
    LSF_TINT_SIGNED,   /* -1..1 of X, Y, Z times `scale` from dark to bright; black where there
                        * is no surface */
    LSF_TINT_DISTANCE, /* near is bright; half as bright at 1 / `scale` */
    LSF_TINT_MOTION    /* X and Y times `scale` as red and green about grey */
} lsf_tint;

/* Draws a texture of the canvas' size, a GL name, rows from the bottom. False: the shader does
 * not compile. */
bool lsf_canvas_tint(lsf_canvas *canvas, uint32_t texture, lsf_tint tint, float scale);
void lsf_canvas_close_tints(void); /* before the context is destroyed */

#ifdef __cplusplus
}
#endif
#endif
