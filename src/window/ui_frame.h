/* What the window does with the panels: of ui.cpp, for window.c. */
#ifndef LSF_WINDOW_UI_FRAME_H
#define LSF_WINDOW_UI_FRAME_H

#include <stdbool.h>
#include <stdint.h>

#include "window/event.h"
#include "window/window.h"

#ifdef __cplusplus
extern "C" {
#endif

/* With the context current. False: no memory, or its shaders do not compile. */
bool lsf_ui_open(float scale);
void lsf_ui_close(void);

/* Text as dense as the screen. */
void lsf_ui_set_scale(float scale);

/* Begins a frame with what the user has done; sets whether panels take cursor and keyboard. */
void lsf_ui_begin(const lsf_input *input, const bool buttons[LSF_BUTTON_COUNT], double scroll,
                  const uint32_t *characters, uint32_t character_count);
bool lsf_ui_takes_cursor(void);
bool lsf_ui_takes_keys(void);
/* Draws the panels over framebuffer 0. */
void lsf_ui_end(void);

/* The shape of the cursor that a panel wants: 0 arrow, 1 text, 2 and 3 resizing across and down,
 * 4 hand. */
int lsf_ui_cursor(void);

/* For a replay: the middle of what has that label, as shown in the last frame. Of several the
 * first. */
bool lsf_ui_find(const char *label, double *x, double *y);
/* "label = value": the thing of that label takes the value when it is shown next. */
void lsf_ui_assign(const char *assignment);
/* Whether it has been taken. */
bool lsf_ui_assigned(void);

#ifdef __cplusplus
}
#endif
#endif
