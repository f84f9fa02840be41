/* The tab that compares, the half of the split picture, and the bar between. */
#include "view/app.h"

#include "base/base.h"

#include <math.h>

#define NEAR_BAR 6.0 /* pixels on a screen of usual density */

static const lsf_canvas *other_canvas(const lsf_viewer *viewer)
{
    const lsf_viewer_compare *compare = &viewer->compare;
    if (compare->rival == LSF_VIEWER_ALONE || viewer->moving)
        return NULL;
    bool there =
        compare->rival == LSF_VIEWER_REFERENCE ? compare->traced > 0 : compare->picture.done > 0;
    const lsf_canvas *canvas =
        compare->difference && compare->measured ? &compare->apart : &compare->picture.canvas;
    return there && canvas->texture ? canvas : NULL;
}

static float bar_at(const lsf_viewer *viewer)
{
    return floorf(viewer->area.x + viewer->compare.split * viewer->area.width);
}

void lsf_viewer_draw_rival(const lsf_viewer *viewer)
{
    const lsf_canvas *canvas = other_canvas(viewer);
    const lsf_rect *area = &viewer->area;
    if (!canvas)
        return;
    float x = bar_at(viewer), em = lsf_ui_em();
    const lsf_rect half = {x, area->y, area->x + area->width - x, area->height};
    lsf_ui_draw_begin(LSF_UNDER_PANELS, &half);
    lsf_ui_draw_picture(canvas->texture, *area);
    lsf_ui_draw_end();
    lsf_ui_draw_begin(LSF_UNDER_PANELS, area);
    lsf_ui_draw_line(x, area->y, x, area->y + area->height, 0xffffffc0, 2.0f);
    lsf_ui_draw_circle(x, area->y + 0.5f * area->height, 0.5f * em, 0xffffffe0, true);
    lsf_ui_mark("split bar", x, area->y + 0.5f * area->height, viewer->compare.dragging);
    const char *name =
        viewer->compare.difference ? "difference"
        : viewer->compare.rival == LSF_VIEWER_REFERENCE
            ? "path tracer"
            : lsf_technique_name((uint32_t)(viewer->compare.rival - LSF_VIEWER_TECHNIQUE));
    lsf_ui_draw_rect((lsf_rect){x + 0.6f * em, area->y + 0.5f * em,
                                lsf_ui_text_width(name) + 1.0f * em, 1.5f * em},
                     0x000000a0, true, 4.0f);
    lsf_ui_draw_text(x + 1.1f * em, area->y + 0.7f * em, 0xffffffff, name);
    lsf_ui_draw_end();
}

bool lsf_viewer_drag_bar(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    const lsf_input *input = viewer->input;
    bool near = other_canvas(viewer) &&
                fabs(input->x - (double)bar_at(viewer)) < NEAR_BAR * (double)input->scale;
    if (input->pressed[LSF_BUTTON_LEFT] && near)
        compare->dragging = true;
    if (compare->dragging && viewer->area.width > 0.0f)
        compare->split =
            fminf(1.0f, fmaxf(0.0f, ((float)input->x - viewer->area.x) / viewer->area.width));
    bool dragged = compare->dragging;
    if (!input->down[LSF_BUTTON_LEFT] || input->released[LSF_BUTTON_LEFT])
        compare->dragging = false;
    return dragged;
}

static void numbers(const lsf_compare_result *r)
{
    static const char *const names[] = {"red", "green", "blue"};
    lsf_ui_text(LSF_UI_TEXT, "RMSE / mean");
    lsf_ui_at(10.0f);
    lsf_ui_text(LSF_UI_DIM, "%.3f %%", 100.0 * r->rmse_relative);
    lsf_ui_text(LSF_UI_TEXT, "relMSE");
    lsf_ui_at(10.0f);
    lsf_ui_text(LSF_UI_DIM, "%.3g", r->relmse);
    for (int i = 0; i < 3; i++) {
        lsf_ui_text(LSF_UI_TEXT, "bias, %s", names[i]);
        lsf_ui_at(10.0f);
        lsf_ui_text(LSF_UI_DIM, "%+.3f %%", 100.0 * r->bias[i]);
    }
    lsf_ui_text(LSF_UI_TEXT, "SSIM");
    lsf_ui_at(10.0f);
    lsf_ui_text(LSF_UI_DIM, "%.4f", r->ssim);
    lsf_ui_text(LSF_UI_TEXT, "PSNR");
    lsf_ui_at(10.0f);
    lsf_ui_text(LSF_UI_DIM, "%.1f dB", r->psnr);
}

void lsf_viewer_compare_tab(lsf_viewer *viewer)
{
    lsf_viewer_compare *compare = &viewer->compare;
    static const char *names[12] = {"nothing", "the path tracer"};
    int count = LSF_VIEWER_TECHNIQUE, rival = compare->rival;
    for (; count < 12 && lsf_technique_name((uint32_t)(count - LSF_VIEWER_TECHNIQUE)); count++)
        names[count] = lsf_technique_name((uint32_t)(count - LSF_VIEWER_TECHNIQUE));
    lsf_ui_gap();
    if (lsf_ui_choice("Beside", &rival, names, count)) {
        lsf_viewer_drop_rival(viewer);
        compare->rival = rival;
    }
    lsf_ui_help(
        "Other half of the picture; drag the bar between them. The path tracer runs on the CPU in "
        "parallel, with the same bounces and iterations");
    if (rival == LSF_VIEWER_ALONE)
        return;
    lsf_ui_check("Difference", &compare->difference);
    lsf_ui_help("Shows the difference of the two in the other half");
    if (lsf_ui_slider("Gain", &compare->gain, 0.25f, 64.0f, "%.2f", true))
        compare->measured = false;
    lsf_ui_gap();
    if (compare->picture.error.code != LSF_OK)
        lsf_ui_text_wrapped(LSF_UI_ERROR, compare->picture.error.message);
    else if (rival == LSF_VIEWER_REFERENCE)
        lsf_ui_text(LSF_UI_DIM, "%u of %u samples%s", compare->traced, viewer->settings.samples,
                    compare->tracer ? ", tracing more" : "");
    else
        lsf_ui_text(LSF_UI_DIM, "%u of %u iterations", compare->picture.done,
                    viewer->settings.samples);
    lsf_ui_gap();
    if (compare->measured)
        numbers(&compare->result);
    else
        lsf_ui_text(LSF_UI_DIM, "Numbers appear when both are finished");
}
