/* Declarations that the files of the viewer share. */
#ifndef LSF_VIEW_APP_H
#define LSF_VIEW_APP_H

#include "view/budget.h"
#include "view/camera.h"
#include "view/view.h"
#include "window/canvas.h"
#include "window/ui.h"

#include <stdio.h>

enum {
    LSF_VIEWER_OPTIONS = 96,
    LSF_VIEWER_PASSES = 40,
    LSF_VIEWER_HISTORY = 96,
    LSF_VIEWER_LIGHTS = 32, /* that can be added */
};

/* --- settings: the parameters of a picture beside scene and camera --- */

typedef struct lsf_viewer_option {
    const char *key, *type, *help; /* lsf_option's */
    char range[80], initial[32], unit[24];
    char value[32];
} lsf_viewer_option;

typedef struct lsf_viewer_settings {
    int technique;
    uint32_t samples; /* of a finished picture */
    int bounces;      /* -1: as many as the scene asks for */
    uint64_t seed;
    bool raw;
    float exposure;
    int curve;
    int layer; /* 0: the picture, else the AOV of bit layer - 1 */
    lsf_background background;
    float background_radiance[3];
    uint32_t option_count;
    lsf_viewer_option options[LSF_VIEWER_OPTIONS];
} lsf_viewer_settings;

void lsf_viewer_settings_start(lsf_viewer_settings *settings, const lsf_viewer_start *start);

/* Sets the render parameters that settings hold; they borrow `storage`. */
typedef struct lsf_viewer_assignments {
    char text[LSF_VIEWER_OPTIONS + 8][128];
    const char *items[LSF_VIEWER_OPTIONS + 8];
    uint32_t count;
} lsf_viewer_assignments;
void lsf_viewer_settings_params(const lsf_viewer_settings *settings, lsf_render_params *params,
                                lsf_viewer_assignments *storage);
bool lsf_viewer_option_changed(const lsf_viewer_option *option);

/* --- pictures --- */

/* A renderer and the canvas that shows its picture. */
typedef struct lsf_viewer_picture {
    lsf_renderer *renderer;
    lsf_canvas canvas;
    uint32_t width, height;
    uint32_t done;    /* iterations of the picture that is shown */
    uint32_t samples; /* that it is to have */
    bool begun;       /* it is a picture of what the viewer shows */
    uint32_t version; /* version of the settings that its renderer has */
    lsf_error error;  /* code LSF_OK: none */
} lsf_viewer_picture;

/* The picture that the picture is compared with. */
typedef enum lsf_viewer_rival {
    LSF_VIEWER_ALONE,
    LSF_VIEWER_REFERENCE, /* the path tracer; higher: a technique */
    LSF_VIEWER_TECHNIQUE
} lsf_viewer_rival;

typedef struct lsf_viewer_compare {
    int rival;                  /* LSF_VIEWER_TECHNIQUE + n: technique n */
    bool difference;            /* the difference is shown in place of the rival */
    float gain;                 /* of the difference */
    float split;                /* position of the bar, 0..1 of the picture's width */
    bool dragging;              /* the bar */
    lsf_viewer_picture picture; /* picture of a rival technique; of the path tracer without
                                 * renderer */
    lsf_canvas apart;           /* the difference */
    lsf_image *image;           /* image of the finished rival */
    lsf_compare_result result;
    bool measured;
    struct lsf_viewer_tracer *tracer; /* the path tracer while it runs; NULL: it does not */
    uint32_t traced;                  /* samples of the path tracer's picture */
} lsf_viewer_compare;

/* Milliseconds of the last frames, by pass. */
typedef struct lsf_viewer_times {
    char names[LSF_VIEWER_PASSES][40];
    float milliseconds[LSF_VIEWER_HISTORY][LSF_VIEWER_PASSES];
    float mean[LSF_VIEWER_PASSES]; /* of a frame, over the last ones */
    uint32_t pass_count, next;     /* the row to fill next */
} lsf_viewer_times;

/* --- the viewer --- */

typedef enum lsf_viewer_tab {
    LSF_VIEWER_TAB_PICTURE,
    LSF_VIEWER_TAB_SCENE,
    LSF_VIEWER_TAB_COMPARE,
    LSF_VIEWER_TAB_PASSES,
    LSF_VIEWER_TAB_COUNT
} lsf_viewer_tab;

