// Draws the panel's diagrams: aperture ring, aperture shape, blur over depth, frame times.

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lens/lens_samples.h"
#include "view/state/photographic_stops.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

ImU32 color(ImGuiCol index, float alpha = 1) {
    return ImGui::GetColorU32(index, alpha);
}

struct Canvas {
    ImDrawList& list;
    ImVec2 origin, end;  // top left and bottom right corner of the drawing area
    [[nodiscard]] float width() const { return end.x - origin.x; }
    [[nodiscard]] float height() const { return end.y - origin.y; }
};

// Reserves an area as wide as the panel and fills it with a colour. The area is a button if `id` is given.
Canvas canvas(float height, float rounding, const char* id = nullptr, ImU32 fill = color(ImGuiCol_FrameBg)) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, height);
    if (id == nullptr)
        ImGui::Dummy(size);
    else
        ImGui::InvisibleButton(id, size);
    Canvas result{*ImGui::GetWindowDrawList(), origin, {origin.x + size.x, origin.y + size.y}};
    result.list.AddRectFilled(result.origin, result.end, fill, rounding);
    return result;
}

// Returns the position of an f-number in the list thirdStops(), as a fractional index.
float stopPosition(double fStop) {
    const std::span<const double> stops = thirdStops();
    if (fStop <= stops.front()) return 0;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (fStop <= stops[i])
            return static_cast<float>(static_cast<double>(i - 1) +
                                      std::log(fStop / stops[i - 1]) / std::log(stops[i] / stops[i - 1]));
    return static_cast<float>(stops.size() - 1);
}

// Applies mouse wheel, drag and click to the aperture ring, which must be the previous widget. `spacing`: px per
// entry of thirdStops().
void turnRing(double& fStop, float centre, float spacing) {
    ImGui::SetItemUsingMouseWheel();  // keep the panel from scrolling
    // Wheel notches not yet applied. A touchpad sends fractions of a notch; a slow frame receives several notches.
    static float rolled = 0;
    rolled = ImGui::IsItemHovered() ? rolled + ImGui::GetIO().MouseWheel : 0;
    const int notches = static_cast<int>(rolled);
    if (notches != 0) fStop = steppedStop(fStop, -notches);
    rolled -= static_cast<float>(notches);
    static float dragged = 0;  // drag distance not yet applied, px
    static bool turned = false;
    if (ImGui::IsItemActivated()) {
        dragged = 0;
        turned = false;
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 2)) {
        turned = true;
        dragged += ImGui::GetIO().MouseDelta.x;
        const int steps = static_cast<int>(dragged / spacing);
        fStop = steppedStop(fStop, -steps);
        dragged -= static_cast<float>(steps) * spacing;
    } else if (ImGui::IsItemDeactivated() && !turned) {
        fStop = steppedStop(fStop, static_cast<int>(std::lround((ImGui::GetIO().MousePos.x - centre) / spacing)));
    }
}

// Range of depths on the diagram's logarithmic horizontal axis.
struct DepthAxis {
    double nearest = 0;  // nearest depth on the axis, m
    double farthest = 0;
    [[nodiscard]] float share(double depth) const {
        return static_cast<float>(std::log(std::clamp(depth, nearest, farthest) / nearest) /
                                  std::log(farthest / nearest));
    }
    [[nodiscard]] double at(float share) const { return nearest * std::pow(farthest / nearest, share); }
};

DepthAxis depthAxis(const FramePlan& plan) {
    const double focus = std::clamp(plan.view.lens.focusDistance, 1e-3, 1e5);
    DepthAxis axis{focus, focus};
    for (const ObjectPlan& object : plan.objects) {
        axis.nearest = std::min(axis.nearest, std::max(object.nearestDepth, 0.05 * focus));
        axis.farthest = std::max(axis.farthest, std::min(object.farthestDepth, 50 * focus));
    }
    return {axis.nearest / 1.4, axis.farthest * 1.4};
}

double cocAt(const FramePlan& plan, double depth) {
    return std::abs(circleOfConfusion(plan.coc, depth, plan.view.width));
}

// Returns the depth (m), at the image's centre, where the blur reaches one pixel. Searches from the focus distance to
// `endDioptre` (1/m). If the blur stays below a pixel, returns the depth of `endDioptre`.
double limitOfFocus(const FramePlan& plan, double endDioptre) {
    const auto sharp = [&](double dioptre) {
        return cocAt(plan, dioptre > 0 ? 1 / dioptre : std::numeric_limits<double>::infinity()) < 1;
    };
    if (sharp(endDioptre)) return 1 / endDioptre;
    double inside = 1 / plan.view.lens.focusDistance;
    double outside = endDioptre;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (inside + outside);
        (sharp(middle) ? inside : outside) = middle;
    }
    return 1 / inside;
}

