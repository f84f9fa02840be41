/* The panels over the sandbox's picture. */
#include "easel/app.h"

#include "base/base.h"

#include <stdio.h>
#include <string.h>

#define PANEL_LINES 11.0f
#define ERROR_LINES 7.0f

static void show_clock(lsf_easel *easel)
{
    const lsf_easel_answer *answer = &easel->answer;
    if (lsf_ui_button(easel->playing ? "Pause" : "Play"))
        easel->playing = !easel->playing;
    lsf_ui_help("F6");
    lsf_ui_same_line();
    if (lsf_ui_button("Step"))
        easel->step = true;
    lsf_ui_help("F7: advance one frame");
    lsf_ui_same_line();
    if (lsf_ui_button("Restart"))
        lsf_easel_restart(easel);
    lsf_ui_help("F5: restart time and buffers");
    lsf_ui_text(LSF_UI_TEXT, "frame %u, %.2f s", answer->number, easel->time_of_last);
    lsf_ui_text(LSF_UI_DIM, "%.1f frames/s, %.1f ms, %ux%u",
                easel->frame_seconds > 0.0 ? 1.0 / easel->frame_seconds : 0.0, answer->milliseconds,
                easel->canvas.width, easel->canvas.height);
    lsf_ui_text(LSF_UI_DIM, "%s", answer->renderer);
}

static void show_uniform(lsf_easel *easel, uint32_t index)
{
    static const char *const parts[] = {"x", "y", "z", "w"};
    lsf_easel_uniform *u = &easel->answer.uniforms[index];
    float low = u->slider ? u->minimum : -10.0f, high = u->slider ? u->maximum : 10.0f;
    for (uint32_t c = 0; c < u->components; c++) {
        char label[LSF_EASEL_NAME + 8];
        bool changed;
        snprintf(label, sizeof label, u->components > 1 ? "%s.%s" : "%s", u->name, parts[c]);
        if (u->integer) {
            int value = (int)u->value[c];
            changed = lsf_ui_slider_int(label, &value, (int)low, (int)high, "%d", false);
            u->value[c] = (float)value;
        } else if (u->slider) {
            changed = lsf_ui_slider(label, &u->value[c], low, high, "%.3g", false);
        } else {
            changed = lsf_ui_drag(label, &u->value[c], 1, 0.01f, -1e6f, 1e6f, "%.3g");
        }
        if (changed)
            easel->set[index] = easel->dirty = true;
    }
}

static void show_picture_settings(lsf_easel *easel)
{
    static const char *const sizes[] = {"1", "1/2", "1/4", "1/8"};
    int index = easel->reduction == 1   ? 0
                : easel->reduction == 2 ? 1
                : easel->reduction == 4 ? 2
                                        : 3;
    if (lsf_ui_choice("Size", &index, sizes, (int)LSF_COUNT(sizes))) {
        easel->reduction = 1 << index;
        easel->dirty = true;
    }
    lsf_ui_help("Pixels of the picture per pixel of the window");
    if (lsf_ui_slider("Exposure", &easel->exposure, -10.0f, 10.0f, "%.1f EV", false))
        easel->dirty = true;
    lsf_ui_help("For shaders that write radiance");
}

static void show_times(const lsf_easel_answer *answer)
{
    for (uint32_t i = 0; i < answer->pass_count; i++) {
        lsf_ui_text(LSF_UI_TEXT, "%s", answer->passes[i].name);
        lsf_ui_same_line();
        lsf_ui_text(LSF_UI_DIM, "%.2f ms", (double)answer->passes[i].milliseconds);
    }
}

static void show_side(lsf_easel *easel)
{
    float width = PANEL_LINES * lsf_ui_line();
    const lsf_rect rect = {(float)easel->input->width - width, 0, width,
                           (float)easel->input->height};
    lsf_ui_panel_begin("shader", rect, true);
    lsf_ui_labels(4.5f);
    show_clock(easel);
    if (easel->answer.uniform_count > 0 && lsf_ui_section("Uniforms", true))
        for (uint32_t i = 0; i < easel->answer.uniform_count; i++)
            show_uniform(easel, i);
    if (lsf_ui_section("Picture", true))
        show_picture_settings(easel);
    if (lsf_ui_section("Passes", false))
        show_times(&easel->answer);
    if (lsf_ui_section("Keys", false))
        lsf_ui_text_wrapped(
            LSF_UI_DIM,
            "Left button: iMouse. With a scene: right rotates, middle moves, the wheel zooms "
            "the camera. F5 restart, F6 pause, F7 step, F11 full screen, F12 picture, Tab hides "
            "this.");
    lsf_ui_panel_end();
}

static void show_error(const lsf_easel *easel, const char *text)
{
    float height = (0.7f * ERROR_LINES + 1.5f) * lsf_ui_line(); /* text has no gaps */
    float width = (float)easel->input->width - (easel->panels ? PANEL_LINES * lsf_ui_line() : 0.0f);
    const lsf_rect rect = {0, (float)easel->input->height - height, width, height};
    if (width < 8.0f * lsf_ui_line())
        return;
    lsf_ui_panel_begin("error", rect, false);
    lsf_ui_text(LSF_UI_ERROR, "%s",
                easel->canvas_frames > 0 ? "The last good shader keeps running"
                                         : "There is no picture yet");
    lsf_ui_listing("message", text, ERROR_LINES);
    lsf_ui_panel_end();
}

void lsf_easel_show_panels(lsf_easel *easel)
{
    const char *text = easel->trouble[0] ? easel->trouble : easel->answer.error;
    const lsf_rect all = {0, 0, (float)easel->input->width, (float)easel->input->height};
    if (easel->canvas.texture) {
        lsf_ui_draw_begin(LSF_UNDER_PANELS, NULL);
        lsf_ui_draw_picture(easel->canvas.texture, all);
        lsf_ui_draw_end();
    }
    if (easel->panels)
        show_side(easel);
    if (text[0])
        show_error(easel, text);
}
