#pragma once
// The widgets of the panel that ImGui doesn't have: an aperture ring, the aperture's shape, blur over depth, times.

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

#include "app/view_interface.h"
#include "lens/lens_fields.h"
#include "plan/frame_plan.h"

namespace defocus {

// A label on the left; the widget that follows takes the rest of the row.
void rowLabel(const char* label, const char* tooltip = nullptr);
void tooltip(const std::string& text);

// A ring of standard stops to turn (drag, wheel) or click. True when `fStop` was changed.
bool stopRing(double& fStop, const InterfaceColors& colors, float scale);

// A row for a field of the table. True when the lens was changed; it stays possible (checkLens).
bool lensFieldRow(Lens& lens, const LensField& field);

// "Blade rotation" of "bladeRotation".
std::string fieldLabel(std::string_view name);

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
