#pragma once
// The widgets of the panel that ImGui doesn't have: an aperture ring, the aperture's shape, blur over depth, times.

#include <imgui.h>

#include <map>
#include <span>
#include <string>
#include <vector>

#include "plan/frame_plan.h"
#include "view/interface.h"

namespace defocus {

// A header that opens and closes what follows: whether it is open.
bool section(const char* title, bool open);
// A combo over names; the chosen place, or −1.
int combo(const char* id, const std::vector<std::string>& names, const std::string& current);
// A label on the left; the widget that follows takes the rest of the row.
void rowLabel(const char* label, const char* tooltip = nullptr);
void tooltip(const std::string& text);
// A text field with a button at its right. True when it is pressed, or Enter in the field.
bool pathRow(const char* id, const char* hint, const char* button, std::string& path);

// Tells where the middle of the widget before it lies, for the state that scripts read (docs/window.md); nothing of one
// that is scrolled out of sight.
void notePlace(const std::string& name);
// Those of the frame, in window units; begins anew.
std::map<std::string, ImVec2> takePlaces();

// A ring of standard stops to turn (drag, wheel) or click. True when `fStop` was changed.
bool stopRing(double& fStop, const InterfaceColors& colors, float scale);

// Points on the aperture, as the lens samples lie.
void aperturePreview(const Lens& lens, float scale);

// From the side: blur over depth, what is in focus, and the objects of the plan.
void depthDiagram(const FramePlan& plan, const InterfaceColors& colors, float scale);

struct BarPart {
    std::string name;
    double milliseconds = 0;
};
// A stacked bar with its legend; `budget` is marked.
void timeBar(std::span<const BarPart> parts, double budget, const InterfaceColors& colors, float scale);
void timeGraph(const std::vector<float>& milliseconds, double budget, const InterfaceColors& colors, float scale);

}  // namespace defocus
