/* Menu bar, side panel, status and time bar, and what lies over the picture. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>
#include <string.h>

#define SIDE_LINES 23.0f /* width of the side panel, in heights of the text */
#define LABEL_LINES 8.0f

/* --- menus --- */

static void file_menu(lsf_viewer *viewer)
{
    if (lsf_ui_menu_item(
            "Save picture", "F12", false,
            "Saves the picture when it is finished, with the bits of lightsheaf render"))
        lsf_viewer_screenshot(viewer);
    if (lsf_ui_menu_item("Save view", "Ctrl+S", false,
                         "Camera and settings, for lightsheaf render --view"))
        lsf_viewer_save_view(viewer);
    if (lsf_ui_menu_item("Copy command line", "Ctrl+C", false,
                         "The call of lightsheaf render that makes this very picture"))
        lsf_viewer_copy_command(viewer);
    for (uint32_t i = 0; viewer->path_count > 1 && i < viewer->path_count; i++) {
        const char *slash = strrchr(viewer->paths[i], '/');
        lsf_ui_scope_begin((int)i);
        if (lsf_ui_menu_item(slash ? slash + 1 : viewer->paths[i], NULL, i == viewer->shown, NULL))
            lsf_viewer_show_file(viewer, i);
        lsf_ui_scope_end();
    }
    if (lsf_ui_menu_item("Quit", "Ctrl+Q", false, NULL))
        lsf_window_close(viewer->window);
}

static void technique_menu(lsf_viewer *viewer)
{
    const char *name;
    for (uint32_t i = 0; (name = lsf_technique_name(i)) != NULL; i++)
        if (lsf_ui_menu_item(name, i == 0 ? "T" : NULL, (int)i == viewer->settings.technique,
                             lsf_technique_help(i)))
            lsf_viewer_set_technique(viewer, (int)i);
}

static void show_menu(lsf_viewer *viewer)
{
    for (int i = 0; lsf_viewer_layer_name(i); i++)
        if (lsf_ui_menu_item(lsf_viewer_layer_name(i), NULL, i == viewer->settings.layer, NULL)) {
            viewer->settings.layer = i;
            lsf_viewer_touch_settings(viewer);
        }
}

static void window_menu(lsf_viewer *viewer)
{
    if (lsf_ui_menu_item("Panels", "Tab", viewer->panels, NULL))
        viewer->panels = !viewer->panels;
    if (lsf_ui_menu_item("Full screen", "F11", false, NULL))
        lsf_window_toggle_full_screen(viewer->window);
    if (lsf_ui_menu_item("Keys", "H", viewer->cheat_sheet, NULL))
        viewer->cheat_sheet = !viewer->cheat_sheet;
}

static void menu_bar(lsf_viewer *viewer)
{
    static const struct {
        const char *label;
        void (*show)(lsf_viewer *viewer);
        bool of_scene;
    } menus[] = {{"File", file_menu, false},
                 {"Technique", technique_menu, true},
                 {"Layer", show_menu, true},
                 {"Window", window_menu, false}};
    if (!lsf_ui_menu_bar_begin())
        return;
    for (size_t i = 0; i < LSF_COUNT(menus); i++)
        if ((viewer->scene || !menus[i].of_scene) && lsf_ui_menu_begin(menus[i].label)) {
            menus[i].show(viewer);
            lsf_ui_menu_end();
        }
    lsf_ui_menu_bar_end();
}

/* --- the side panel --- */

static void side_panel(lsf_viewer *viewer, lsf_rect rect)
{
    static const struct {
        const char *label;
        void (*show)(lsf_viewer *viewer);
    } tabs[LSF_VIEWER_TAB_COUNT] = {
        [LSF_VIEWER_TAB_PICTURE] = {"Picture", lsf_viewer_picture_tab},
        [LSF_VIEWER_TAB_SCENE] = {"Scene", lsf_viewer_scene_tab},
        [LSF_VIEWER_TAB_COMPARE] = {"Compare", lsf_viewer_compare_tab},
        [LSF_VIEWER_TAB_PASSES] = {"Passes", lsf_viewer_passes_tab},
    };
    lsf_ui_panel_begin("side", rect, true);
    lsf_ui_labels(LABEL_LINES);
    lsf_ui_tabs_begin("tabs");
    for (int i = 0; i < LSF_VIEWER_TAB_COUNT; i++)
        if (tabs[i].show &&
            lsf_ui_tab_begin(tabs[i].label, viewer->tab_wanted && (int)viewer->tab == i)) {
            tabs[i].show(viewer);
            lsf_ui_tab_end();
        }
    lsf_ui_tabs_end();
    viewer->tab_wanted = false;
    lsf_ui_panel_end();
}

/* --- below the picture --- */

static void time_bar(lsf_viewer *viewer, lsf_rect rect)
{
    float time = (float)viewer->time;
    lsf_ui_panel_begin("time", rect, false);
    lsf_ui_labels(0.0f);
    if (lsf_ui_button(viewer->playing ? "Stop##play" : "Play##play")) {
        viewer->playing = !viewer->playing;
        lsf_viewer_touch(viewer);
    }
    lsf_ui_help("Space");
    lsf_ui_same_line();
    if (lsf_ui_slider("##Time", &time, 0.0f, (float)viewer->duration, "%.3f s", false)) {
        viewer->time = (double)time;
        viewer->playing = false;
        lsf_viewer_touch(viewer);
    }
    lsf_ui_panel_end();
}

