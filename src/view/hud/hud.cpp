#include "view/hud/hud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace defocus::engine {

namespace {

constexpr double markerDuration = 2.2;  // seconds until the focus marker disappears

ImU32 faded(ImU32 color, float alpha) {
    const auto own = static_cast<float>(color >> IM_COL32_A_SHIFT & 0xff);
    return (color & ~IM_COL32_A_MASK) | static_cast<ImU32>(own * alpha) << IM_COL32_A_SHIFT;
}

// Returns the window position of a world-space point; nullopt if the point is behind the camera.
std::optional<ImVec2> onPicture(const Ui& ui, const glm::dvec3& point) {
    const ViewState& state = ui.state;
    const glm::dvec3 p = glm::inverse(state.camera.worldFromCamera) * glm::dvec4(point, 1);
    if (!(p.z < 0)) return std::nullopt;
    const glm::dvec2 tangents = tanHalfFov(state.lens, state.area);
    return pictureCorner(ui, 0.5 - 0.5 * p.x / (p.z * tangents.x), 0.5 + 0.5 * p.y / (p.z * tangents.y));
}

void drawHandle(const ImVec2& top, const ImVec2& bottom, float scale) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddLine(top, bottom, IM_COL32(0, 0, 0, 160), 3 * scale);
    list.AddLine(top, bottom, brightColor, scale);
    const ImVec2 middle(top.x, 0.5f * (top.y + bottom.y));
    list.AddCircleFilled(middle, 11 * scale, IM_COL32(30, 30, 30, 230), 32);
    list.AddCircle(middle, 11 * scale, brightColor, 32, 1.2f * scale);
    for (const float side : {-scale, scale})
        list.AddTriangleFilled({middle.x + 7 * side, middle.y}, {middle.x + 2.5f * side, middle.y - 4 * scale},
                               {middle.x + 2.5f * side, middle.y + 4 * scale}, brightColor);
}

std::string rightLabel(const ViewPicture& picture, const DisplaySettings& display) {
    std::string text = sideLabel(*picture.secondSide());
    if (display.difference) text = fmt::format("difference from {}, × {:.0f}", text, display.differenceGain);
    if (const auto psnr = picture.psnr())
        text += std::isfinite(*psnr) ? fmt::format("   {:.1f} dB", *psnr) : "   equal";
    return text;
}

// Draws the four corners of a square around the focus point, or a cross if the click hit no surface.
void drawMarkerShape(const ImVec2& at, bool hit, float half, float arm, ImU32 color, float width) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const float x : {-1.0f, 1.0f}) {
        if (!hit) {
            list.AddLine({at.x - half, at.y - x * half}, {at.x + half, at.y + x * half}, color, width);
            continue;
        }
        for (const float y : {-1.0f, 1.0f}) {
            const ImVec2 points[] = {{at.x + x * half, at.y + y * (half - arm)},
                                     {at.x + x * half, at.y + y * half},
                                     {at.x + x * (half - arm), at.y + y * half}};
            list.AddPolyline(points, 3, color, 0, width);
        }
    }
}

void drawDivider(const Ui& ui) {
    const ViewPicture& picture = *ui.picture.image;
    if (picture.secondSide() == nullptr) return;
    const DisplaySettings& display = ui.state.display;
    const ImVec2 top = pictureCorner(ui, display.divider, 0);
    drawHandle(top, pictureCorner(ui, display.divider, 1), ui.scale);
    const float gap = 10 * ui.scale;
    const float begin = gap;
    const float end = pictureCorner(ui, 1, 0).x - gap;
    const std::string left = sideLabel(picture.firstSide());
    const float leftWidth = labelWidth(ui, left);
    drawLabel(ui, {std::max(begin, top.x - gap - leftWidth), top.y + gap}, left);
    // If one side of the divider is too narrow for its label, the label crosses the divider. The right label then moves
    // down a row.
    const std::string right = rightLabel(picture, display);
    const float x = std::min(top.x + gap, end - labelWidth(ui, right));
    const bool crosses = x < top.x || begin + leftWidth > top.x;
    drawLabel(ui, {std::max(begin, x), top.y + (crosses ? gap + 2 * ImGui::GetFontSize() : gap)}, right);
}

void drawFocusPoints(const Ui& ui) {
    const float radius = 5 * ui.scale;
    int number = 0;
    for (const glm::dvec3& point : ui.state.focusPoints) {
        ++number;
        const std::optional<ImVec2> at = onPicture(ui, point);
        if (!at) continue;
        ImGui::GetBackgroundDrawList()->AddCircle(*at, radius, plateColor, 24, 4 * ui.scale);
        ImGui::GetBackgroundDrawList()->AddCircle(*at, radius, brightColor, 24, 2 * ui.scale);
        drawLabel(ui, {at->x + 2 * radius, at->y}, std::to_string(number), {.anchorY = 0.5f});
    }
}

