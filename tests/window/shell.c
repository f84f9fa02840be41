/* A client of the window without any scene, which prints what it is told: for test_shell.py. */
#include "base/base.h"
#include "window/canvas.h"
#include "window/ui.h"
#include "window/window.h"

#include <stdio.h>
#include <string.h>

enum { SIDE = 32, PANEL = 120 };

typedef struct shell {
    lsf_canvas canvas;
    float level;
    bool lamp;
    int shape, work, opened;
} shell;

static bool open_shell(void *user, lsf_window *window, lsf_error *error)
{
    shell *s = user;
    lsf_context_info info = lsf_context_get_info(lsf_window_context(window));
    printf("open %d %s\n", ++s->opened, info.backend);
    return lsf_canvas_resize(&s->canvas, SIDE, SIDE, error);
}

static void close_shell(void *user)
{
    shell *s = user;
    printf("close\n");
    lsf_canvas_destroy(&s->canvas);
}

static void tell(const lsf_input *input)
{
    static const char *const names[] = {"left", "right", "middle"};
    for (int i = 0; i < LSF_BUTTON_COUNT; i++)
        if (input->pressed[i])
            printf("%s %.0f,%.0f%s\n", names[i], input->x, input->y,
                   i == LSF_BUTTON_LEFT && input->double_clicked ? " twice" : "");
        else if (input->down[i] && (input->dx != 0.0 || input->dy != 0.0))
            printf("drag %.0f,%.0f\n", input->dx, input->dy);
    for (uint32_t i = 0; i < input->key_count; i++)
        printf("key %d %u\n", input->keys[i], input->modifiers);
    if (input->scroll != 0.0)
        printf("scroll %.0f\n", input->scroll);
    for (uint32_t i = 0; i < input->dropped_count; i++)
        printf("drop %s\n", input->dropped[i]);
}

static void fill(shell *s)
{
    static uint8_t rgb[SIDE * SIDE * 3];
    for (int i = 0; i < SIDE * SIDE; i++) {
        rgb[3 * i] = (uint8_t)(255.0f * s->level);
        rgb[3 * i + 1] = s->lamp ? 255 : 0;
        rgb[3 * i + 2] = i < SIDE * SIDE / 2 ? 255 : 0; /* the upper half */
    }
    lsf_canvas_write(&s->canvas, rgb);
}

static void show_panel(shell *s, lsf_window *window, const lsf_input *input)
{
    static const char *const shapes[] = {"cube", "ball"};
    if (lsf_ui_menu_bar_begin()) {
        if (lsf_ui_menu_begin("File")) {
            if (lsf_ui_menu_item("Save picture", "F12", false, NULL))
                lsf_window_capture(window, "window.png");
            if (lsf_ui_menu_item("Work", NULL, false, NULL))
                s->work = 20;
            lsf_ui_menu_end();
        }
        lsf_ui_menu_bar_end();
    }
    lsf_ui_panel_begin("panel", (lsf_rect){(float)input->width - PANEL, 40, PANEL, 200}, true);
    if (lsf_ui_slider("Level", &s->level, 0, 1, "%.2f", false))
        printf("level %g\n", (double)s->level);
    if (lsf_ui_check("Lamp", &s->lamp))
        printf("lamp %d\n", s->lamp);
    if (lsf_ui_choice("Shape", &s->shape, shapes, 2))
        printf("shape %s\n", shapes[s->shape]);
    lsf_ui_panel_end();
}

static bool frame_shell(void *user, lsf_window *window, const lsf_input *input, lsf_error *error)
{
    shell *s = user;
    static uint32_t width;
    lsf_error saved = {LSF_OK, ""};
    const char *path = lsf_window_captured(window, &saved);
    if (path)
        printf("saved %s%s\n", path, saved.message);
    if (input->width != width)
        printf("size %ux%u\n", input->width, input->height);
    width = input->width;
    tell(input);
    show_panel(s, window, input);
    fill(s);
    lsf_ui_draw_begin(LSF_UNDER_PANELS, NULL);
    lsf_ui_draw_picture(s->canvas.texture, (lsf_rect){0, 40, SIDE, SIDE});
    lsf_ui_draw_end();
    s->work -= s->work > 0;
    if (s->work == 1)
        printf("worked\n");
    lsf_window_rest(window, s->work > 0, 10.0);
    return !lsf_input_key(input, 'Q', LSF_CONTROL) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "asked to fail");
}

int main(int argc, char **argv)
{
    shell s = {.level = 1.0f};
    lsf_error error = {LSF_OK, ""};
    lsf_window_params params = {LSF_WINDOW_PARAMS_DEFAULTS};
    const lsf_window_client client = {&s, open_shell, close_shell, frame_shell};
    setvbuf(stdout, NULL, _IOLBF, 0);
    params.width = 320;
    params.height = 240;
    for (int i = 1; i + 1 < argc; i += 2)
        *(strcmp(argv[i], "record") == 0 ? &params.record : &params.replay) = argv[i + 1];
    if (!lsf_window_run(&params, &client, &error))
        fprintf(stderr, "%s\n", error.message);
    return (int)error.code;
}
