#include "view/hud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

#include "image/colour_map.h"
#include "image/tone_map.h"

namespace defocus {

namespace {

constexpr ImU32 plate = IM_COL32(12, 12, 12, 190);
constexpr ImU32 white = IM_COL32(240, 240, 240, 255);
constexpr ImU32 amber = IM_COL32(255, 198, 92, 255);
constexpr ImU32 quiet = IM_COL32(190, 190, 190, 255);

ImVec2 corner(const HudContext& context, double x, double y) {
    return {static_cast<float>(context.area.origin.x + x * context.area.size.x),
            static_cast<float>(context.area.origin.y + y * context.area.size.y)};
}

ImU32 seeThrough(ImU32 color, float alpha) {
    const auto own = static_cast<float>(color >> IM_COL32_A_SHIFT & 0xff);
    return (color & ~IM_COL32_A_MASK) | static_cast<ImU32>(own * alpha) << IM_COL32_A_SHIFT;
}

// Text on a dark plate; `at` is its corner or, where the anchors say so, another point of it. Lines end after `width`;
// 0: where the text does. Returns its size.
ImVec2 label(const HudContext& context, ImVec2 at, float anchorX, float anchorY, const std::string& text, ImU32 color,
             float alpha = 1, float width = 0) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float pad = 6 * context.scale;
    const float wrap = width > 2 * pad ? width - 2 * pad : 0;
    const ImVec2 words = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap > 0 ? wrap : -1);
    const ImVec2 size(words.x + 2 * pad, words.y + pad);
    at.x = std::floor(at.x - anchorX * size.x);
    at.y = std::floor(at.y - anchorY * size.y);
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, seeThrough(plate, alpha), 4 * context.scale);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + pad, at.y + 0.5f * pad}, seeThrough(color, alpha),
                 text.c_str(), nullptr, wrap);
    return size;
}

std::string distanceText(double metres) {
    if (!std::isfinite(metres)) return "∞";
    return metres < 1 ? fmt::format("{:.1f} cm", 100 * metres) : fmt::format("{:.2f} m", metres);
}

float labelWidth(const HudContext& context, const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x + 12 * context.scale;
}

// " converged, error about 0.0031"; empty without a target error.
std::string errorLabel(const ViewPicture& picture) {
    const std::optional<double> error = picture.estimatedError();
    return error ? fmt::format("{} error about {:.2g}", picture.converged() ? " converged," : ",", *error) : "";
}

// Lens and samples at the bottom left: side by side, one above the other where the picture is narrow. Above them what
// is odd about the picture. Returns the corner at their top right.
ImVec2 drawStatus(const HudContext& context, const ViewState& state) {
    const float gap = 8 * context.scale;
    const ImVec2 at = corner(context, 0, 1);
    if (context.picture == nullptr) return at;
    const Lens& lens = state.lens;
    const std::string optics = lens.dofEnabled ? fmt::format("{:.3g} mm   f/{:.3g}   focus {}", lens.focalLength,
                                                             lens.fStop, distanceText(lens.focusDistance))
                                               : fmt::format("{:.3g} mm   pinhole", lens.focalLength);
    const View& view = context.picture->plan().view;
    const std::string samples =
        fmt::format("{} {}{}", context.picture->samples(), context.picture->samples() == 1 ? "sample" : "samples",
                    context.picture->finished() ? " ✓" : "") +
        errorLabel(*context.picture);
    const std::string whole =
        fmt::format("{}   {} × {}   {:.0f} ms", samples, view.width, view.height, context.frameMilliseconds);
    const float room = static_cast<float>(context.area.size.x) - 2 * gap;
    const std::string& work = labelWidth(context, whole) <= room ? whole : samples;
    std::vector<std::pair<std::string, ImU32>> labels = {{optics, white}, {work, quiet}};
    if (state.navigation == Navigation::fly) labels.emplace_back("fly", white);
    ImVec2 next(at.x + gap, at.y - gap);
    ImVec2 end = next;
    for (const auto& [text, color] : labels) {
        if (next.x > at.x + gap && next.x + labelWidth(context, text) > at.x + gap + room)
            next = {at.x + gap, end.y - 0.5f * gap};
        const ImVec2 size = label(context, next, 0, 1, text, color);
        next.x += size.x + 0.5f * gap;
        end = {std::max(end.x, next.x), next.y - size.y};
    }
    for (const std::string& warning : context.warnings) {
        const ImVec2 size = label(context, {at.x + gap, end.y - 0.5f * gap}, 0, 1, warning, amber, 1, room);
        end = {std::max(end.x, at.x + gap + size.x), end.y - 0.5f * gap - size.y};
    }
    return end;
}

