// Draws the panel sections that analyse the image: overlays, comparisons, performance.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/panels/panels.h"
#include "view/widgets/rows.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

std::string shortCount(double count) {
    if (count >= 1e6) return fmt::format("{:.2f} M", 1e-6 * count);
    return count >= 1e4 ? fmt::format("{:.0f} k", 1e-3 * count) : fmt::format("{:.0f}", count);
}

void differenceRow(DisplaySettings& display) {
    rowLabel("Difference", "On the right side, show the difference from the left side (M)");
    ImGui::Checkbox("##difference", &display.difference);
    if (display.difference) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1);
        slider("##gain", display.differenceGain, 1, 64, "gain %.0f");
    }
}

}  // namespace

void overlayPanel(const Ui& ui) {
    rowLabel("Overlay", "Overlay: blur (C), level of detail (L), or work, in triangles per pixel per lens sample (N)");
    enumCombo("##overlay", ui.state.display.overlay, "none\0circle of confusion\0level of detail\0work\0");
    rowLabel("Wireframe", "Edges of the drawn triangles, coloured by level (Z)");
    ImGui::Checkbox("##wireframe", &ui.state.display.wireframe);
    if (!ui.picture.image) return;
    const FramePlan& plan = ui.picture.image->plan();
    const auto drawn = static_cast<double>(plan.trianglesDrawn);
    const auto fullDetail = static_cast<double>(plan.trianglesAtFullDetail);
    const double samples = std::max(1.0, static_cast<double>(plan.samples.size()));
    textRow("Objects drawn", fmt::format("{} of {}", plan.objects.size(), ui.pose().objects.size()));
    textRow("Triangles",
            fmt::format("{}, {:.0f} %", shortCount(drawn / samples), fullDetail > 0 ? 100 * drawn / fullDetail : 100),
            "Triangles drawn per lens sample, and as a fraction of full detail");
    if (!ImGui::TreeNode("left out", "Left out (%d)", static_cast<int>(plan.leftOut.size()))) return;
    for (const LeftOut& entry : plan.leftOut) ImGui::TextWrapped("%s: %s", entry.what.c_str(), entry.reason.c_str());
    ImGui::TreePop();
}

void comparePanel(const Ui& ui) {
    ViewState& state = ui.state;
    rowLabel("Right side", "The image to the right of the divider (X)");
    Comparison comparison = state.comparison;
    if (enumCombo("##comparison", comparison, "nothing\0full detail\0nearest level\0reference\0another method\0"))
        compare(state, comparison);
    if (state.comparison == Comparison::method) {
        rowLabel("Method");
        methodCombo(state.comparedMethod);
    }
    if (state.comparison != Comparison::none) differenceRow(state.display);
    if (ImGui::Button(state.poppingSince ? "Stop the popping test" : "Popping test")) togglePoppingTest(state);
    tooltip("Focus pull to compare pops: --lod fractional on the left, --lod nearest on the right (B)");
}

void performancePanel(const Ui& ui) {
    ViewState& state = ui.state;
    rowLabel("Frame budget", "Target frame time while the view changes; resolution and samples are adapted to it");
    slider("##budget", state.budget.milliseconds, 4, 250, "%.0f ms");
    const FrameQuality& quality = state.budget.quality();
    textRow("While moving", fmt::format("{} at {:.0f} % resolution",
                                        quality.samples == 1 ? "no blur" : fmt::format("{} samples", quality.samples),
                                        100 * quality.resolution));
    rowLabel("Max samples", "Maximum number of samples while the view does not change");
    if (slider("##samples", state.maxSamples, 64, 16384, ImGuiSliderFlags_Logarithmic))
        state.maxSamples = (state.maxSamples + 63) / 64 * 64;
    settingRow(state.options, "targetError");
    if (ui.picture.image) {
        std::vector<PassTime> parts = ui.picture.image->passes();
        parts.push_back({"interface", ui.times.interface});
        timeBar(parts, state.budget.milliseconds, ui.scale);
    }
    const std::vector<float>& times = ui.times.recent;
    ImGui::SetNextItemWidth(-1);
    ImGui::PlotHistogram("##times", times.data(), static_cast<int>(times.size()), 0, nullptr, 0,
                         2 * static_cast<float>(state.budget.milliseconds), {0, 48 * ui.scale});
    tooltip("Times of the latest frames; half the height is the frame budget");
    const InputLatency::Summary latency = ui.times.latency.summary();
    if (latency.count > 0)
        textRow("Input to image", fmt::format("{:.0f} ms, max {:.0f} ms", latency.median, latency.worst),
                "Median and maximum time from an input event to the end of the frame that shows its effect");
    ImGui::TextDisabled("%s", ui.device.c_str());
}

}  // namespace defocus::engine
