#include "view/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lens/lens_samples.h"
#include "view/photographic_stops.h"

namespace defocus {

namespace {

ImVec2 area(float height) {
    return {ImGui::GetContentRegionAvail().x, height};
}

ImU32 faded(ImU32 color, float alpha) {
    ImVec4 value = ImGui::ColorConvertU32ToFloat4(color);
    value.w *= alpha;
    return ImGui::ColorConvertFloat4ToU32(value);
}

void centred(ImDrawList& list, const ImVec2& at, ImU32 color, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddText({at.x - 0.5f * size.x, at.y - 0.5f * size.y}, color, text.c_str());
}

// The place of a stop in the table, between two where it lies between them.
float stopPosition(double fStop) {
    const std::span<const double> stops = standardStops();
    if (fStop <= stops.front()) return 0;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (fStop <= stops[i])
            return static_cast<float>(static_cast<double>(i - 1) +
                                      std::log(fStop / stops[i - 1]) / std::log(stops[i] / stops[i - 1]));
    return static_cast<float>(stops.size() - 1);
}

std::map<std::string, ImVec2>& places() {
    static std::map<std::string, ImVec2> noted;  // as Dear ImGui has one state, too
    return noted;
}

struct Depths {
    double nearest = 0;
    double farthest = 0;
    [[nodiscard]] float share(double depth) const {
        return static_cast<float>(std::log(std::clamp(depth, nearest, farthest) / nearest) /
                                  std::log(farthest / nearest));
    }
    [[nodiscard]] double at(float share) const { return nearest * std::pow(farthest / nearest, share); }
};

Depths depthsOf(const FramePlan& plan) {
    const double focus = std::clamp(plan.view.lens.focusDistance, 1e-3, 1e5);
    Depths depths{focus, focus};
    for (const ObjectPlan& object : plan.objects) {
        depths.nearest = std::min(depths.nearest, std::max(object.nearestDepth, 0.05 * focus));
        depths.farthest = std::max(depths.farthest, std::min(object.farthestDepth, 50 * focus));
    }
    return {depths.nearest / 1.4, depths.farthest * 1.4};
}

// The depth (m) at the image's centre where the blur reaches a pixel, on the way from the focus to `lastDioptre` (1/m);
// that of `lastDioptre` where it never does.
double limitOfFocus(const FramePlan& plan, double lastDioptre) {
    const auto sharp = [&](double dioptre) {
        const double depth = dioptre > 0 ? 1 / dioptre : std::numeric_limits<double>::infinity();
        return std::abs(circleOfConfusion(plan.coc, depth, plan.view.width)) < 1;
    };
    if (sharp(lastDioptre)) return 1 / lastDioptre;
    double inside = 1 / plan.view.lens.focusDistance;
    double outside = lastDioptre;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (inside + outside);
        (sharp(middle) ? inside : outside) = middle;
    }
    return 1 / inside;
}

}  // namespace

void notePlace(const std::string& name) {
    if (!ImGui::IsItemVisible()) return;
    const ImVec2 least = ImGui::GetItemRectMin();
    const ImVec2 most = ImGui::GetItemRectMax();
    places()[name] = {0.5f * (least.x + most.x), 0.5f * (least.y + most.y)};
}

std::map<std::string, ImVec2> takePlaces() {
    return std::exchange(places(), {});
}

bool section(const char* title, bool open) {
    const bool opened = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    notePlace(title);
    return opened;
}

int combo(const char* id, const std::vector<std::string>& names, const std::string& current) {
    int chosen = -1;
    if (!ImGui::BeginCombo(id, current.c_str())) return chosen;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (ImGui::Selectable(names[i].c_str(), names[i] == current)) chosen = static_cast<int>(i);
    ImGui::EndCombo();
    return chosen;
}

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void rowLabel(const char* label, const char* help) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    if (help != nullptr) tooltip(help);
    ImGui::SameLine(ImGui::GetFontSize() * 10.2f);
    ImGui::SetNextItemWidth(-1);
}

bool pathRow(const char* id, const char* hint, const char* button, std::string& path) {
    ImGui::PushID(id);
    const ImGuiStyle& style = ImGui::GetStyle();
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize(button).x - 2 * style.FramePadding.x - style.ItemSpacing.x);
    const bool entered = ImGui::InputTextWithHint("##path", hint, &path, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    const bool pressed = ImGui::Button(button);
    ImGui::PopID();
    return entered || pressed;
}

