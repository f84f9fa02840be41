/* The functions of keys and mouse: one table, from which the cheat sheet and the page are made. */
#include "view/app.h"

#include "base/base.h"
#include "window/reach.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FLY_SPEED 0.5 /* extents a second */
#define FAST 4.0      /* with Shift */
#define STEP (1.0 / 24.0)

/* --- functions --- */

void lsf_viewer_reset(lsf_viewer *viewer)
{
    lsf_render_params params = lsf_viewer_params(viewer, 1024, 768);
    lsf_error error;
    params.camera_position = viewer->start->render.camera_position;
    params.camera_target = viewer->start->render.camera_target;
    params.fov_y = viewer->start->render.fov_y;
    if (!viewer->scene)
        return;
    params.width = (uint32_t)fmaxf(viewer->area.width, 1.0f);
    params.height = (uint32_t)fmaxf(viewer->area.height, 1.0f);
    if (!lsf_viewer_camera_reset(&viewer->camera, viewer->scene, &params, &error))
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
    viewer->cut = true;
    lsf_viewer_touch(viewer);
}

static void restore_camera(lsf_viewer *viewer)
{
    lsf_viewer_reset(viewer);
    lsf_viewer_say(viewer, LSF_UI_DIM, "The camera is where the file has it");
}

void lsf_viewer_next_camera(lsf_viewer *viewer)
{
    uint32_t count = lsf_scene_camera_count(viewer->scene);
    viewer->file_camera = (viewer->file_camera + 1) % count;
    lsf_viewer_touch_settings(viewer);
    lsf_viewer_reset(viewer);
    lsf_viewer_say(viewer, LSF_UI_DIM, "Camera %u of %u  %s", viewer->file_camera + 1, count,
                   lsf_scene_camera_name(viewer->scene, viewer->file_camera));
}

/* lightsheaf-0001.png and so on, the first that is not there. */
static char *free_path(const char *ending)
{
    for (int i = 1; i < 10000; i++) {
        char *path = lsf_format("lightsheaf-%04d%s", i, ending);
        if (!path || access(path, F_OK) != 0)
            return path;
        free(path);
    }
    return NULL;
}

void lsf_viewer_screenshot(lsf_viewer *viewer)
{
    if (!viewer->scene || viewer->capture)
        return;
    viewer->playing = false;
    viewer->capture = free_path(".png");
    if (!lsf_viewer_finished(viewer))
        lsf_viewer_say(viewer, LSF_UI_DIM, "Saving the picture as soon as it is finished");
}

static void capture_window(lsf_viewer *viewer)
{
    char *path = free_path("-window.png");
    if (path)
        lsf_window_capture(viewer->window, path);
    free(path);
}

void lsf_viewer_copy_command(lsf_viewer *viewer)
{
    char *command = viewer->scene ? lsf_viewer_command(viewer) : NULL;
    if (!command)
        return;
    lsf_window_copy(viewer->window, command);
    printf("%s\n", command);
    fflush(stdout);
    lsf_viewer_say(viewer, LSF_UI_TEXT, "Copied the command line that renders this picture");
    free(command);
}

void lsf_viewer_save_view(lsf_viewer *viewer)
{
    lsf_error error;
    char *path = viewer->scene ? free_path(".view") : NULL;
    char *text = path ? lsf_viewer_view_file(viewer) : NULL;
    if (text && lsf_file_write(path, text, strlen(text), &error))
        lsf_viewer_say(viewer, LSF_UI_TEXT, "Saved %s, for lightsheaf render --view", path);
    else if (text)
        lsf_viewer_say(viewer, LSF_UI_ERROR, "%s", error.message);
    free(text);
    free(path);
}

void lsf_viewer_set_technique(lsf_viewer *viewer, int technique)
{
    viewer->settings.technique = technique;
    lsf_viewer_touch_settings(viewer);
    lsf_viewer_say(viewer, LSF_UI_DIM, "Technique %s", lsf_technique_name((uint32_t)technique));
}

static void next_technique(lsf_viewer *viewer)
{
    int next = viewer->settings.technique + 1;
    lsf_viewer_set_technique(viewer, lsf_technique_name((uint32_t)next) ? next : 0);
}

static void toggle_play(lsf_viewer *viewer)
{
    if (viewer->duration > 0.0)
        viewer->playing = !viewer->playing;
    else
        lsf_viewer_say(viewer, LSF_UI_DIM, "Nothing in this scene is animated");
    lsf_viewer_touch(viewer);
}

static void step_time(lsf_viewer *viewer, double by)
{
    viewer->playing = false;
    viewer->time = fmax(0.0, fmin(viewer->duration, viewer->time + by));
    lsf_viewer_touch(viewer);
}

static void step_back(lsf_viewer *viewer)
{
    step_time(viewer, -STEP);
}