// Draws the circle of confusion over depth as a symmetric pair of curves around `middle`. The height of a curve is
// logarithmic; a diameter of 63 px or more has the height `reach`.
void drawCocCurve(const Canvas& box, const FramePlan& plan, const DepthAxis& axis, float middle, float reach,
                  float scale) {
    constexpr int steps = 96;
    ImVec2 last[2];
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / steps;
        const double depth = axis.at(share);
        const float height = reach * static_cast<float>(std::min(1.0, std::log2(1 + cocAt(plan, depth)) / 6));
        const float x = box.origin.x + share * box.width();
        const ImVec2 points[2] = {{x, middle - height}, {x, middle + height}};
        const bool before = depth < plan.view.lens.focusDistance;
        const ImU32 stroke = color(before ? ImGuiCol_PlotHistogramHovered : ImGuiCol_CheckMark);
        for (int side = 0; side < 2; ++side) {
            if (i > 0) box.list.AddLine(last[side], points[side], stroke, 1.5f * scale);
            last[side] = points[side];
        }
    }
}

std::string focusRangeText(const FramePlan& plan, double nearLimit, double farLimit, double farthest) {
    if (!plan.usesLens) return "everything in focus";
    if (!std::isfinite(farLimit) || farLimit >= farthest) return fmt::format("in focus from {:.3g} m", nearLimit);
    const int digits = farLimit - nearLimit < 0.02 * nearLimit ? 5 : 3;
    return fmt::format("in focus {:.{}g} – {:.{}g} m", nearLimit, digits, farLimit, digits);
}

}  // namespace

void stopRing(double& fStop, float scale) {
    const Canvas box = canvas(44 * scale, 4 * scale, "##stops");
    notePlace("aperture ring");
    const float spacing = 15 * scale;
    const float centre = 0.5f * (box.origin.x + box.end.x);
    turnRing(fStop, centre, spacing);
    if (ImGui::IsItemHovered() || ImGui::IsItemFocused())
        box.list.AddRect(box.origin, box.end, color(ImGuiCol_Border), 4 * scale);
    box.list.PushClipRect(box.origin, box.end, true);
    const float position = stopPosition(fStop);
    const std::span<const double> stops = thirdStops();
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const float x = centre + (static_cast<float>(i) - position) * spacing;
        const double halfStops = 2 * std::log2(stops[i]);
        const bool fullStop = std::abs(halfStops - std::round(halfStops)) < 0.08;  // full stops are powers of √2
        const float fade = std::clamp(1 - std::abs(x - centre) / (0.5f * box.width()), 0.0f, 1.0f);
        box.list.AddLine({x, box.end.y - 4 * scale}, {x, box.end.y - (fullStop ? 14 : 9) * scale},
                         color(fullStop ? ImGuiCol_Text : ImGuiCol_TextDisabled, fade), scale);
        if (!fullStop) continue;
        const std::string text = fmt::format("{:g}", stops[i]);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        box.list.AddText({x - 0.5f * size.x, box.origin.y + 15 * scale - 0.5f * size.y}, color(ImGuiCol_Text, fade),
                         text.c_str());
    }
    box.list.PopClipRect();
    box.list.AddTriangleFilled({centre - 5 * scale, box.end.y}, {centre + 5 * scale, box.end.y},
                               {centre, box.end.y - 7 * scale}, color(ImGuiCol_CheckMark));
    tooltip(
        "Aperture ring: drag, click or turn the mouse wheel. In the image: Shift + mouse wheel, or the keys [ and ].");
}

void aperturePreview(const Lens& lens, float scale) {
    const Canvas box = canvas(104 * scale, 4 * scale, nullptr, IM_COL32(16, 16, 16, 255));
    const ImVec2 centre(0.5f * (box.origin.x + box.end.x), 0.5f * (box.origin.y + box.end.y));
    const float radius = 0.44f * box.height();
    box.list.AddCircle(centre, radius, IM_COL32(70, 70, 70, 255), 64, scale);
    for (const LensSample& sample : lensSamples(lens, RenderSettings{}.sequence, 0, 420, 0))
        box.list.AddCircleFilled({centre.x + radius * sample.lens.x, centre.y - radius * sample.lens.y}, 1.6f * scale,
                                 IM_COL32(255, 236, 200, 190), 6);
    tooltip("First 420 lens samples. They show the shape of the aperture and of a blurred point of light.");
}