bool stopRing(double& fStop, const InterfaceColors& colors, float scale) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size = area(44 * scale);
    ImGui::InvisibleButton("##stops", size);
    const bool hovered = ImGui::IsItemHovered();
    const float spacing = 15 * scale;  // px a third of a stop
    const double before = fStop;

    notePlace("aperture ring");

    // Drag turns the ring; the wheel steps from stop to stop, and doesn't scroll the panel; a click goes to the stop
    // under it.
    ImGui::SetItemUsingMouseWheel();
    if (const float wheel = ImGui::GetIO().MouseWheel; hovered && wheel != 0)
        fStop = steppedStop(fStop, wheel > 0 ? -1 : 1);
    static float dragged = 0;
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
        const float offset = (ImGui::GetIO().MousePos.x - origin.x - 0.5f * size.x) / spacing;
        fStop = steppedStop(fStop, static_cast<int>(std::lround(offset)));
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    list.AddRectFilled(origin, end, colors.fill, 4 * scale);
    if (hovered || ImGui::IsItemFocused()) list.AddRect(origin, end, colors.line, 4 * scale);
    list.PushClipRect(origin, end, true);
    const float centre = origin.x + 0.5f * size.x;
    const float position = stopPosition(fStop);
    const std::span<const double> stops = standardStops();
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const float x = centre + (static_cast<float>(i) - position) * spacing;
        // Whole stops are powers of √2.
        const double whole = 2 * std::log2(stops[i]);
        const bool isWhole = std::abs(whole - std::round(whole)) < 0.08;
        const float fade = std::clamp(1 - std::abs(x - centre) / (0.5f * size.x), 0.0f, 1.0f);
        list.AddLine({x, end.y - 4 * scale}, {x, end.y - (isWhole ? 14 : 9) * scale},
                     faded(isWhole ? colors.text : colors.faint, fade), scale);
        if (isWhole) centred(list, {x, origin.y + 15 * scale}, faded(colors.text, fade), fmt::format("{:g}", stops[i]));
    }
    list.PopClipRect();
    list.AddTriangleFilled({centre - 5 * scale, end.y}, {centre + 5 * scale, end.y}, {centre, end.y - 7 * scale},
                           colors.accent);
    tooltip("The aperture ring: drag, click, or turn the wheel (with Shift over the picture). [ and ] step.");
    return fStop != before;
}

void aperturePreview(const Lens& lens, float scale) {
    const float side = 104 * scale;
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size = area(side);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    list.AddRectFilled(origin, end, IM_COL32(16, 16, 16, 255), 4 * scale);
    const ImVec2 centre(origin.x + 0.5f * size.x, origin.y + 0.5f * size.y);
    const float radius = 0.44f * side;
    list.AddCircle(centre, radius, IM_COL32(70, 70, 70, 255), 64, scale);
    for (const LensSample& sample : lensSamples(lens, RenderSettings{}.sequence, 0, 420, 0))
        list.AddCircleFilled({centre.x + radius * sample.lens.x, centre.y - radius * sample.lens.y}, 1.6f * scale,
                             IM_COL32(255, 236, 200, 190), 6);
    tooltip("The shape of the aperture, and of a blurred point of light: the first 420 lens samples.");
}

void depthDiagram(const FramePlan& plan, const InterfaceColors& colors, float scale) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size = area(134 * scale);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    list.AddRectFilled(origin, end, colors.fill, 4 * scale);
    list.PushClipRect(origin, end, true);
    const Depths depths = depthsOf(plan);
    const auto x = [&](double depth) { return origin.x + depths.share(depth) * size.x; };
    const float axis = origin.y + 46 * scale;
    const float reach = 40 * scale;

    const double focus = plan.view.lens.focusDistance;
    const double nearLimit = limitOfFocus(plan, 1 / (0.01 * depths.nearest));
    const double farLimit = limitOfFocus(plan, 0);
    list.AddRectFilled({x(nearLimit), origin.y}, {std::max(x(farLimit), x(nearLimit) + 1), end.y - 20 * scale},
                       faded(colors.accent, 0.28f));

    // The circle of confusion over depth, to both sides of the axis; logarithmic, 64 px at the edge.
    constexpr int steps = 96;
    ImVec2 last[2];
    for (int i = 0; i <= steps; ++i) {
        const float share = static_cast<float>(i) / steps;
        const double coc = std::abs(circleOfConfusion(plan.coc, depths.at(share), plan.view.width));
        const float height = reach * static_cast<float>(std::min(1.0, std::log2(1 + coc) / 6));
        const ImVec2 points[2] = {{origin.x + share * size.x, axis - height},
                                  {origin.x + share * size.x, axis + height}};
        if (i > 0)
            for (int side = 0; side < 2; ++side)
                list.AddLine(last[side], points[side], depths.at(share) < focus ? colors.warm : colors.cool,
                             1.5f * scale);
        last[0] = points[0];
        last[1] = points[1];
    }
    list.AddLine({origin.x, axis}, {end.x, axis}, faded(colors.faint, 0.4f), scale);
    list.AddLine({x(focus), origin.y}, {x(focus), end.y - 20 * scale}, colors.accent, 1.5f * scale);

    // The objects below, each over the depths that it fills.
    const std::size_t shown = std::min<std::size_t>(plan.objects.size(), 24);
    for (std::size_t i = 0; i < shown; ++i) {
        const ObjectPlan& object = plan.objects[i];
        const float row = 18 * static_cast<float>(i) / static_cast<float>(std::max<std::size_t>(shown, 6));
        const float y = axis + reach + (6 + row) * scale;
        const bool sharp = object.coc.smallest < 1;
        list.AddLine({x(std::max(object.nearestDepth, 1e-6)), y}, {x(std::max(object.farthestDepth, 1e-6)) + 1, y},
                     sharp ? colors.text : faded(colors.faint, 0.8f), 1.5f * scale);
    }
    list.PopClipRect();
    const int digits = farLimit - nearLimit < 0.02 * nearLimit ? 5 : 3;
    const std::string text = std::isfinite(farLimit) && farLimit < depths.farthest
                                 ? fmt::format("in focus {:.{}g} – {:.{}g} m", nearLimit, digits, farLimit, digits)
                                 : fmt::format("in focus from {:.3g} m", nearLimit);
    const std::string words = plan.usesLens ? text : "everything in focus";
    const float width = ImGui::CalcTextSize(words.c_str()).x;
    list.AddText({end.x - width - 6 * scale, end.y - ImGui::GetFontSize() - 2 * scale}, colors.text, words.c_str());
    tooltip(
        "From the side, the camera on the left: how large a point is blurred at each depth (orange in front, blue "
        "behind), what is sharp to a pixel (band), and the objects (lines; white ones reach into it).");
}