void drawDivider(const HudContext& context, const ViewState& state) {
    if (context.rightLabel.empty()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 top = corner(context, state.display.divider, 0);
    const ImVec2 bottom = corner(context, state.display.divider, 1);
    const float s = context.scale;
    list.AddLine(top, bottom, IM_COL32(0, 0, 0, 160), 3 * s);
    list.AddLine(top, bottom, white, s);
    const ImVec2 middle(top.x, 0.5f * (top.y + bottom.y));
    list.AddCircleFilled(middle, 11 * s, IM_COL32(30, 30, 30, 230), 32);
    list.AddCircle(middle, 11 * s, white, 32, 1.2f * s);
    for (const float side : {-1.0f, 1.0f})
        list.AddTriangleFilled({middle.x + side * 7 * s, middle.y}, {middle.x + side * 2.5f * s, middle.y - 4 * s},
                               {middle.x + side * 2.5f * s, middle.y + 4 * s}, white);
    const float gap = 10 * s;
    const float left = corner(context, 0, 0).x + gap;
    const float end = corner(context, 1, 0).x - gap;
    const float leftWidth = labelWidth(context, context.leftLabel);
    label(context, {std::max(left, top.x - gap - leftWidth), top.y + gap}, 0, 0, context.leftLabel, white);
    std::string right = context.rightLabel;
    if (state.display.difference) right = fmt::format("{:.0f} × difference to {}", state.display.differenceGain, right);
    const auto psnr = context.picture->psnr();
    if (psnr) right += std::isfinite(*psnr) ? fmt::format("   {:.1f} dB", *psnr) : "   equal";
    // Where a side is too narrow its words reach over, the right ones a row lower.
    const float x = std::min(top.x + gap, end - labelWidth(context, right));
    const bool meet = x < top.x || left + leftWidth > top.x;
    label(context, {std::max(left, x), top.y + (meet ? gap + 2 * ImGui::GetFontSize() : gap)}, 0, 0, right, white);
}

// The points that the focus plane shall go through, numbered.
void drawFocusPoints(const HudContext& context, const ViewState& state) {
    const glm::dmat4 viewFromWorld = glm::inverse(state.camera.worldFromCamera);
    const glm::dvec2 tangents = tanHalfFov(state, context.area);
    const float radius = 5 * context.scale;
    for (std::size_t i = 0; i < state.focusPoints.size(); ++i) {
        const glm::dvec3 p = viewFromWorld * glm::dvec4(state.focusPoints[i], 1);
        if (!(p.z < 0)) continue;
        const ImVec2 at = corner(context, 0.5 - 0.5 * p.x / (p.z * tangents.x), 0.5 + 0.5 * p.y / (p.z * tangents.y));
        ImGui::GetBackgroundDrawList()->AddCircle(at, radius, plate, 24, 4 * context.scale);
        ImGui::GetBackgroundDrawList()->AddCircle(at, radius, white, 24, 2 * context.scale);
        label(context, {at.x + 2 * radius, at.y}, 0, 0.5f, fmt::format("{}", i + 1), white);
    }
}

// Where somebody clicked to focus: corners of a frame that closes in, as a camera's focus point does, and the distance
// in words. A small cross where nothing is.
void drawMarker(const HudContext& context, ViewState& state) {
    const double age = context.now - state.marker.since;
    state.marker.shown &= age <= markerDuration;
    if (!state.marker.shown) return;
    const glm::dvec3 p = glm::inverse(state.camera.worldFromCamera) * glm::dvec4(state.marker.point, 1);
    if (!(p.z < 0)) return;
    const glm::dvec2 tangents = tanHalfFov(state, context.area);
    const ImVec2 at = corner(context, 0.5 - 0.5 * p.x / (p.z * tangents.x), 0.5 + 0.5 * p.y / (p.z * tangents.y));
    const auto alpha = static_cast<float>(std::clamp((markerDuration - age) / 0.7, 0.0, 1.0));
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float s = context.scale;
    const bool hit = !state.marker.name.empty();
    const float closing = hit ? 10 * static_cast<float>(1 - eased(age / 0.25)) : 0;
    const float half = ((hit ? 13.0f : 6.0f) + closing) * s;
    const float arm = 6 * s;
    for (const auto& [color, width] : {std::pair(plate, 4 * s), std::pair(white, 1.6f * s)}) {
        const ImU32 shown = seeThrough(color, alpha);
        for (const float x : {-1.0f, 1.0f}) {
            if (!hit) {
                list.AddLine({at.x - half, at.y - x * half}, {at.x + half, at.y + x * half}, shown, width);
                continue;
            }
            for (const float y : {-1.0f, 1.0f}) {
                const ImVec2 points[] = {{at.x + x * half, at.y + y * (half - arm)},
                                         {at.x + x * half, at.y + y * half},
                                         {at.x + x * (half - arm), at.y + y * half}};
                list.AddPolyline(points, 3, shown, 0, width);
            }
        }
    }
    const std::string text =
        hit ? fmt::format("{}   {}", state.marker.name, distanceText(state.marker.distance)) : "nothing here";
    const float room = corner(context, 1, 0).x - at.x - half - 8 * s;
    const bool left = labelWidth(context, text) > room;
    label(context, {at.x + (left ? -1 : 1) * (half + 6 * s), at.y}, left ? 1 : 0, 0.5f, text, white, alpha);
}

// What the colours of an overlay mean.
struct Legend {
    const char* title;
    const char* brief;                     // where the picture is narrow
    glm::vec3 (*colour)(float) = viridis;  // 0 … 1, linear
    std::array<const char*, 5> marks;      // at even places
};

// As shaders/view/display.frag has it.
glm::vec3 cocColour(float t) {
    const float side = 2 * t - 1;
    const glm::vec3 colour = side < 0 ? glm::vec3(1, 0.55f, 0.10f) : glm::vec3(0.2f, 0.55f, 1);
    const glm::vec3 encoded = glm::mix(glm::vec3(0.6f), colour, glm::smoothstep(0.0f, 0.5f, std::abs(side)));
    return {srgbDecode(encoded.r), srgbDecode(encoded.g), srgbDecode(encoded.b)};
}

std::optional<Legend> legendOf(const ViewState& state) {
    switch (state.display.overlay) {
        case DisplayOverlay::coc:
            return Legend{"blur, px: in front – behind", "blur, px", cocColour, {"63", "7", "0", "7", "63"}};
        case DisplayOverlay::rate:
            return Legend{"images a lens sample (multirate)", "images", viridis, {"1", "0.71", "0.5", "0.35", "0.25"}};
        case DisplayOverlay::work:
            return Legend{"triangles a pixel and lens sample", "triangles", magma, {"0", "1", "3", "7", "15 +"}};
        case DisplayOverlay::level:
            break;
        case DisplayOverlay::none:
            if (!state.display.wireframe) return std::nullopt;
    }
    return Legend{"level of detail", "level", viridis, {"0", "2", "4", "6", "8 +"}};
}

// A strip of colours with its title and numbers, at the bottom right; above `status` where there is no room beside it.
void drawLegend(const HudContext& context, const ViewState& state, const ImVec2& status) {
    const std::optional<Legend> legend = legendOf(state);
    if (!legend) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float s = context.scale;
    const float pad = 9 * s;
    const float line = ImGui::GetFontSize();
    const float room = static_cast<float>(context.area.size.x) - 16 * s - 2 * pad;
    const float wanted = std::max(190 * s, ImGui::CalcTextSize(legend->title).x);
    const char* title = wanted <= room ? legend->title : legend->brief;
    const ImVec2 size(std::min(room, wanted), 10 * s);
    ImVec2 end = corner(context, 1, 1);
    if (end.x - size.x - 2 * pad - 16 * s < status.x) end.y = status.y;
    const ImVec2 at(end.x - size.x - 8 * s - pad, end.y - 8 * s - pad - line - 4 * s - size.y);
    list.AddRectFilled({at.x - pad, at.y - line - 5 * s - pad}, {end.x - 8 * s, end.y - 8 * s}, plate, 4 * s);
    list.AddText({at.x, at.y - line - 5 * s}, white, title);
    constexpr int steps = 95;
    for (int i = 0; i < steps; ++i) {
        glm::vec3 color = legend->colour((static_cast<float>(i) + 0.5f) / steps);
        for (int c = 0; c < 3; ++c) color[c] = srgbEncode(color[c]);
        const float left = at.x + size.x * static_cast<float>(i) / steps;
        const float right = at.x + size.x * static_cast<float>(i + 1) / steps;
        list.AddRectFilled({std::floor(left), at.y}, {std::floor(right), at.y + size.y},
                           ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1}));
    }
    for (std::size_t i = 0; i < legend->marks.size(); ++i) {
        const float share = static_cast<float>(i) / (legend->marks.size() - 1);
        const float width = ImGui::CalcTextSize(legend->marks[i]).x;
        list.AddText({at.x + share * (size.x - width), at.y + size.y + 3 * s}, quiet, legend->marks[i]);
    }
}

