// Draws the colour scales of overlays, and a tooltip on how the object under the cursor is drawn.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "image/colour_map.h"
#include "view/hud/hud.h"

namespace defocus::engine {

namespace {

constexpr double hoverDelay = 0.12;  // seconds without mouse movement before picking

struct Legend {
    const char* title;
    const char* shortTitle;            // shorter title for narrow images
    glm::vec3 (*colour)(float);        // maps a position on the scale in [0, 1] to a linear colour
    std::array<const char*, 5> marks;  // labels of the scale, evenly spaced
};

// Returns the colour of the blur overlay at the position `t` of its scale, 0 … 1; 0.5 is in focus. Must match
// shaders/view/display.frag.
glm::vec3 cocColour(float t) {
    const float side = 2 * t - 1;
    const glm::vec3 colour = side < 0 ? glm::vec3(1, 0.55f, 0.10f) : glm::vec3(0.2f, 0.55f, 1);
    const glm::vec3 encoded = glm::mix(glm::vec3(0.6f), colour, glm::smoothstep(0.0f, 0.5f, std::abs(side)));
    return {srgbDecode(encoded.r), srgbDecode(encoded.g), srgbDecode(encoded.b)};
}

std::optional<Legend> legendOf(const DisplaySettings& display) {
    switch (display.overlay) {
        case DisplayOverlay::coc:
            return Legend{
                "blur in px: in front of | behind the focus", "blur, px", cocColour, {"63", "7", "0", "7", "63"}};
        case DisplayOverlay::work:
            return Legend{"triangles per pixel per lens sample", "triangles", magma, {"0", "1", "3", "7", "15 +"}};
        case DisplayOverlay::level:
            break;
        case DisplayOverlay::none:
            if (!display.wireframe) return std::nullopt;
    }
    return Legend{"level of detail", "level", viridis, {"0", "2", "4", "6", "8 +"}};
}

void drawColourScale(const Legend& legend, const ImVec2& at, const ImVec2& size) {
    constexpr int steps = 95;
    for (int i = 0; i < steps; ++i) {
        glm::vec3 color = legend.colour((static_cast<float>(i) + 0.5f) / steps);
        for (int c = 0; c < 3; ++c) color[c] = srgbEncode(color[c]);
        const float left = at.x + size.x * static_cast<float>(i) / steps;
        const float right = at.x + size.x * static_cast<float>(i + 1) / steps;
        ImGui::GetBackgroundDrawList()->AddRectFilled({std::floor(left), at.y}, {std::floor(right), at.y + size.y},
                                                      ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1}));
    }
}

std::string hoverText(const ObjectPlan& object, const FramePlan& plan, double depth) {
    std::string text = fmt::format("{}\ndistance {}, blur {:.1f} px\nlevel λ {:.2f}", object.name, distanceText(depth),
                                   std::abs(circleOfConfusion(plan.coc, depth, plan.view.width)), object.lambda);
    for (const LevelDraw& draw : {object.coarse, object.fine})
        if (draw.sampleCount > 0)
            text +=
                fmt::format("\n{} samples at level {}: {} triangles", draw.sampleCount, draw.level, draw.triangleCount);
    return text;
}

}  // namespace

void drawLegend(const Ui& ui, const ImVec2& status) {
    const std::optional<Legend> legend = legendOf(ui.state.display);
    if (!legend) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float s = ui.scale;
    const float pad = 9 * s;
    const float line = ImGui::GetFontSize();
    const float room = static_cast<float>(ui.state.area.size.x) - 16 * s - 2 * pad;
    const float wanted = std::max(190 * s, ImGui::CalcTextSize(legend->title).x);
    const char* title = wanted <= room ? legend->title : legend->shortTitle;
    const ImVec2 size(std::min(room, wanted), 10 * s);
    ImVec2 end = pictureCorner(ui, 1, 1);
    if (end.x - size.x - 2 * pad - 16 * s < status.x) end.y = status.y;  // there is no space beside the status labels
    const ImVec2 at(end.x - size.x - 8 * s - pad, end.y - 8 * s - pad - line - 4 * s - size.y);
    list.AddRectFilled({at.x - pad, at.y - line - 5 * s - pad}, {end.x - 8 * s, end.y - 8 * s}, plateColor, 4 * s);
    list.AddText({at.x, at.y - line - 5 * s}, brightColor, title);
    drawColourScale(*legend, at, size);
    for (std::size_t i = 0; i < legend->marks.size(); ++i) {
        const float share = static_cast<float>(i) / (legend->marks.size() - 1);
        const float width = ImGui::CalcTextSize(legend->marks[i]).x;
        list.AddText({at.x + share * (size.x - width), at.y + size.y + 3 * s}, dimColor, legend->marks[i]);
    }
}

void drawHover(const Ui& ui) {
    const ViewState& state = ui.state;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::dvec2 position(mouse.x, mouse.y);
    const bool wanted = state.display.overlay != DisplayOverlay::none || state.display.wireframe;
    if (!wanted || ImGui::GetIO().WantCaptureMouse || !state.area.contains(position)) return;
    // Picking is slow in large scenes: pick once per mouse position, after the mouse has rested.
    static glm::dvec2 pickedAt(-1);
    static std::optional<PickedSurface> picked;
    static double restsSince = 0;
    static bool known = false;
    if (position != pickedAt) {
        pickedAt = position;
        restsSince = state.now;
        known = false;
    }
    if (state.now - restsSince < hoverDelay) return;
    if (!known) picked = pickedSurface(*ui.document.frame, state.camera, state.lens, state.area, position);
    known = true;
    if (!picked) return;
    const FramePlan& plan = ui.picture.image->plan();
    const auto object = std::ranges::find(plan.objects, picked->object, &ObjectPlan::object);
    if (object == plan.objects.end()) return;
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(hoverText(*object, plan, picked->depth).c_str());
    ImGui::EndTooltip();
}

}  // namespace defocus::engine