void timeBar(std::span<const BarPart> parts, double budget, const InterfaceColors& colors, float scale) {
    static constexpr ImU32 palette[] = {IM_COL32(84, 148, 217, 255),  IM_COL32(240, 160, 60, 255),
                                        IM_COL32(104, 178, 120, 255), IM_COL32(180, 130, 200, 255),
                                        IM_COL32(200, 200, 110, 255), IM_COL32(100, 190, 195, 255),
                                        IM_COL32(210, 120, 140, 255), IM_COL32(150, 150, 150, 255)};
    double total = 0;
    for (const BarPart& part : parts) total += part.milliseconds;
    const double most = std::max({total, 1.25 * budget, 1e-3});
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size = area(14 * scale);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(origin, {origin.x + size.x, origin.y + size.y}, colors.fill, 3 * scale);
    float x = origin.x;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const float width = size.x * static_cast<float>(parts[i].milliseconds / most);
        list.AddRectFilled({x, origin.y}, {x + width, origin.y + size.y}, palette[i % std::size(palette)]);
        x += width;
    }
    const float mark = origin.x + size.x * static_cast<float>(budget / most);
    list.AddLine({mark, origin.y - 2 * scale}, {mark, origin.y + size.y + 2 * scale}, colors.text, 1.5f * scale);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        ImGui::PushStyleColor(ImGuiCol_Text, palette[i % std::size(palette)]);
        ImGui::TextUnformatted("■");
        ImGui::PopStyleColor();
        ImGui::SameLine();
        ImGui::TextUnformatted(fmt::format("{} {:.1f} ms", parts[i].name, parts[i].milliseconds).c_str());
        if (i % 2 == 0 && i + 1 < parts.size()) ImGui::SameLine(0.5f * size.x);
    }
}

void timeGraph(const std::vector<float>& milliseconds, double budget, const InterfaceColors& colors, float scale) {
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const ImVec2 size = area(48 * scale);
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(origin.x + size.x, origin.y + size.y);
    list.AddRectFilled(origin, end, colors.fill, 4 * scale);
    float most = static_cast<float>(1.5 * budget);
    for (const float value : milliseconds) most = std::max(most, value);
    const float mark = end.y - size.y * static_cast<float>(budget) / most;
    list.AddLine({origin.x, mark}, {end.x, mark}, faded(colors.faint, 0.7f), scale);
    const float step = size.x / static_cast<float>(std::max<std::size_t>(milliseconds.size(), 1));
    for (std::size_t i = 0; i < milliseconds.size(); ++i) {
        const float x = origin.x + step * static_cast<float>(i);
        const float y = end.y - size.y * milliseconds[i] / most;
        list.AddRectFilled({x, y}, {x + std::max(step - 0.5f, 1.0f), end.y},
                           milliseconds[i] > static_cast<float>(1.5 * budget) ? colors.warm : colors.accent);
    }
    tooltip("Time of the latest frames; the line is the budget.");
}

}  // namespace defocus