// The object under the cursor: how it is drawn.
void drawHover(const HudContext& context, const ViewState& state) {
    const bool wanted = state.display.overlay != DisplayOverlay::none || state.display.wireframe;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::dvec2 position(mouse.x, mouse.y);
    if (!wanted || context.mouseOnInterface || context.picture == nullptr || !context.area.contains(position)) return;
    static glm::dvec2 pickedAt(-1);
    static std::optional<PickedSurface> picked;
    static double restsSince = 0;
    static bool known = false;
    if (position != pickedAt) {
        pickedAt = position;
        restsSince = context.now;
        known = false;
    }
    if (context.now - restsSince < 0.12) return;
    if (!known) picked = pickedSurface(*context.frame, state, context.area, position);
    known = true;
    if (!picked) return;
    for (const ObjectPlan& object : context.picture->plan().objects) {
        if (object.object != picked->object) continue;
        std::string text = fmt::format(
            "{}\n{} away, blurred by {:.1f} px\nlevel λ {:.2f}", object.name, distanceText(picked->depth),
            std::abs(circleOfConfusion(context.picture->plan().coc, picked->depth, context.picture->plan().view.width)),
            object.lambda);
        for (const LevelDraw& draw : {object.coarse, object.fine})
            if (draw.sampleCount > 0)
                text += fmt::format("\n{} samples at level {}: {} triangles", draw.sampleCount, draw.level,
                                    draw.triangleCount);
        ImGui::BeginTooltip();
        ImGui::TextUnformatted(text.c_str());
        ImGui::EndTooltip();
        return;
    }
}