static void step_on(lsf_viewer *viewer)
{
    step_time(viewer, STEP);
}

static void look_from(lsf_viewer *viewer, lsf_viewer_axis axis)
{
    lsf_viewer_camera_from(&viewer->camera, axis);
    viewer->cut = true;
    lsf_viewer_touch(viewer);
}

static void from_front(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_FRONT);
}

static void from_right(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_RIGHT);
}

static void from_above(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_TOP);
}

static void from_back(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_BACK);
}

static void from_left(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_LEFT);
}

static void from_below(lsf_viewer *viewer)
{
    look_from(viewer, LSF_VIEWER_BOTTOM);
}

static void frame_all(lsf_viewer *viewer)
{
    lsf_viewer_camera_frame(&viewer->camera, lsf_scene_get_requirements(viewer->scene),
                            (double)viewer->area.width / (double)viewer->area.height);
    lsf_viewer_touch(viewer);
}

static void brighter(lsf_viewer *viewer)
{
    viewer->settings.exposure = fminf(100.0f, viewer->settings.exposure + 0.25f);
    viewer->tones_changed = true;
}

static void darker(lsf_viewer *viewer)
{
    viewer->settings.exposure = fmaxf(-100.0f, viewer->settings.exposure - 0.25f);
    viewer->tones_changed = true;
}

static void toggle_sheet(lsf_viewer *viewer)
{
    viewer->cheat_sheet = !viewer->cheat_sheet;
}

static void toggle_panels(lsf_viewer *viewer)
{
    viewer->panels = !viewer->panels;
}

static void toggle_full_screen(lsf_viewer *viewer)
{
    lsf_window_toggle_full_screen(viewer->window);
}

static void next_file(lsf_viewer *viewer)
{
    if (viewer->path_count > 1)
        lsf_viewer_show_file(viewer, (viewer->shown + 1) % viewer->path_count);
}

static void previous_file(lsf_viewer *viewer)
{
    if (viewer->path_count > 1)
        lsf_viewer_show_file(viewer, (viewer->shown + viewer->path_count - 1) % viewer->path_count);
}

static void close_window(lsf_viewer *viewer)
{
    lsf_window_close(viewer->window);
}

static void escape(lsf_viewer *viewer)
{
    viewer->cheat_sheet = viewer->placing = false;
    viewer->node = LSF_NONE;
}

/* --- the table --- */

/* Rows without a function are done elsewhere, with the mouse: those come first, as lsf_viewer_mouse
 * has them. */
static const struct {
    const char *keys, *effect;
    int key;
    uint32_t modifiers;
    bool anywhere; /* also where no scene is shown */
    void (*act)(lsf_viewer *viewer);
} rows[] = {
    {"Left drag", "orbit the camera", 0, 0, false, NULL},
    {"Middle drag, Shift+left drag", "pan the camera", 0, 0, false, NULL},
    {"Wheel", "move nearer or farther", 0, 0, false, NULL},
    {"Right drag", "look around", 0, 0, false, NULL},
    {"Right held, W A S D", "fly; Q and E go down and up, Shift four times as fast", 0, 0, false,
     NULL},
    {"Click", "select an object, to move and change it", 0, 0, false, NULL},
    {"Double click", "orbit around that point", 0, 0, false, NULL},
    {"Enter", "reset the camera to the file's", LSF_KEY_ENTER, 0, false, restore_camera},
    {"F", "frame the whole scene", 'F', 0, false, frame_all},
    {"1, Ctrl+1", "view from the front, from behind", '1', 0, false, from_front},
    {NULL, NULL, '1', LSF_CONTROL, false, from_back},
    {"3, Ctrl+3", "view from the right, from the left", '3', 0, false, from_right},
    {NULL, NULL, '3', LSF_CONTROL, false, from_left},
    {"7, Ctrl+7", "view from above, from below", '7', 0, false, from_above},
    {NULL, NULL, '7', LSF_CONTROL, false, from_below},
    {"C", "next camera of the file", 'C', 0, false, lsf_viewer_next_camera},
    {"T", "next technique", 'T', 0, false, next_technique},
    {"+ and -", "brighter, darker by a quarter of a stop", '=', 0, false, brighter},
    {NULL, NULL, '=', LSF_SHIFT, false, brighter},
    {NULL, NULL, '-', 0, false, darker},
    {"Space", "play or stop the animation", ' ', 0, false, toggle_play},
    {"Left and right arrow", "previous and next frame of the animation", LSF_KEY_LEFT, 0, false,
     step_back},
    {NULL, NULL, LSF_KEY_RIGHT, 0, false, step_on},
    {"Page down, page up", "next file, previous file", LSF_KEY_PAGE_DOWN, 0, true, next_file},
    {NULL, NULL, LSF_KEY_PAGE_UP, 0, true, previous_file},
    {"F12", "save the picture when it is finished", LSF_KEY_F12, 0, false, lsf_viewer_screenshot},
    {"Shift+F12", "save the window as it is", LSF_KEY_F12, LSF_SHIFT, true, capture_window},
    {"Ctrl+C", "copy and print the command line of this picture", 'C', LSF_CONTROL, false,
     lsf_viewer_copy_command},
    {"Ctrl+S", "save the view for lightsheaf render --view", 'S', LSF_CONTROL, false,
     lsf_viewer_save_view},
    {"Tab", "show or hide the panels", LSF_KEY_TAB, 0, true, toggle_panels},
    {"F11", "switch full screen on or off", LSF_KEY_F11, 0, true, toggle_full_screen},
    {"H", "show this list", 'H', 0, true, toggle_sheet},
    {"Ctrl+Q", "quit", 'Q', LSF_CONTROL, true, close_window},
    {"Escape", "clear the selection", LSF_KEY_ESCAPE, 0, true, escape},
};

