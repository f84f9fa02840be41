/* The functions of ui.cpp by which window.c runs the panels. */
#ifndef LSF_WINDOW_UI_FRAME_H
#define LSF_WINDOW_UI_FRAME_H

#include <stdbool.h>
#include <stdint.h>

#include "window/event.h"
#include "window/window.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Starts Dear ImGui; the context is current. False: no memory, or its shaders do not compile. */
bool lsf_ui_open(float scale);
void lsf_ui_close(void);

/* Sets the density of the text to the screen's. */
void lsf_ui_set_scale(float scale);

/* Begins a frame with the user's input; sets whether panels take cursor and keyboard. */
void lsf_ui_begin(const lsf_input *input, const bool buttons[LSF_BUTTON_COUNT], double scroll,
                  const uint32_t *characters, uint32_t character_count);
bool lsf_ui_takes_cursor(void);
bool lsf_ui_takes_keys(void);
/* Draws the panels over framebuffer 0. */
void lsf_ui_end(void);

/* The shape of the cursor that a panel wants: 0 arrow, 1 text, 2 and 3 resizing across and down,
 * 4 hand. */
int lsf_ui_cursor(void);

/* For a replay: the middle of the item with that label, as shown in the last frame; the first of
 * several. */
bool lsf_ui_find(const char *label, double *x, double *y);
/* "label = value": the item of that label takes the value when it is shown next. */
void lsf_ui_assign(const char *assignment);
/* Whether the value was taken. */
bool lsf_ui_assigned(void);

#ifdef __cplusplus
}
#endif
#endif