void drawMarker(const Ui& ui) {
    FocusMarker& marker = ui.state.marker;
    const double age = ui.state.now - marker.since;
    marker.shown &= age <= markerDuration;
    const std::optional<ImVec2> at = marker.shown ? onPicture(ui, marker.point) : std::nullopt;
    if (!at) return;
    const float s = ui.scale;
    const auto alpha = static_cast<float>(std::clamp((markerDuration - age) / 0.7, 0.0, 1.0));
    const bool hit = !marker.name.empty();
    const float closing = hit ? 10 * static_cast<float>(1 - eased(age / 0.25)) : 0;
    const float half = ((hit ? 13.0f : 6.0f) + closing) * s;
    drawMarkerShape(*at, hit, half, 6 * s, faded(plateColor, alpha), 4 * s);
    drawMarkerShape(*at, hit, half, 6 * s, faded(brightColor, alpha), 1.6f * s);
    const std::string text =
        hit ? fmt::format("{}   {}", marker.name, distanceText(marker.distance)) : "no surface here";
    const bool left = labelWidth(ui, text) > pictureCorner(ui, 1, 0).x - at->x - half - 8 * s;
    drawLabel(ui, {at->x + (left ? -1 : 1) * (half + 6 * s), at->y}, text,
              {.anchorX = left ? 1.0f : 0.0f, .anchorY = 0.5f, .alpha = alpha});
}

std::string lensLabel(const Lens& lens) {
    return lens.dofEnabled ? fmt::format("{:.3g} mm   f/{:.3g}   focus {}", lens.focalLength, lens.fStop,
                                         distanceText(lens.focusDistance))
                           : fmt::format("{:.3g} mm   pinhole", lens.focalLength);
}

std::string samplesLabel(const ViewPicture& picture) {
    const std::uint32_t samples = picture.samples();
    if (picture.refocused()) return fmt::format("refocused from {} lens images", samples);
    std::string text =
        fmt::format("{} {}{}", samples, samples == 1 ? "sample" : "samples", picture.finished() ? " ✓" : "");
    if (const std::optional<double> error = picture.estimatedError())
        text += fmt::format("{} RMSE about {:.2g}", picture.converged() ? " converged," : ",", *error);
    return text;
}

// Draws the status labels at the bottom left: lens, samples and warnings. Returns the labels' top right corner.
ImVec2 drawStatus(const Ui& ui) {
    const float gap = 8 * ui.scale;
    const ImVec2 corner = pictureCorner(ui, 0, 1);
    const float width = static_cast<float>(ui.state.area.size.x) - 2 * gap;
    const View& view = ui.picture.image->plan().view;
    const std::string samples = samplesLabel(*ui.picture.image);
    const std::string details = fmt::format("{}   {} × {}   {:.0f} ms, {:.0f} frames/s", samples, view.width,
                                            view.height, ui.times.frame, 1000 / std::max(ui.times.frame, 1.0));
    std::vector<std::pair<std::string, ImU32>> labels = {
        {lensLabel(ui.state.lens), brightColor},
        {labelWidth(ui, details) <= width ? details : samples, dimColor},
    };
    if (ui.state.navigation == Navigation::fly) labels.emplace_back("fly", brightColor);

    // Place the labels side by side; a label that doesn't fit starts a new row above.
    ImVec2 next(corner.x + gap, corner.y - gap);
    ImVec2 end = next;
    for (const auto& [text, color] : labels) {
        if (next.x > corner.x + gap && next.x + labelWidth(ui, text) > corner.x + gap + width)
            next = {corner.x + gap, end.y - 0.5f * gap};
        const ImVec2 size = drawLabel(ui, next, text, {.color = color, .anchorY = 1});
        next.x += size.x + 0.5f * gap;
        end = {std::max(end.x, next.x), next.y - size.y};
    }
    for (const std::string& warning : ui.picture.warnings) {
        const ImVec2 at(corner.x + gap, end.y - 0.5f * gap);
        const ImVec2 size = drawLabel(ui, at, warning, {.color = warningColor, .anchorY = 1, .width = width});
        end = {std::max(end.x, at.x + size.x), at.y - size.y};
    }
    return end;
}

}  // namespace

ImVec2 pictureCorner(const Ui& ui, double x, double y) {
    return {static_cast<float>(x * ui.state.area.size.x), static_cast<float>(y * ui.state.area.size.y)};
}

ImVec2 drawLabel(const Ui& ui, ImVec2 at, const std::string& text, const LabelStyle& style) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float pad = 6 * ui.scale;
    const float wrap = style.width > 2 * pad ? style.width - 2 * pad : 0;
    const ImVec2 inner = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap > 0 ? wrap : -1);
    const ImVec2 size(inner.x + 2 * pad, inner.y + pad);
    at.x = std::floor(at.x - style.anchorX * size.x);
    at.y = std::floor(at.y - style.anchorY * size.y);
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, faded(plateColor, style.alpha), 4 * ui.scale);
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {at.x + pad, at.y + 0.5f * pad},
                 faded(style.color, style.alpha), text.c_str(), nullptr, wrap);
    return size;
}

float labelWidth(const Ui& ui, const std::string& text) {
    return ImGui::CalcTextSize(text.c_str()).x + 12 * ui.scale;
}

std::string distanceText(double metres) {
    if (!std::isfinite(metres)) return "∞";
    return metres < 1 ? fmt::format("{:.1f} cm", 100 * metres) : fmt::format("{:.2f} m", metres);
}

void drawHud(const Ui& ui) {
    if (ui.picture.image) {
        drawDivider(ui);
        drawLegend(ui, drawStatus(ui));
        drawHover(ui);
    }
    drawFocusPoints(ui);
    drawMarker(ui);
    drawNotices(ui);
}

}  // namespace defocus::engine
