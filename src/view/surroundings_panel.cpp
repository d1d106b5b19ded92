#include "view/surroundings_panel.h"

#include <fmt/format.h>

namespace defocus {

void surroundingsSection(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!section("Surroundings", false)) return;
    ImGui::BeginDisabled(context.exporting);
    Request changed = state.options;
    rowLabel("Background", "What lies behind the scene and lights it (--background)");
    int background = static_cast<int>(state.options.background);
    if (ImGui::Combo("##background", &background, "environment\0none: transparent\0one colour\0")) {
        changed.background = static_cast<Background>(background);
        actions.changed = changed;
    }
    if (state.options.background == Background::uniform) {
        rowLabel("Colour", "Linear (--background R,G,B)");
        ImGui::ColorEdit3("##colour", state.options.backgroundColor.data(),
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR | ImGuiColorEditFlags_NoLabel);
        if (ImGui::IsItemDeactivatedAfterEdit()) actions.changed = state.options;
    } else {
        rowLabel("Environment", "An equirectangular .hdr or .exr (--environment)");
        if (pathRow("environment", "the scene's own", "Load", state.environmentPath)) {
            changed.environment = state.environmentPath;
            actions.changed = changed;
        }
    }
    ImGui::EndDisabled();
}

void apertureImageRow(const PanelContext& context, ViewState& state, ViewActions& actions) {
    ImGui::BeginDisabled(context.exporting);
    rowLabel("Image", "Light passes where it is bright, in place of blades and rings (--aperture-image)");
    if (pathRow("aperture", "none", "Load", state.aperturePath)) {
        actions.changed = state.options;
        actions.changed->lens.apertureImage = state.aperturePath;
    }
    ImGui::EndDisabled();
}

void nodeBlurRow(const PanelContext& context, const ViewState& state, ViewActions& actions) {
    if (state.selected < 0) return;
    const Scene& scene = *context.frame->scene;
    const int index = context.frame->world.pose.objects[static_cast<std::size_t>(state.selected)].node;
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    for (int i = 0; i < index; ++i)
        if (scene.nodes[static_cast<std::size_t>(i)].name == node.name) return;
    if (node.name.empty()) return;
    ImGui::BeginDisabled(context.exporting);
    rowLabel("Selection's blur",
             fmt::format("{}: scale of its blur, 0 keeps it sharp (--node-blur)", node.name).c_str());
    double scale = node.cocScale;
    const double least = 0;
    const double most = 4;
    if (ImGui::SliderScalar("##nodeBlur", ImGuiDataType_Double, &scale, &least, &most, "%.2f ×")) {
        actions.changed = state.options;
        actions.changed->nodeBlur[node.name] = scale;
    }
    ImGui::EndDisabled();
}

}  // namespace defocus
