#pragma once
// Widgets of the panel that ImGui lacks.

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "render/renderer.h"
#include "view/widgets/look.h"

namespace defocus::engine {

// Draws a header that opens and closes a section. Returns whether it is open.
bool section(const char* title, bool openAtFirst);

// Starts a row: the label on the left, the next widget in the rest of the row.
void rowLabel(const std::string& label, const std::string& tooltip = {});
// Draws a row of text.
void textRow(const char* label, const std::string& text, const char* tooltip = "");
// Draws the tooltip of the previous widget.
void tooltip(const std::string& text);

// Draws a combo box. Returns whether a name was chosen.
bool combo(const char* id, const std::vector<std::string>& names, std::string& chosen);

// Draws a combo box over the values of an enum. `names`: in order, each ended by a null character.
template <typename Enum>
bool enumCombo(const char* id, Enum& value, const char* names) {
    int index = static_cast<int>(value);
    if (!ImGui::Combo(id, &index, names)) return false;
    value = static_cast<Enum>(index);
    return true;
}

bool slider(const char* id, double& value, double min, double max, const char* format, ImGuiSliderFlags flags = 0);
bool slider(const char* id, std::uint32_t& value, std::uint32_t min, std::uint32_t max, ImGuiSliderFlags flags = 0);

// Draws a text field with a button on its right. Returns true if the button is pressed, or Enter in the field.
bool pathRow(const char* id, const char* hint, const char* button, std::string& path);

// Opens the next modal dialog in the middle of the window, no larger than it; height 0: fits the content.
void centreDialog(float width, float height = 0);

// Window positions of widgets by name.
using Places = std::map<std::string, std::array<long, 2>>;

// Notes the centre of the previous widget under a name, unless it is scrolled out of sight. Scripts read the positions
// from the state (docs/window.md).
void notePlace(const std::string& name);
// Returns the positions noted since the last call.
Places takePlaces();

// Draws a ring of standard stops: drag, wheel and click change `fStop`.
void stopRing(double& fStop, float scale);

// Draws the first lens samples as points in the aperture.
void aperturePreview(const Lens& lens, float scale);

// Draws a side view: blur over depth, the depths in focus, and the depths of the objects.
void depthDiagram(const FramePlan& plan, float scale);

// Draws a stacked bar with its legend and a mark at `budget` ms.
void timeBar(std::span<const PassTime> parts, double budget, float scale);

}  // namespace defocus::engine
