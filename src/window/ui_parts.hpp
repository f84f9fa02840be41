/* Declarations that ui.cpp and widgets.cpp share. */
#ifndef LSF_WINDOW_UI_PARTS_HPP
#define LSF_WINDOW_UI_PARTS_HPP

#include <imgui.h>

#include "window/ui.h"

namespace ui
{
extern ImFont *plain, *mono;

/* Tells a replay where the item is that was just drawn; scrolls to it where the replay looks for
 * it and it is out of sight. */
void note(const char *label);
/* The same for an item that the user may use, and has just `used`, which it returns. */
bool note_used(const char *kind, const char *label, bool used);

/* The value that a replay sets of this label, taken by the call; nullptr: none. */
const char *assigned(const char *label);

ImU32 packed(uint32_t rgba);
ImVec4 color(lsf_ui_color color);
} // namespace ui

#endif