void drawProgress(const HudContext& context, const ImVec2& centre, const std::string& text, double share) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float s = context.scale;
    const ImVec2 half(std::min(170 * s, 0.48f * static_cast<float>(context.area.size.x)), 34 * s);
    list.AddRectFilled({centre.x - half.x, centre.y - half.y}, {centre.x + half.x, centre.y + half.y}, plate, 6 * s);
    list.PushClipRect({centre.x - half.x + 8 * s, centre.y - half.y}, {centre.x + half.x - 8 * s, centre.y + half.y},
                      true);
    list.AddText({centre.x - half.x + 16 * s, centre.y - 22 * s}, white, text.c_str());
    list.PopClipRect();
    const ImVec2 bar(centre.x - half.x + 16 * s, centre.y + 10 * s);
    const float width = 2 * half.x - 32 * s;
    list.AddRectFilled(bar, {bar.x + width, bar.y + 5 * s}, IM_COL32(80, 80, 80, 255), 2 * s);
    list.AddRectFilled(bar, {bar.x + width * static_cast<float>(share), bar.y + 5 * s}, IM_COL32(84, 148, 217, 255),
                       2 * s);
}

void drawExport(const HudContext& context) {
    if (context.exporting == nullptr) return;
    ImVec2 centre = corner(context, 0.5, 1);
    centre.y -= 90 * context.scale;
    const double seconds = context.exporting->secondsLeft();
    const std::string left = std::isfinite(seconds) ? fmt::format(", about {:.0f} s left", std::max(1.0, seconds)) : "";
    drawProgress(context, centre,
                 fmt::format("{}: {:.0f} %{}. Esc cancels", context.exporting->request().output.filename().string(),
                             100 * context.exporting->share(), left),
                 context.exporting->share());
}

