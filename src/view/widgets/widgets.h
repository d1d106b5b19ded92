#pragma once
// Draws panel widgets that ImGui lacks.

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "render/renderer.h"
#include "view/widgets/look.h"

namespace defocus::engine {

// Draws a header that expands and collapses a section. Returns whether the section is expanded.
bool section(const char* title, bool openAtFirst);

// Begins a row: draws the label on the left; the next widget fills the rest of the row.
void rowLabel(const std::string& label, const std::string& tooltip = {});
void textRow(const char* label, const std::string& text, const char* tooltip = "");
// Draws a tooltip while the mouse is over the previous widget.
void tooltip(const std::string& text);

// Draws a combo box. Returns whether the user chose a name.
bool combo(const char* id, const std::vector<std::string>& names, std::string& chosen);

// Draws a combo box for an enum. `names`: names of the values in order, each ended by a null character.
template <typename Enum>
bool enumCombo(const char* id, Enum& value, const char* names) {
    int index = static_cast<int>(value);
    if (!ImGui::Combo(id, &index, names)) return false;
    value = static_cast<Enum>(index);
    return true;
}

bool slider(const char* id, double& value, double min, double max, const char* format, ImGuiSliderFlags flags = 0);
bool slider(const char* id, std::uint32_t& value, std::uint32_t min, std::uint32_t max, ImGuiSliderFlags flags = 0);

// Draws a text field with a button on its right. Returns true if the user presses the button, or Enter in the field.
bool pathRow(const char* id, const char* hint, const char* button, std::string& path);

// Centres the next modal dialog in the window and limits it to the window's size. `height` 0: fit the contents.
void centreDialog(float width, float height = 0);

// Window positions of widgets, by name.
using Places = std::map<std::string, std::array<long, 2>>;

// Records the window position of the previous widget's centre under a name, unless the widget is scrolled out of sight.
// Scripts read these positions from the state file (docs/window.md).
void notePlace(const std::string& name);
// Returns the widget positions recorded since the last call.
Places takePlaces();

// Draws a ring of standard f-numbers; drag, wheel and click change `fStop`.
void stopRing(double& fStop, float scale);

// Draws the aperture's shape with the first lens samples as points.
void aperturePreview(const Lens& lens, float scale);

// Draws a side view of the scene: blur over depth, the range of depths in focus, and the depth ranges of objects.
void depthDiagram(const FramePlan& plan, float scale);

// Draws a stacked bar with a legend, and a mark at `budget` ms.
void timeBar(std::span<const PassTime> parts, double budget, float scale);

}  // namespace defocus::engine