void lsf_viewer_reach(size_t row)
{
    lsf_reach_key(row, rows[row].keys, true);
}

void lsf_viewer_list_keys(void)
{
    for (size_t i = 0; i < LSF_COUNT(rows); i++)
        lsf_reach_key(i, rows[i].keys, false);
}

bool lsf_viewer_key(uint32_t index, lsf_viewer_key_row *row)
{
    for (size_t i = 0; i < LSF_COUNT(rows); i++)
        if (rows[i].keys && index-- == 0) {
            *row = (lsf_viewer_key_row){rows[i].keys, rows[i].effect};
            return true;
        }
    return false;
}

/* --- the mouse --- */

static bool inside(const lsf_viewer *viewer)
{
    const lsf_rect *area = &viewer->area;
    const lsf_input *input = viewer->input;
    return input->x >= (double)area->x && input->y >= (double)area->y &&
           input->x < (double)(area->x + area->width) &&
           input->y < (double)(area->y + area->height);
}

static void fly(lsf_viewer *viewer)
{
    const bool *held = viewer->input->held;
    double speed = FLY_SPEED * fmin(viewer->input->step, 0.1) *
                   (viewer->input->modifiers & LSF_SHIFT ? FAST : 1.0);
    double right = (double)held['D'] - (double)held['A'];
    double up = (double)held['E'] - (double)held['Q'];
    double forward = (double)held['W'] - (double)held['S'];
    if (right == 0.0 && up == 0.0 && forward == 0.0)
        return;
    lsf_viewer_reach(LSF_VIEWER_FLY);
    lsf_viewer_camera_fly(&viewer->camera, speed * right, speed * up, speed * forward);
    lsf_viewer_touch(viewer);
}

static void drag(lsf_viewer *viewer)
{
    const lsf_input *input = viewer->input;
    double dx = input->dx / (double)viewer->area.height;
    double dy = input->dy / (double)viewer->area.height;
    bool shift = input->modifiers & LSF_SHIFT;
    if (dx == 0.0 && dy == 0.0)
        return;
    bool look = input->down[LSF_BUTTON_RIGHT], left = input->down[LSF_BUTTON_LEFT];
    bool pan = input->down[LSF_BUTTON_MIDDLE] || (left && shift);
    if (!look && !pan && !left)
        return;
    if (look)
        lsf_viewer_camera_look(&viewer->camera, dx, dy);
    else if (pan)
        lsf_viewer_camera_pan(&viewer->camera, dx, dy);
    else
        lsf_viewer_camera_orbit(&viewer->camera, dx, dy);
    lsf_viewer_reach(look ? LSF_VIEWER_LOOK : pan ? LSF_VIEWER_PAN : LSF_VIEWER_ORBIT);
    lsf_viewer_touch(viewer);
}

void lsf_viewer_handle(lsf_viewer *viewer)
{
    const lsf_input *input = viewer->input;
    bool flying = input->down[LSF_BUTTON_RIGHT];
    for (size_t i = 0; i < LSF_COUNT(rows); i++) {
        bool letter = rows[i].key > ' ' && rows[i].key < 128 && rows[i].modifiers == 0;
        if (rows[i].act && (viewer->scene || rows[i].anywhere) && !(flying && letter) &&
            lsf_input_key(input, rows[i].key, rows[i].modifiers)) {
            rows[i].act(viewer);
            lsf_viewer_reach(i);
        }
    }
    if (!viewer->scene)
        return;
    if (!lsf_viewer_drag_bar(viewer) && !lsf_viewer_point(viewer))
        drag(viewer);
    if (flying)
        fly(viewer);
    if (input->scroll != 0.0 && inside(viewer)) {
        lsf_viewer_camera_zoom(&viewer->camera, input->scroll);
        lsf_viewer_reach(LSF_VIEWER_WHEEL);
        lsf_viewer_touch(viewer);
    }
}
