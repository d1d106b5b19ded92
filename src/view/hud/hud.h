#pragma once
// Draws the heads-up display: labels, markers and messages over the image.

#include "view/widgets/ui.h"

namespace defocus::engine {

void drawHud(const Ui& ui);

inline constexpr ImU32 plateColor = IM_COL32(12, 12, 12, 190);
inline constexpr ImU32 brightColor = IM_COL32(240, 240, 240, 255);
inline constexpr ImU32 dimColor = IM_COL32(190, 190, 190, 255);
inline constexpr ImU32 warningColor = IM_COL32(255, 198, 92, 255);
inline constexpr ImU32 faultColor = IM_COL32(255, 120, 105, 255);

// Converts a position in the image, x and y in [0, 1] from the top left, to a window position.
ImVec2 pictureCorner(const Ui& ui, double x, double y);

struct LabelStyle {
    ImU32 color = brightColor;
    // Point of the label that lies at the given position; 0: left or top, 1: right or bottom.
    float anchorX = 0, anchorY = 0;
    float alpha = 1;
    float width = 0;  // max width of wrapped text; 0: no wrapping
};

// Draws text on a dark background plate. Returns the size of the plate.
ImVec2 drawLabel(const Ui& ui, ImVec2 at, const std::string& text, const LabelStyle& style = {});

// Returns the width of a label's plate, without wrapping.
float labelWidth(const Ui& ui, const std::string& text);

std::string distanceText(double metres);

// Draws messages, progress and the list of keyboard shortcuts.
void drawNotices(const Ui& ui);

// Draws the colour scale of the current overlay. `status`: top right corner of the status labels at the bottom left.
void drawLegend(const Ui& ui, const ImVec2& status);

// Draws a tooltip that explains how the object under the cursor is drawn.
void drawHover(const Ui& ui);

}  // namespace defocus::engine
