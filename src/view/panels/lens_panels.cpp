// Draws the panel sections for focus, lens, aperture and exposure.

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "view/panels/panels.h"
#include "view/widgets/rows.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

void fieldRows(ViewState& state, LensSection section) {
    for (const LensField& field : lensFields()) {
        if (field.section != section) continue;
        const bool changed = lensFieldRow(state.lens, field);
        if (changed && field.name == std::string_view("focusDistance")) state.pull.reset();
    }
}

void focusPointsRow(ViewState& state) {
    rowLabel("Focus points",
             "Tilt the focus plane through three points: Ctrl click on them in the image (--focus-points)");
    if (state.focusPoints.empty())
        ImGui::TextDisabled("Ctrl click on three points");
    else
        ImGui::Text("%d of 3", static_cast<int>(state.focusPoints.size()));
    const bool tilted = state.lens.focusTilt != 0 || state.lens.focusSwing != 0;
    if (state.focusPoints.empty() && !tilted) return;
    ImGui::SameLine();
    if (!ImGui::SmallButton("Reset")) return;
    state.focusPoints.clear();
    state.lens.focusTilt = state.lens.focusSwing = 0;
}

// Draws the slider for the blur scale of the selected object's node. Draws nothing unless the node is the first one
// with its name, because --node-blur refers to nodes by name.
void nodeBlurRow(const Ui& ui) {
    if (ui.state.selected < 0) return;
    const std::vector<Node>& nodes = ui.scene().nodes;
    const int index = ui.pose().objects[static_cast<std::size_t>(ui.state.selected)].node;
    const Node& node = nodes[static_cast<std::size_t>(index)];
    const auto first = std::ranges::find(nodes, node.name, &Node::name);
    if (node.name.empty() || first - nodes.begin() != index) return;
    ImGui::BeginDisabled(ui.still.has_value());
    rowLabel("Selection's blur",
             fmt::format("Multiplier for the blur of {}; 0 keeps it sharp (--node-blur)", node.name));
    double scale = node.cocScale;
    if (slider("##nodeBlur", scale, 0, 4, "%.2f ×")) ui.state.options.nodeBlur[node.name] = scale;
    ImGui::EndDisabled();
}

// Shows the number of stored lens images (images of single lens samples), which allow changes of focus and f-number
// without rendering. The tooltip says why none are stored.
void lensImagesRow(const Ui& ui) {
    const KeptImages* const kept = ui.picture.image ? ui.picture.image->keptImages() : nullptr;
    std::string about =
        "Images of single lens samples, kept while the view is still. If you change the focus or stop down, the "
        "displayed image is computed from them without rendering";
    if (kept == nullptr || kept->planned() == 0) {
        if (kept != nullptr && !kept->obstacle().empty()) about += ". There are none: " + kept->obstacle();
        return textRow("Lens images", "none", about.c_str());
    }
    textRow("Lens images", fmt::format("{} of {}", kept->drawn(), kept->planned()), about.c_str());
}

}  // namespace

void focusPanel(const Ui& ui) {
    if (ui.picture.image) depthDiagram(ui.picture.image->plan(), ui.scale);
    fieldRows(ui.state, LensSection::focus);
    focusPointsRow(ui.state);
    nodeBlurRow(ui);
    lensImagesRow(ui);
    ImGui::Checkbox("Peaking", &ui.state.display.focusPeaking);
    tooltip("Mark edges that are in focus (P)");
    ImGui::SameLine();
    ImGui::Checkbox("Focus plane", &ui.state.display.focusPlane);
    tooltip("Tint surfaces in focus (O)");
}

void lensPanel(const Ui& ui) {
    stopRing(ui.state.lens.fStop, ui.scale);
    fieldRows(ui.state, LensSection::lens);
}

void aperturePanel(const Ui& ui) {
    aperturePreview(ui.state.lens, ui.scale);
    ImGui::BeginDisabled(ui.still.has_value());
    rowLabel("Image",
             "Image of the aperture: bright pixels transmit light. Replaces blades and obstruction (--aperture-image)");
    if (pathRow("aperture", "none", "Load", ui.state.aperturePath))
        ui.state.options.lens.apertureImage = ui.state.aperturePath;
    ImGui::EndDisabled();
    fieldRows(ui.state, LensSection::aperture);
}

void imagePanel(const Ui& ui) {
    ViewState& state = ui.state;
    const bool setByLens = state.lens.exposureTime > 0;
    rowLabel("Exposure");
    double exposure = shownExposure(state);
    ImGui::BeginDisabled(setByLens || state.meters);
    if (slider("##exposure", exposure, -8, 8, "%+.2f EV")) state.exposure = exposure;
    ImGui::EndDisabled();
    ImGui::BeginDisabled(setByLens);
    rowLabel("Auto-exposure", "Meter the scene whenever the view stops changing (--exposure auto)");
    ImGui::Checkbox("##meters", &state.meters);
    notePlace("auto-exposure");
    ImGui::EndDisabled();
    settingRow(state.options, "toneMap");
}

}  // namespace defocus::engine