// The boxes of the objects to come, and how far it is.
void drawLoading(const HudContext& context) {
    if (!context.loader->busy()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto preview = context.frame == nullptr ? context.loader->preview() : nullptr;
    if (preview) {
        const glm::dmat4 viewFromWorld = glm::inverse(preview->view.worldFromCamera);
        const double tanX = tanHalfHorizontalFov(preview->view.lens);
        const double tanY = tanX * context.area.size.y / context.area.size.x;
        static constexpr int edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                             {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
        for (const std::array<glm::dvec3, 8>& box : preview->boxes) {
            ImVec2 points[8];
            bool inFront = true;
            for (std::size_t i = 0; i < 8; ++i) {
                const glm::dvec4 p = viewFromWorld * glm::dvec4(box[i], 1);
                inFront = inFront && p.z < -preview->view.nearPlane;
                points[i] = corner(context, 0.5 - 0.5 * p.x / (p.z * tanX), 0.5 + 0.5 * p.y / (p.z * tanY));
            }
            if (!inFront) continue;
            for (const auto& edge : edges)
                list.AddLine(points[edge[0]], points[edge[1]], context.colors.faint, context.scale);
        }
    }
    ImVec2 centre = corner(context, 0.5, context.frame == nullptr ? 0.5 : 1);
    if (context.frame != nullptr) centre.y -= 90 * context.scale;  // something is shown already: not in its way
    drawProgress(context, centre, fmt::format("Opening {}: {}", context.loader->name(), context.loader->stage()),
                 context.loader->share());
}

void drawMessages(const HudContext& context, ViewState& state) {
    std::erase_if(state.messages, [&](const Message& message) { return message.until < context.now; });
    float y = 12 * context.scale;
    int index = 0;
    for (const Message& message : state.messages) {
        const ImVec2 at = corner(context, 0.5, 0);
        ImGui::SetNextWindowPos({at.x, at.y + y}, ImGuiCond_Always, {0.5f, 0});
        ImGui::SetNextWindowSizeConstraints({0, 0}, {static_cast<float>(context.area.size.x) * 0.9f, 1e4f});
        ImGui::Begin(fmt::format("##message{}", index++).c_str(), nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
        ImGui::PushTextWrapPos(static_cast<float>(context.area.size.x) * 0.8f);
        if (message.fault) ImGui::PushStyleColor(ImGuiCol_Text, context.colors.fault);
        ImGui::TextUnformatted(message.text.c_str());
        if (message.fault) ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
        y += ImGui::GetWindowHeight() + 6 * context.scale;
        ImGui::End();
    }
}

void drawHelp(const HudContext& context, ViewState& state) {
    if (!state.help) return;
    const ImVec2 centre = corner(context, 0.5, 0.5);
    ImGui::SetNextWindowPos(centre, ImGuiCond_Always, {0.5f, 0.5f});
    const ImVec2 window = ImGui::GetIO().DisplaySize;  // small ones scroll
    ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x, std::max(64.0f, window.y - 16 * context.scale)});
    ImGui::Begin("Keys", &state.help,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const KeyHelp& entry : keyHelp()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(entry.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", entry.meaning);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace

void drawHud(const HudContext& context, ViewState& state) {
    drawDivider(context, state);
    const ImVec2 status = drawStatus(context, state);
    if (context.picture != nullptr) drawLegend(context, state, status);
    drawHover(context, state);
    drawFocusPoints(context, state);
    drawMarker(context, state);
    drawLoading(context);
    drawExport(context);
    drawMessages(context, state);
    drawHelp(context, state);
}

}  // namespace defocus