typedef struct lsf_viewer {
    const lsf_viewer_start *start;
    lsf_window *window;
    lsf_context *context;
    const lsf_input *input;
    lsf_context_info device;

    /* The files that are open, and the one that is shown. */
    char **paths;
    uint32_t path_count, shown;
    uint64_t path_capacity;
    lsf_scene *scene; /* NULL: the start page, or a file that did not load */
    lsf_scene_params scene_params;
    lsf_placed_light lights[LSF_VIEWER_LIGHTS]; /* that were added, those of the start first */
    bool *edited[LSF_KIND_CAMERA];              /* whether the user edited each node, light,
                                                 * material */
    uint32_t node, light, material;             /* the selected ones; LSF_NONE: none */
    double anchor[3];                           /* position of the selected node's handles */
    int dragged;                                /* the handle that is dragged; -1: none */
    double ring_angle;                          /* angle at which a ring is held */
    char environment[4096];                     /* path that was dropped on the window */
    bool environment_edited;                    /* rotated or scaled by the user */
    double press_x, press_y;                    /* position at which the left button was pressed */
    bool placing;                               /* the next click puts a light there */
    lsf_error scene_error;

    lsf_viewer_camera camera;
    uint32_t file_camera;
    char camera_name[16]; /* its index as text */
    lsf_viewer_settings settings;
    uint32_t settings_version; /* counts changes */
    double time, duration;     /* seconds of animations */
    bool playing;

    lsf_rect area; /* the picture's rectangle in the window */
    lsf_viewer_picture lively, still;
    lsf_viewer_compare compare;
    lsf_viewer_times times;
    lsf_budget budget;
    uint32_t budget_version; /* version of the settings whose prices it has; 0: none */
    bool spent;              /* the frame's time counts for the budget */
    lsf_viewer_assignments assignments;
    bool stale;         /* something differs from the frame before */
    bool moving;        /* pictures of the fast renderer are shown */
    double quiet_since; /* seconds on the input's clock */
    char *plan_text;
    bool plan_wanted;
    bool cut;           /* nothing that is shown continues: another scene, a jump in time */
    bool tones_changed; /* exposure or curve changed: pictures are tone-mapped anew */
    bool expose_wanted; /* the exposure is to follow from the next finished picture */

    bool panels, cheat_sheet;
    lsf_viewer_tab tab;
    bool tab_wanted;  /* `tab` comes to the front */
    char notice[256]; /* shown in the status bar for a while */
    lsf_ui_color notice_color;
    double notice_until;
    double slice_end;   /* end of a rival's iterations in this frame, lsf_now */
    FILE *frame_log;    /* of --frame-times; NULL: none */
    double frame_begun; /* lsf_now */
    double looked_at;   /* when files were last checked for changes, seconds on the input's clock */
    int64_t scene_changed, shaders_changed; /* times of their last change, nanoseconds */
    char *capture;                          /* file that the picture is saved to as soon as it is
                                             * finished */
} lsf_viewer;