void depthDiagram(const FramePlan& plan, float scale) {
    const Canvas box = canvas(134 * scale, 4 * scale);
    box.list.PushClipRect(box.origin, box.end, true);
    const DepthAxis axis = depthAxis(plan);
    const auto x = [&](double depth) { return box.origin.x + axis.share(depth) * box.width(); };
    const float middle = box.origin.y + 46 * scale;
    const float reach = 40 * scale;
    const float bottom = box.end.y - 20 * scale;

    const double nearLimit = limitOfFocus(plan, 1 / (0.01 * axis.nearest));
    const double farLimit = limitOfFocus(plan, 0);
    box.list.AddRectFilled({x(nearLimit), box.origin.y}, {std::max(x(farLimit), x(nearLimit) + 1), bottom},
                           color(ImGuiCol_CheckMark, 0.28f));
    drawCocCurve(box, plan, axis, middle, reach, scale);
    box.list.AddLine({box.origin.x, middle}, {box.end.x, middle}, color(ImGuiCol_TextDisabled, 0.4f), scale);
    const float focus = x(plan.view.lens.focusDistance);
    box.list.AddLine({focus, box.origin.y}, {focus, bottom}, color(ImGuiCol_CheckMark), 1.5f * scale);

    // Draw one line per object over the object's depth range.
    const std::size_t shown = std::min<std::size_t>(plan.objects.size(), 24);
    for (std::size_t i = 0; i < shown; ++i) {
        const ObjectPlan& object = plan.objects[i];
        const float row = 18 * static_cast<float>(i) / static_cast<float>(std::max<std::size_t>(shown, 6));
        const float y = middle + reach + (6 + row) * scale;
        const ImU32 stroke = object.coc.smallest < 1 ? color(ImGuiCol_Text) : color(ImGuiCol_TextDisabled, 0.8f);
        box.list.AddLine({x(std::max(object.nearestDepth, 1e-6)), y}, {x(std::max(object.farthestDepth, 1e-6)) + 1, y},
                         stroke, 1.5f * scale);
    }
    box.list.PopClipRect();
    const std::string text = focusRangeText(plan, nearLimit, farLimit, axis.farthest);
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    box.list.AddText({box.end.x - width - 6 * scale, box.end.y - ImGui::GetFontSize() - 2 * scale},
                     color(ImGuiCol_Text), text.c_str());
    tooltip(
        "Side view with the camera on the left. Curve: blur over depth, orange in front of the focus plane and blue "
        "behind it. Band: depths with less than one pixel of blur. Lines: objects, bright where they are in the band.");
}

void timeBar(std::span<const PassTime> parts, double budget, float scale) {
    static constexpr ImU32 palette[] = {IM_COL32(84, 148, 217, 255),  IM_COL32(240, 160, 60, 255),
                                        IM_COL32(104, 178, 120, 255), IM_COL32(180, 130, 200, 255),
                                        IM_COL32(200, 200, 110, 255), IM_COL32(100, 190, 195, 255),
                                        IM_COL32(210, 120, 140, 255), IM_COL32(150, 150, 150, 255)};
    double total = 0;
    for (const PassTime& part : parts) total += part.milliseconds;
    const double max = std::max({total, 1.25 * budget, 1e-3});
    const Canvas box = canvas(14 * scale, 3 * scale);
    float x = box.origin.x;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const float width = box.width() * static_cast<float>(parts[i].milliseconds / max);
        box.list.AddRectFilled({x, box.origin.y}, {x + width, box.end.y}, palette[i % std::size(palette)]);
        x += width;
    }
    const float mark = box.origin.x + box.width() * static_cast<float>(budget / max);
    box.list.AddLine({mark, box.origin.y - 2 * scale}, {mark, box.end.y + 2 * scale}, color(ImGuiCol_Text),
                     1.5f * scale);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        ImGui::PushStyleColor(ImGuiCol_Text, palette[i % std::size(palette)]);
        ImGui::TextUnformatted("■");
        ImGui::PopStyleColor();
        ImGui::SameLine();
        ImGui::TextUnformatted(fmt::format("{} {:.1f} ms", parts[i].name, parts[i].milliseconds).c_str());
        if (i % 2 == 0 && i + 1 < parts.size()) ImGui::SameLine(0.5f * box.width());
    }
}

}  // namespace defocus::engine
