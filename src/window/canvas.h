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

/* Makes it, or makes it anew where the size is another one; then it is black. It is shown pixel by
 * pixel where it is shown at its own size, and interpolated elsewhere. */
bool lsf_canvas_resize(lsf_canvas *canvas, uint32_t width, uint32_t height, lsf_error *error);
void lsf_canvas_destroy(lsf_canvas *canvas); /* also of one that was never made */
/* 3 bytes a pixel, rows from the top. */
void lsf_canvas_write(lsf_canvas *canvas, const uint8_t *rgb);
/* The same the other way. */
void lsf_canvas_read(const lsf_canvas *canvas, uint8_t *rgb);

/* How values become visible. */
typedef enum lsf_tint {
    LSF_TINT_COLOR,    /* linear R, G, B times `scale` */
    LSF_TINT_SIGNED,   /* -1..1 of X, Y, Z times `scale` as dark to bright; nothing: black */
    LSF_TINT_DISTANCE, /* near is bright; half as bright at 1 / `scale` */
    LSF_TINT_MOTION    /* X and Y times `scale` as red and green about grey */
} lsf_tint;

/* Draws a texture of the canvas' size, GL's name, rows from the bottom. False: no shader. */
bool lsf_canvas_tint(lsf_canvas *canvas, uint32_t texture, lsf_tint tint, float scale);
void lsf_canvas_close_tints(void); /* before the context goes */

#ifdef __cplusplus
}
#endif
#endif