/* Something in the picture changes from now on. */
void lsf_viewer_touch(lsf_viewer *viewer);
/* The same for its settings. */
void lsf_viewer_touch_settings(lsf_viewer *viewer);
/* A line in the status bar for some seconds. */
void lsf_viewer_say(lsf_viewer *viewer, lsf_ui_color color, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* --- files.c --- */

bool lsf_viewer_add_path(lsf_viewer *viewer, const char *path);
/* Shows the file of that index; errors are shown, too. */
void lsf_viewer_show_file(lsf_viewer *viewer, uint32_t index);
void lsf_viewer_close_scene(lsf_viewer *viewer);

/* Handles files that were dropped on the window. */
void lsf_viewer_take_dropped(lsf_viewer *viewer);
/* Follows changes of the scene's file, and of --shader-dir. */
void lsf_viewer_watch(lsf_viewer *viewer);
void lsf_viewer_start_page(lsf_viewer *viewer);

/* --- compare.c --- */

/* Takes the rival a frame further; begins anew where the picture has begun anew. */
void lsf_viewer_refine_rival(lsf_viewer *viewer);
/* To be called before the scene changes: stops the path tracer, which reads it. */
void lsf_viewer_stop_rival(lsf_viewer *viewer);
void lsf_viewer_drop_rival(lsf_viewer *viewer);
bool lsf_viewer_rival_finished(const lsf_viewer *viewer);
/* Draws the other half of a split picture over it, and the bar. */
void lsf_viewer_draw_rival(const lsf_viewer *viewer);
/* True where the bar takes the drag. */
bool lsf_viewer_drag_bar(lsf_viewer *viewer);
void lsf_viewer_compare_tab(lsf_viewer *viewer);

/* --- edits.c --- */

/* The user's edits, as lsf_scene_edit takes them, one in a line; malloc'ed, "" where there are
 * none; NULL without memory. */
char *lsf_viewer_edits(const lsf_viewer *viewer);
/* Marks nothing of the loaded scene as edited. False without memory. */
bool lsf_viewer_begin_edits(lsf_viewer *viewer);
/* Loads the file again, with the current scene_params, and applies the edits. */
void lsf_viewer_reload(lsf_viewer *viewer);
void lsf_viewer_set_light(lsf_viewer *viewer, uint32_t light, const lsf_light_desc *desc);
extern const char *const lsf_viewer_light_types[];
void lsf_viewer_set_environment(lsf_viewer *viewer, float rotation, float strength);
void lsf_viewer_set_material(lsf_viewer *viewer, uint32_t material, const lsf_material_desc *desc);
/* Rotates, scales or shears the node about its anchor, in scene space: `linear` has rows of 3. */
void lsf_viewer_transform_node(lsf_viewer *viewer, uint32_t node, const double linear[9]);
/* Moves the node by that vector, in scene space. */
void lsf_viewer_move_node(lsf_viewer *viewer, uint32_t node, const double by[3]);
void lsf_viewer_add_light(lsf_viewer *viewer, const double position[3]);

/* --- click.c --- */

/* Handles clicks on the picture: selecting, orbiting about a point, placing lights. True where
 * handles take the drag. */
bool lsf_viewer_point(lsf_viewer *viewer);
void lsf_viewer_choose_node(lsf_viewer *viewer, uint32_t node);
/* The surface under the cursor. False: there is none, or the cursor is not over the picture. */
bool lsf_viewer_pick(const lsf_viewer *viewer, lsf_hit *hit);

/* --- handles.c --- */

/* The handle of the selected node under the cursor; -1: none. `angle`: where a ring is met. */
int lsf_viewer_handle_under_cursor(const lsf_viewer *viewer, double *angle);
/* Drags the held handle, as far as the cursor moved in this frame. */
void lsf_viewer_drag_handle(lsf_viewer *viewer);
void lsf_viewer_draw_handles(const lsf_viewer *viewer);
double lsf_viewer_aspect(const lsf_viewer *viewer); /* of the picture */

/* --- pictures.c --- */

/* Parameters of a picture of that size, with the current camera and settings; they borrow from
 * the viewer. */
lsf_render_params lsf_viewer_params(lsf_viewer *viewer, uint32_t width, uint32_t height);
/* Goes over to these parameters; makes a renderer where there is none. */
bool lsf_viewer_adopt(lsf_viewer *viewer, lsf_viewer_picture *picture,
                      const lsf_render_params *params);
/* Brings the picture that is shown a frame further. */
void lsf_viewer_refine(lsf_viewer *viewer);
/* Tells how long the frame before took. */
void lsf_viewer_spend(lsf_viewer *viewer, double seconds);
/* The picture to show, of the two. */
const lsf_viewer_picture *lsf_viewer_shown(const lsf_viewer *viewer);
bool lsf_viewer_finished(const lsf_viewer *viewer);
void lsf_viewer_drop_pictures(lsf_viewer *viewer);
/* Saves the finished picture as PNG, with the command that makes it. */
void lsf_viewer_save_picture(lsf_viewer *viewer, const char *path);

/* --- frame_log.c --- */

bool lsf_viewer_open_frame_log(lsf_viewer *viewer, lsf_error *error);
/* Writes how long the frame before was shown, and which picture it showed. */
void lsf_viewer_log_frame(lsf_viewer *viewer, double seconds);
bool lsf_viewer_close_frame_log(lsf_viewer *viewer, lsf_error *error);
/* Writes NAME.exr, the radiance that is shown, at the size of the window, and NAME.view, its
 * camera and settings. */
bool lsf_viewer_take_snapshot(lsf_viewer *viewer, const char *name, lsf_error *error);

/* --- layers.c --- */

/* Shows a layer's texture, with a mapping that suits the layer, in a canvas of its size. */
void lsf_viewer_show_layer(lsf_viewer *viewer, uint32_t texture, lsf_canvas *canvas);
const char *lsf_viewer_layer_name(int layer); /* "Picture", "Albedo", ...; NULL past the end */

/* --- keys.c --- */

/* Rows of the table of keys that belong to the mouse. */
typedef enum lsf_viewer_mouse {
    LSF_VIEWER_ORBIT,
    LSF_VIEWER_PAN,
    LSF_VIEWER_WHEEL,
    LSF_VIEWER_LOOK,
    LSF_VIEWER_FLY,
    LSF_VIEWER_CLICK,
    LSF_VIEWER_DOUBLE_CLICK
} lsf_viewer_mouse;

/* Marks a row of the table of keys as used, for the coverage (window/reach.h); and notes all
 * rows. */
void lsf_viewer_reach(size_t row);
void lsf_viewer_list_keys(void);

void lsf_viewer_handle(lsf_viewer *viewer);
bool lsf_viewer_key(uint32_t index, lsf_viewer_key_row *row);
/* Functions that keys and menus share. */
void lsf_viewer_reset(lsf_viewer *viewer);
void lsf_viewer_next_camera(lsf_viewer *viewer);
void lsf_viewer_screenshot(lsf_viewer *viewer);
void lsf_viewer_copy_command(lsf_viewer *viewer);
void lsf_viewer_save_view(lsf_viewer *viewer);
void lsf_viewer_set_technique(lsf_viewer *viewer, int technique);

/* --- command_line.c --- */

/* The options that make this picture, each with a space before it, or each in a line of its own;
 * malloc'ed, NULL without memory. */
char *lsf_viewer_command(lsf_viewer *viewer);
char *lsf_viewer_view_file(lsf_viewer *viewer);

/* --- panels --- */

void lsf_viewer_show_panels(lsf_viewer *viewer);
void lsf_viewer_picture_tab(lsf_viewer *viewer);
void lsf_viewer_passes_tab(lsf_viewer *viewer);
void lsf_viewer_scene_tab(lsf_viewer *viewer);

#endif
