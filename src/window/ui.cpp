/* The look of panels, and a frame of them: Dear ImGui with the input of lsf_input. */
#include "window/reach.h"
#include "window/ui_frame.h"
#include "window/ui_parts.hpp"

#include <backends/imgui_impl_opengl3.h>
#include <cstdio>
#include <cstring>
#include <strings.h>
#include <unistd.h>

namespace ui
{
ImFont *plain, *mono;
}

namespace
{
enum { MOST_NOTES = 1024, LABEL_SIZE = 128 };

const float TEXT_PIXELS = 15.0f; /* on a screen of usual density */

float scale;

/* Positions of labelled things in the last frame and in this one. */
struct Note {
    char label[LABEL_SIZE];
    float x, y;
};
Note notes[2][MOST_NOTES];
int note_count[2], current;
char wanted[LABEL_SIZE];
char assigned_label[LABEL_SIZE], assigned_value[LABEL_SIZE];

const uint32_t colors[LSF_UI_COLOR_COUNT] = {
    0xe3e5e8ff, /* text */
    0x8d939cff, /* dim */
    0xe8b04bff, /* accent */
    0xf0c060ff, /* warning */
    0xf07a6aff, /* error */
    0x1b1d21f7, /* background */
    0xe5534bff, /* red */
    0x57b55cff, /* green */
    0x4c8df0ff, /* blue */
};

/* The part of a label that is shown. */
size_t shown_length(const char *label)
{
    const char *hidden = strstr(label, "##");
    size_t length = hidden ? (size_t)(hidden - label) : strlen(label);
    return length < LABEL_SIZE - 1 ? length : LABEL_SIZE - 1;
}

bool same(const char *label, const char *name)
{
    size_t length = shown_length(label);
    if (length == 0) /* nothing of it is shown */
        return strcmp(label, name) == 0;
    return strlen(name) == length && strncmp(label, name, length) == 0;
}

void set_style()
{
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.ChildRounding = 0.0f;
    style.PopupRounding = style.FrameRounding = style.GrabRounding = style.TabRounding = 3.0f;
    style.ScrollbarRounding = 6.0f;
    style.WindowBorderSize = style.FrameBorderSize = style.ChildBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.WindowPadding = ImVec2(10.0f, 8.0f);
    style.FramePadding = ImVec2(7.0f, 3.0f);
    style.ItemSpacing = ImVec2(7.0f, 5.0f);
    style.ItemInnerSpacing = ImVec2(6.0f, 4.0f);
    style.ScrollbarSize = 11.0f;
    style.GrabMinSize = 9.0f;
    style.IndentSpacing = 14.0f;
    const struct {
        ImGuiCol which;
        uint32_t rgba;
    } rows[] = {
        {ImGuiCol_Text, colors[LSF_UI_TEXT]},
        {ImGuiCol_TextDisabled, colors[LSF_UI_DIM]},
        {ImGuiCol_WindowBg, colors[LSF_UI_BACKGROUND]},
        {ImGuiCol_ChildBg, 0x00000000},
        {ImGuiCol_PopupBg, 0x24272cff},
        {ImGuiCol_Border, 0x3a3f47ff},
        {ImGuiCol_FrameBg, 0x2a2e34ff},
        {ImGuiCol_FrameBgHovered, 0x353a42ff},
        {ImGuiCol_FrameBgActive, 0x3d434cff},
        {ImGuiCol_MenuBarBg, 0x1b1d21ff},
        {ImGuiCol_ScrollbarBg, 0x00000000},
        {ImGuiCol_ScrollbarGrab, 0x3d434cff},
        {ImGuiCol_ScrollbarGrabHovered, 0x4b525dff},
        {ImGuiCol_ScrollbarGrabActive, 0x5a626fff},
        {ImGuiCol_CheckMark, colors[LSF_UI_ACCENT]},
        {ImGuiCol_SliderGrab, 0xb98f45ff},
        {ImGuiCol_SliderGrabActive, colors[LSF_UI_ACCENT]},
        {ImGuiCol_Button, 0x31363eff},
        {ImGuiCol_ButtonHovered, 0x3f4650ff},
        {ImGuiCol_ButtonActive, 0x4b535fff},
        {ImGuiCol_Header, 0x2a2e34ff},
        {ImGuiCol_HeaderHovered, 0x373c45ff},
        {ImGuiCol_HeaderActive, 0x434a55ff},
        {ImGuiCol_Separator, 0x32363dff},
        {ImGuiCol_Tab, 0x1b1d21ff},
        {ImGuiCol_TabHovered, 0x3f4650ff},
        {ImGuiCol_TabActive, 0x31363eff},
        {ImGuiCol_TabUnfocused, 0x1b1d21ff},
        {ImGuiCol_TabUnfocusedActive, 0x31363eff},
        {ImGuiCol_TextSelectedBg, 0x6b5526ff},
        {ImGuiCol_ModalWindowDimBg, 0x00000080},
    };
    for (const auto &row : rows)
        style.Colors[row.which] = ImGui::ColorConvertU32ToFloat4(ui::packed(row.rgba));
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

/* The first of these files that is there; nullptr: the font that comes with Dear ImGui. */
ImFont *add_font(const char *const *paths, float pixels)
{
    static const ImWchar ranges[] = {0x20,   0xff,   0x2010, 0x2027, 0x2190, 0x2199,
                                     0x25a0, 0x25ff, 0x23f8, 0x23f8, 0};
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    for (; *paths; paths++)
        if (access(*paths, R_OK) == 0)
            return atlas->AddFontFromFileTTF(*paths, pixels, nullptr, ranges);
    ImFontConfig config;
    config.SizePixels = pixels < 20.0f ? 13.0f : 26.0f;
    return atlas->AddFontDefault(&config);
}

void build_fonts()
{
    static const char *const sans[] = {
        "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
        "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
        "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
        "/usr/share/fonts/TTF/DejaVuSans.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
        nullptr};
    static const char *const fixed[] = {
        "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf",
        "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
        "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf",
        "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf", nullptr};
    ImGui::GetIO().Fonts->Clear();
    ui::plain = add_font(sans, (float)(int)(TEXT_PIXELS * scale + 0.5f));
    ui::mono = add_font(fixed, (float)(int)(0.9f * TEXT_PIXELS * scale + 0.5f));
}

/* Keys that text fields use. */
void map_keys(ImGuiIO &io)
{
    const struct {
        ImGuiKey_ which;
        int key;
    } rows[] = {
        {ImGuiKey_Tab, LSF_KEY_TAB},
        {ImGuiKey_LeftArrow, LSF_KEY_LEFT},
        {ImGuiKey_RightArrow, LSF_KEY_RIGHT},
        {ImGuiKey_UpArrow, LSF_KEY_UP},
        {ImGuiKey_DownArrow, LSF_KEY_DOWN},
        {ImGuiKey_PageUp, LSF_KEY_PAGE_UP},
        {ImGuiKey_PageDown, LSF_KEY_PAGE_DOWN},
        {ImGuiKey_Home, LSF_KEY_HOME},
        {ImGuiKey_End, LSF_KEY_END},
        {ImGuiKey_Delete, LSF_KEY_DELETE},
        {ImGuiKey_Backspace, LSF_KEY_BACKSPACE},
        {ImGuiKey_Enter, LSF_KEY_ENTER},
        {ImGuiKey_KeyPadEnter, LSF_KEY_PAD_ENTER},
        {ImGuiKey_Escape, LSF_KEY_ESCAPE},
        {ImGuiKey_A, 'A'},
        {ImGuiKey_C, 'C'},
        {ImGuiKey_V, 'V'},
        {ImGuiKey_X, 'X'},
        {ImGuiKey_Y, 'Y'},
        {ImGuiKey_Z, 'Z'},
    };
    for (const auto &row : rows)
        io.KeyMap[row.which] = row.key;
}
} // namespace

/* --- functions for widgets.cpp --- */

ImU32 ui::packed(uint32_t rgba)
{
    return IM_COL32(rgba >> 24 & 255, rgba >> 16 & 255, rgba >> 8 & 255, rgba & 255);
}

ImVec4 ui::color(lsf_ui_color color)
{
    return ImGui::ColorConvertU32ToFloat4(packed(colors[color]));
}

static void mark(const char *label, float x, float y)
{
    int &count = note_count[current];
    if (count == MOST_NOTES)
        return;
    Note &note = notes[current][count++];
    memcpy(note.label, label, shown_length(label));
    note.label[shown_length(label)] = '\0';
    note.x = x;
    note.y = y;
}

void ui::note(const char *label)
{
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const ImVec2 middle(0.5f * (low.x + high.x), 0.5f * (low.y + high.y));
    if (ImGui::IsRectVisible(middle, ImVec2(middle.x + 1.0f, middle.y + 1.0f)))
        mark(label, middle.x, middle.y);
    else if (wanted[0] && same(label, wanted))
        ImGui::SetScrollHereY(0.5f);
}

bool ui::note_used(const char *kind, const char *label, bool used)
{
    note(label);
    lsf_reach_note(kind, label, used);
    return used;
}

const char *ui::assigned(const char *label)
{
    if (!assigned_label[0] || !same(label, assigned_label))
        return nullptr;
    assigned_label[0] = '\0';
    return assigned_value;
}

uint32_t lsf_ui_rgba(lsf_ui_color color)
{
    return colors[color];
}

void lsf_ui_mark(const char *label, float x, float y, bool held)
{
    mark(label, x, y);
    lsf_reach_note("handle", label, held);
}

/* --- functions for window.c --- */

bool lsf_ui_open(float wanted_scale)
{
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendPlatformName = "lightsheaf";
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    map_keys(io);
    scale = 0.0f;
    bool good = ImGui_ImplOpenGL3_Init("#version 450");
    lsf_ui_set_scale(wanted_scale);
    return good;
}

void lsf_ui_close(void)
{
    if (!ImGui::GetCurrentContext())
        return;
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void lsf_ui_set_scale(float wanted_scale)
{
    if (wanted_scale == scale)
        return;
    bool again = scale > 0.0f;
    scale = wanted_scale;
    set_style();
    build_fonts();
    if (again) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
}

void lsf_ui_begin(const lsf_input *input, const bool buttons[LSF_BUTTON_COUNT], double scroll,
                  const uint32_t *characters, uint32_t character_count)
{
    ImGuiIO &io = ImGui::GetIO();
    io.DisplaySize = ImVec2((float)input->width, (float)input->height);
    io.DeltaTime = input->step > 1e-4 ? (float)input->step : 1e-4f;
    io.MousePos = ImVec2((float)input->x, (float)input->y);
    for (int i = 0; i < LSF_BUTTON_COUNT; i++)
        io.MouseDown[i] = buttons[i];
    io.MouseWheel = (float)scroll;
    for (int i = 0; i < LSF_KEY_LIMIT; i++)
        io.KeysDown[i] = input->held[i];
    io.KeyShift = input->modifiers & LSF_SHIFT;
    io.KeyCtrl = input->modifiers & LSF_CONTROL;
    io.KeyAlt = input->modifiers & LSF_ALT;
    for (uint32_t i = 0; i < character_count; i++)
        io.AddInputCharacter(characters[i]);
    current = !current;
    note_count[current] = 0;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
}

bool lsf_ui_takes_cursor(void)
{
    return ImGui::GetIO().WantCaptureMouse;
}

bool lsf_ui_takes_keys(void)
{
    return ImGui::GetIO().WantTextInput;
}

void lsf_ui_end(void)
{
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

int lsf_ui_cursor(void)
{
    switch (ImGui::GetMouseCursor()) {
    case ImGuiMouseCursor_TextInput:
        return 1;
    case ImGuiMouseCursor_ResizeEW:
        return 2;
    case ImGuiMouseCursor_ResizeNS:
        return 3;
    case ImGuiMouseCursor_Hand:
        return 4;
    default:
        return 0;
    }
}

/* --- a replay --- */

bool lsf_ui_find(const char *label, double *x, double *y)
{
    snprintf(wanted, sizeof wanted, "%s", label);
    for (int i = 0; i < note_count[current]; i++)
        if (strcmp(notes[current][i].label, label) == 0) {
            *x = (double)notes[current][i].x;
            *y = (double)notes[current][i].y;
            wanted[0] = '\0';
            return true;
        }
    return false;
}

void lsf_ui_assign(const char *assignment)
{
    const char *equals = strstr(assignment, " = ");
    size_t length = equals ? (size_t)(equals - assignment) : strlen(assignment);
    snprintf(assigned_label, sizeof assigned_label, "%.*s", (int)length, assignment);
    snprintf(assigned_value, sizeof assigned_value, "%s", equals ? equals + 3 : "");
}

bool lsf_ui_assigned(void)
{
    return assigned_label[0] == '\0';
}
