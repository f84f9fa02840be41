/* The functions of ui.h, each a call or a few of Dear ImGui. */
#include "window/reach.h"
#include "window/ui.h"
#include "window/ui_parts.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{
const ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;

float label_lines;
const char *list_name = ""; /* of the current list */
ImDrawList *list;

float em()
{
    return ImGui::GetFontSize();
}

/* Draws the label to the left where there is a column for labels; returns the name of the widget
 * itself. */
const char *begin_value(const char *label)
{
    static char hidden[160];
    if (label_lines <= 0.0f || strncmp(label, "##", 2) == 0) {
        ImGui::SetNextItemWidth(-1.0f);
        return label;
    }
    const char *end = strstr(label, "##");
    ImGui::AlignTextToFramePadding();
    float start = ImGui::GetCursorPosX();
    ImGui::PushClipRect(ImGui::GetCursorScreenPos(),
                        ImVec2(ImGui::GetCursorScreenPos().x + (label_lines - 0.4f) * em(),
                               ImGui::GetCursorScreenPos().y + 2.0f * em()),
                        true);
    ImGui::TextUnformatted(label, end);
    ImGui::PopClipRect();
    ImGui::SameLine(start + label_lines * em());
    ImGui::SetNextItemWidth(-1.0f);
    snprintf(hidden, sizeof hidden, "##%s", label);
    return hidden;
}

/* The numbers of a replay, as many as it gives. */
bool assign_numbers(const char *label, float *values, int count)
{
    const char *text = ui::assigned(label);
    for (int i = 0; text && i < count; i++) {
        char *end;
        values[i] = strtof(text, &end);
        text = *end ? end + 1 : end;
    }
    return text != nullptr;
}

float to_srgb(float x)
{
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float from_srgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}
} // namespace

/* --- measures --- */

float lsf_ui_em(void)
{
    return em();
}

float lsf_ui_line(void)
{
    return ImGui::GetFrameHeightWithSpacing();
}

float lsf_ui_text_width(const char *text)
{
    return ImGui::CalcTextSize(text).x;
}

/* --- panels --- */

void lsf_ui_panel_begin(const char *name, lsf_rect rect, bool scrolls)
{
    ImGui::SetNextWindowPos(ImVec2(rect.x, rect.y));
    ImGui::SetNextWindowSize(ImVec2(rect.width, rect.height));
    ImGui::Begin(
        name, nullptr,
        FIXED | ImGuiWindowFlags_NoBringToFrontOnFocus |
            (scrolls ? 0 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse));
}

void lsf_ui_panel_end(void)
{
    ImGui::End();
}

