/* Panels over the picture, built anew in each frame, for clients in C. A function that shows a
 * value returns whether the user has just changed it. A label is the text that is shown, and
 * names the thing for a replay; a part behind ## tells equal labels apart and is not shown.
 * Lengths are in pixels of the window, from its upper left; sizes named "lines" grow with the
 * text. */
#ifndef LSF_WINDOW_UI_H
#define LSF_WINDOW_UI_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_rect {
    float x, y, width, height;
} lsf_rect;

typedef enum lsf_ui_color {
    LSF_UI_TEXT,
    LSF_UI_DIM,
    LSF_UI_ACCENT,
    LSF_UI_WARNING,
    LSF_UI_ERROR,
    LSF_UI_BACKGROUND, /* of panels */
    LSF_UI_RED,        /* of axes */
    LSF_UI_GREEN,
    LSF_UI_BLUE,
    LSF_UI_COLOR_COUNT
} lsf_ui_color;

/* --- measures --- */

float lsf_ui_em(void);   /* height of the text, the unit of `lines` */
float lsf_ui_line(void); /* height of a line of widgets with the gap below it */
float lsf_ui_text_width(const char *text);

/* --- panels --- */

/* A fixed panel; to be ended in any case. `scrolls`: it has a scroll bar where its content does
 * not fit. */
void lsf_ui_panel_begin(const char *name, lsf_rect rect, bool scrolls);
void lsf_ui_panel_end(void);
/* A dialogue in the middle of the window, in front of everything; to be ended in any case. */
void lsf_ui_dialogue_begin(const char *title, float width_lines);
void lsf_ui_dialogue_end(void);

/* The menu bar along the upper edge; its height is lsf_ui_menu_height(). Only what began is to
 * be ended. */
bool lsf_ui_menu_bar_begin(void);
void lsf_ui_menu_bar_end(void);
float lsf_ui_menu_height(void);
bool lsf_ui_menu_begin(const char *label);
void lsf_ui_menu_end(void);
/* `shortcut` NULL: none; `help` NULL: none. */
bool lsf_ui_menu_item(const char *label, const char *shortcut, bool checked, const char *help);

/* Tabs: end the bar; a tab's content follows where it returns true, and so does its end. `choose`
 * brings it to the front. */
void lsf_ui_tabs_begin(const char *name);
void lsf_ui_tabs_end(void);
bool lsf_ui_tab_begin(const char *label, bool choose);
void lsf_ui_tab_end(void);
/* A heading that folds; true where open. */
bool lsf_ui_section(const char *label, bool open_at_first);

/* --- text --- */

void lsf_ui_text(lsf_ui_color color, const char *format, ...) __attribute__((format(printf, 2, 3)));
void lsf_ui_text_wrapped(lsf_ui_color color, const char *text);
/* A long text in monospace that scrolls both ways; height in lines. */
void lsf_ui_listing(const char *name, const char *text, float lines);
void lsf_ui_help(const char *text); /* shown for the item before, while the cursor rests on it */
void lsf_ui_same_line(void);
void lsf_ui_at(float x_lines); /* continues on this line, at so many lines' heights from the left */
void lsf_ui_gap(void);
void lsf_ui_rule(void);
/* Places the labels of the items that follow to the left, in a column so many lines' heights
 * wide; 0: behind the items. */
void lsf_ui_labels(float lines);

/* --- values --- */

bool lsf_ui_button(const char *label);
bool lsf_ui_check(const char *label, bool *value);
bool lsf_ui_slider(const char *label, float *value, float low, float high, const char *format,
                   bool logarithmic);
/* `format` NULL: the number. */
bool lsf_ui_slider_int(const char *label, int *value, int low, int high, const char *format,
                       bool logarithmic);
/* One to four numbers that are dragged, `speed` a pixel. */
bool lsf_ui_drag(const char *label, float *values, int count, float speed, float low, float high,
                 const char *format);
/* Linear radiance or reflectance, 0..1, shown as sRGB. */
bool lsf_ui_color3(const char *label, float rgb[3]);
/* One of `count` names. */
bool lsf_ui_choice(const char *label, int *value, const char *const *names, int count);
/* A line in a list or a tree, indented by `depth` levels. True when clicked. `dim`: drawn less
 * prominently. */
bool lsf_ui_row(const char *label, int depth, bool chosen, bool dim);
/* A part of the panel with a scroll bar of its own; to be ended in any case. Height in lines; 0:
 * the rest. */
void lsf_ui_list_begin(const char *name, float lines);
void lsf_ui_list_end(void);
/* Items within are greyed out and cannot be used. */
void lsf_ui_disable_begin(bool disabled);
void lsf_ui_disable_end(void);
/* Tells equal labels within apart. */
void lsf_ui_scope_begin(int number);
void lsf_ui_scope_end(void);

/* --- drawing --- */

/* Leaves the next item of the panel free for drawing, `lines` high, and returns its
 * rectangle. */
lsf_rect lsf_ui_area(float lines);
/* Names a rectangle that is drawn by hand, for a replay to press or drag; `held`: it is being
 * dragged. */
void lsf_ui_mark(const char *label, float x, float y, bool held);

typedef enum lsf_layer_place {
    LSF_UNDER_PANELS, /* over the client's own drawing */
    LSF_IN_PANEL,     /* over the current panel */
    LSF_OVER_PANELS
} lsf_layer_place;

/* Selects where draws go from now on, clipped to `clip`; NULL: to the window. */
void lsf_ui_draw_begin(lsf_layer_place place, const lsf_rect *clip);
void lsf_ui_draw_end(void);
/* `rgba`: 0xrrggbbaa. */
uint32_t lsf_ui_rgba(lsf_ui_color color);
void lsf_ui_draw_rect(lsf_rect rect, uint32_t rgba, bool filled, float rounding);
void lsf_ui_draw_line(float x0, float y0, float x1, float y1, uint32_t rgba, float width);
void lsf_ui_draw_circle(float x, float y, float radius, uint32_t rgba, bool filled);
void lsf_ui_draw_triangle(const float xy[6], uint32_t rgba);
void lsf_ui_draw_text(float x, float y, uint32_t rgba, const char *text);
/* Draws a texture, rows from the bottom, in that rectangle. */
void lsf_ui_draw_picture(uint32_t texture, lsf_rect rect);

#ifdef __cplusplus
}
#endif
#endif