static void status_bar(lsf_viewer *viewer, lsf_rect rect)
{
    const lsf_viewer_picture *shown = lsf_viewer_shown(viewer);
    const lsf_viewer_picture *still = &viewer->still;
    lsf_ui_panel_begin("status", rect, false);
    if (viewer->notice[0] && viewer->input->time < viewer->notice_until) {
        lsf_ui_text(viewer->notice_color, "%s", viewer->notice);
    } else if (viewer->scene) {
        lsf_ui_text(LSF_UI_TEXT, "%s", lsf_technique_name((uint32_t)viewer->settings.technique));
        lsf_ui_same_line();
        lsf_ui_text(LSF_UI_DIM, "%ux%u", shown->width, shown->height);
        lsf_ui_same_line();
        if (viewer->moving && viewer->budget.mean > 0.0)
            lsf_ui_text(LSF_UI_DIM, "%.0f ms a frame, within %.0f ms", 1e3 * viewer->budget.mean,
                        1e3 * viewer->budget.seconds);
        else if (!viewer->moving)
            lsf_ui_text(still->done < still->samples ? LSF_UI_ACCENT : LSF_UI_DIM,
                        "%u of %u iterations", still->done, still->samples);
    }
    if (viewer->scene && rect.width > 45.0f * lsf_ui_em()) {
        const char *device = viewer->device.renderer;
        char text[96];
        lsf_print(text, sizeof text, "%.40s   H: keys", device);
        lsf_ui_at((rect.width - lsf_ui_text_width(text)) / lsf_ui_em() - 1.2f);
        lsf_ui_text(LSF_UI_DIM, "%s", text);
    }
    lsf_ui_panel_end();
}

/* --- over the picture --- */

static void cheat_sheet(lsf_viewer *viewer)
{
    lsf_viewer_key_row row;
    (void)viewer;
    lsf_ui_dialogue_begin("Keys and mouse", 44.0f);
    lsf_ui_text(LSF_UI_ACCENT, "Keys and mouse");
    lsf_ui_gap();
    for (uint32_t i = 0; lsf_viewer_key(i, &row); i++) {
        lsf_ui_text(LSF_UI_TEXT, "%s", row.keys);
        lsf_ui_at(14.0f);
        lsf_ui_text(LSF_UI_DIM, "%s", row.effect);
    }
    lsf_ui_gap();
    if (lsf_ui_button("Close"))
        viewer->cheat_sheet = false;
    lsf_ui_dialogue_end();
}

static void error_box(const char *title, const lsf_error *error)
{
    lsf_ui_dialogue_begin(title, 36.0f);
    lsf_ui_text(LSF_UI_ERROR, "%s", title);
    lsf_ui_gap();
    lsf_ui_text_wrapped(LSF_UI_TEXT, error->message);
    lsf_ui_dialogue_end();
}

static void overlays(lsf_viewer *viewer)
{
    const lsf_error *drawing =
        viewer->still.error.code != LSF_OK ? &viewer->still.error : &viewer->lively.error;
    if (viewer->scene_error.code != LSF_OK)
        error_box("This scene cannot be shown", &viewer->scene_error);
    else if (viewer->scene && drawing->code != LSF_OK)
        error_box("This picture cannot be made", drawing);
    else if (viewer->path_count == 0 && !viewer->cheat_sheet)
        lsf_viewer_start_page(viewer);
    if (viewer->cheat_sheet)
        cheat_sheet(viewer);
}

/* --- all of it --- */

static float whole(float x)
{
    return floorf(x + 0.5f);
}

static void draw_picture(const lsf_viewer *viewer)
{
    const lsf_viewer_picture *shown = lsf_viewer_shown(viewer);
    if (!viewer->scene || !shown->canvas.texture || shown->done == 0)
        return;
    lsf_ui_draw_begin(LSF_UNDER_PANELS, &viewer->area);
    lsf_ui_draw_picture(shown->canvas.texture, viewer->area);
    lsf_ui_draw_end();
    lsf_viewer_draw_rival(viewer);
    if (!viewer->panels || viewer->node == LSF_NONE || viewer->placing)
        return;
    lsf_ui_draw_begin(LSF_UNDER_PANELS, &viewer->area);
    lsf_viewer_draw_handles(viewer);
    lsf_ui_draw_end();
}

void lsf_viewer_show_panels(lsf_viewer *viewer)
{
    const lsf_input *input = viewer->input;
    float width = (float)input->width, height = (float)input->height;
    float line = whole(lsf_ui_line() + 0.5f * lsf_ui_em()), top = 0.0f, right = width,
          bottom = height;
    if (viewer->panels) {
        menu_bar(viewer);
        top = whole(lsf_ui_menu_height());
        bottom -= line;
        status_bar(viewer, (lsf_rect){0, bottom, width, line});
    }
    if (viewer->panels && viewer->scene) {
        right = whole(width - fminf(SIDE_LINES * lsf_ui_em(), 0.45f * width));
        side_panel(viewer, (lsf_rect){right, top, width - right, bottom - top});
    }
    if (viewer->panels && viewer->scene && viewer->duration > 0.0) {
        bottom -= line;
        time_bar(viewer, (lsf_rect){0, bottom, right, line});
    }
    viewer->area = (lsf_rect){0, top, fmaxf(right, 0.0f), fmaxf(bottom - top, 0.0f)};
    overlays(viewer);
    lsf_viewer_refine(viewer);
    lsf_viewer_refine_rival(viewer);
    draw_picture(viewer);
}