void lsf_ui_dialogue_begin(const char *title, float width_lines)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    float width = std::fmin(width_lines * em(), size.x - 2.0f * em());
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always,
                            ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0.0f), ImVec2(width, size.y - 2.0f * em()));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(1.3f * em(), 1.0f * em()));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6.0f);
    ImGui::SetNextWindowBgAlpha(1.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::Begin(title, nullptr, FIXED | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PopStyleVar(3);
}

void lsf_ui_dialogue_end(void)
{
    ImGui::End();
}

bool lsf_ui_menu_bar_begin(void)
{
    return ImGui::BeginMainMenuBar();
}

void lsf_ui_menu_bar_end(void)
{
    ImGui::EndMainMenuBar();
}

float lsf_ui_menu_height(void)
{
    return ImGui::GetFrameHeight();
}

bool lsf_ui_menu_begin(const char *label)
{
    bool open = ImGui::BeginMenu(label);
    /* For ui::note, the last item of an open menu is inside the menu: only a closed one is noted.
     */
    if (!open)
        ui::note(label);
    lsf_reach_note("menu", label, open);
    return open;
}

void lsf_ui_menu_end(void)
{
    ImGui::EndMenu();
}

bool lsf_ui_menu_item(const char *label, const char *shortcut, bool checked, const char *help)
{
    bool chosen = ui::note_used("menu item", label, ImGui::MenuItem(label, shortcut, checked));
    lsf_ui_help(help);
    return chosen;
}

void lsf_ui_tabs_begin(const char *name)
{
    ImGui::BeginTabBar(name);
}

void lsf_ui_tabs_end(void)
{
    ImGui::EndTabBar();
}

bool lsf_ui_tab_begin(const char *label, bool choose)
{
    return ui::note_used(
        "tab", label,
        ImGui::BeginTabItem(label, nullptr, choose ? ImGuiTabItemFlags_SetSelected : 0));
}

void lsf_ui_tab_end(void)
{
    ImGui::EndTabItem();
}

bool lsf_ui_section(const char *label, bool open_at_first)
{
    bool open = ImGui::CollapsingHeader(label, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ui::note_used("section", label, ImGui::IsItemToggledOpen());
    return open;
}

/* --- text --- */

void lsf_ui_text(lsf_ui_color color, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    ImGui::TextColoredV(ui::color(color), format, arguments);
    va_end(arguments);
}

void lsf_ui_text_wrapped(lsf_ui_color color, const char *text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, ui::color(color));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void lsf_ui_listing(const char *name, const char *text, float lines)
{
    ImGui::PushFont(ui::mono);
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    ImGui::BeginChild(name, ImVec2(0.0f, lines * em()), false,
                      ImGuiWindowFlags_HorizontalScrollbar |
                          ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::TextUnformatted(text);
    ImGui::EndChild();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void lsf_ui_help(const char *text)
{
    if (!text || !*text || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24.0f * em());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void lsf_ui_same_line(void)
{
    ImGui::SameLine();
}

void lsf_ui_at(float x_lines)
{
    ImGui::SameLine(x_lines * em());
}

void lsf_ui_gap(void)
{
    ImGui::Dummy(ImVec2(0.0f, 0.35f * em()));
}

void lsf_ui_rule(void)
{
    ImGui::Separator();
}

void lsf_ui_labels(float lines)
{
    label_lines = lines;
}

/* --- values --- */

bool lsf_ui_button(const char *label)
{
    return ui::note_used("button", label, ImGui::Button(label));
}

bool lsf_ui_check(const char *label, bool *value)
{
    return ui::note_used("check", label, ImGui::Checkbox(begin_value(label), value));
}

bool lsf_ui_slider(const char *label, float *value, float low, float high, const char *format,
                   bool logarithmic)
{
    bool changed = ImGui::SliderFloat(begin_value(label), value, low, high, format,
                                      (logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
    return ui::note_used("slider", label, assign_numbers(label, value, 1) || changed);
}

bool lsf_ui_slider_int(const char *label, int *value, int low, int high, const char *format,
                       bool logarithmic)
{
    bool changed = ImGui::SliderInt(begin_value(label), value, low, high, format ? format : "%d",
                                    (logarithmic ? ImGuiSliderFlags_Logarithmic : 0) |
                                        ImGuiSliderFlags_AlwaysClamp);
    float number;
    if (assign_numbers(label, &number, 1)) {
        *value = (int)number;
        changed = true;
    }
    return ui::note_used("slider", label, changed);
}

bool lsf_ui_drag(const char *label, float *values, int count, float speed, float low, float high,
                 const char *format)
{
    bool changed = ImGui::DragScalarN(begin_value(label), ImGuiDataType_Float, values, count, speed,
                                      &low, &high, format, 0);
    return ui::note_used("numbers", label, assign_numbers(label, values, count) || changed);
}

bool lsf_ui_color3(const char *label, float rgb[3])
{
    float shown[3] = {to_srgb(rgb[0]), to_srgb(rgb[1]), to_srgb(rgb[2])};
    bool changed = ImGui::ColorEdit3(begin_value(label), shown, ImGuiColorEditFlags_Uint8);
    if (changed)
        for (int i = 0; i < 3; i++)
            rgb[i] = from_srgb(shown[i]);
    return ui::note_used("colour", label, assign_numbers(label, rgb, 3) || changed);
}

bool lsf_ui_choice(const char *label, int *value, const char *const *names, int count)
{
    int before = *value;
    bool open =
        ImGui::BeginCombo(begin_value(label), *value >= 0 && *value < count ? names[*value] : "",
                          ImGuiComboFlags_HeightLarge);
    if (!open)
        ui::note(label);
    for (int i = 0; open && i < count; i++) {
        if (ImGui::Selectable(names[i], i == *value))
            *value = i;
        ui::note(names[i]);
    }
    if (open)
        ImGui::EndCombo();
    const char *text = ui::assigned(label);
    for (int i = 0; text && i < count; i++)
        if (strcmp(text, names[i]) == 0)
            *value = i;
    lsf_reach_note("choice", label, *value != before);
    return *value != before;
}

bool lsf_ui_row(const char *label, int depth, bool chosen, bool dim)
{
    float indent = (float)depth * 0.9f * em();
    if (indent > 0.0f)
        ImGui::Indent(indent);
    ImGui::PushStyleColor(ImGuiCol_Text, ui::color(dim ? LSF_UI_DIM : LSF_UI_TEXT));
    bool clicked = ImGui::Selectable(label, chosen);
    ImGui::PopStyleColor();
    ui::note(label);
    lsf_reach_note("row", list_name, clicked); /* one of a list stands for all */
    if (indent > 0.0f)
        ImGui::Unindent(indent);
    return clicked;
}

void lsf_ui_list_begin(const char *name, float lines)
{
    list_name = name;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.0f, 0.0f, 0.0f, 0.18f));
    ImGui::BeginChild(name, ImVec2(0.0f, lines * em()), false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleColor();
}

void lsf_ui_list_end(void)
{
    ImGui::EndChild();
}

void lsf_ui_disable_begin(bool disabled)
{
    ImGui::BeginDisabled(disabled);
}

void lsf_ui_disable_end(void)
{
    ImGui::EndDisabled();
}

void lsf_ui_scope_begin(int number)
{
    ImGui::PushID(number);
}

void lsf_ui_scope_end(void)
{
    ImGui::PopID();
}

/* --- drawing --- */

lsf_rect lsf_ui_area(float lines)
{
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, lines * em());
    ImGui::Dummy(size);
    return lsf_rect{corner.x, corner.y, size.x, size.y};
}

void lsf_ui_draw_begin(lsf_layer_place place, const lsf_rect *clip)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    list = place == LSF_UNDER_PANELS ? ImGui::GetBackgroundDrawList()
           : place == LSF_IN_PANEL   ? ImGui::GetWindowDrawList()
                                     : ImGui::GetForegroundDrawList();
    ImVec2 low(0.0f, 0.0f), high = size;
    if (clip) {
        low = ImVec2(clip->x, clip->y);
        high = ImVec2(clip->x + clip->width, clip->y + clip->height);
    }
    list->PushClipRect(low, high, place == LSF_IN_PANEL);
}

void lsf_ui_draw_end(void)
{
    list->PopClipRect();
    list = nullptr;
}

void lsf_ui_draw_rect(lsf_rect rect, uint32_t rgba, bool filled, float rounding)
{
    const ImVec2 low(rect.x, rect.y), high(rect.x + rect.width, rect.y + rect.height);
    if (filled)
        list->AddRectFilled(low, high, ui::packed(rgba), rounding);
    else
        list->AddRect(low, high, ui::packed(rgba), rounding);
}

void lsf_ui_draw_line(float x0, float y0, float x1, float y1, uint32_t rgba, float width)
{
    list->AddLine(ImVec2(x0, y0), ImVec2(x1, y1), ui::packed(rgba), width);
}

void lsf_ui_draw_circle(float x, float y, float radius, uint32_t rgba, bool filled)
{
    if (filled)
        list->AddCircleFilled(ImVec2(x, y), radius, ui::packed(rgba));
    else
        list->AddCircle(ImVec2(x, y), radius, ui::packed(rgba), 0, 2.0f);
}

void lsf_ui_draw_triangle(const float xy[6], uint32_t rgba)
{
    list->AddTriangleFilled(ImVec2(xy[0], xy[1]), ImVec2(xy[2], xy[3]), ImVec2(xy[4], xy[5]),
                            ui::packed(rgba));
}

void lsf_ui_draw_text(float x, float y, uint32_t rgba, const char *text)
{
    list->AddText(ImVec2(x, y), ui::packed(rgba), text);
}

void lsf_ui_draw_picture(uint32_t texture, lsf_rect rect)
{
    list->AddImage((ImTextureID)(intptr_t)texture, ImVec2(rect.x, rect.y),
                   ImVec2(rect.x + rect.width, rect.y + rect.height), ImVec2(0.0f, 1.0f),
                   ImVec2(1.0f, 0.0f));
}
