#include "view/surroundings_panel.h"

#include <fmt/format.h>

#include "scene/built_in_environment.h"
#include "view/widgets.h"

namespace defocus {

namespace {

// The scene's own surroundings, those that are built in, and a file.
void environmentRows(ViewState& state, ViewActions& actions) {
    const std::string current = state.options.environment.string();
    std::vector<std::string> names = {"the scene's own"};
    for (const std::string_view name : builtInEnvironments()) names.emplace_back(name);
    names.emplace_back("a file");
    const bool ofFile = state.environmentOfFile || (!current.empty() && !isBuiltInEnvironment(current));
    rowLabel("Environment", "What lights the scene and lies behind it (--environment)");
    const int chosen = combo("##environment", names, ofFile ? names.back() : current.empty() ? names[0] : current);
    if (chosen >= 0) {
        state.environmentOfFile = chosen + 1 == static_cast<int>(names.size());
        if (!state.environmentOfFile) {
            actions.changed = state.options;
            actions.changed->environment = chosen == 0 ? "" : names[static_cast<std::size_t>(chosen)];
        }
    }
    if (ofFile) {
        rowLabel("File", "An equirectangular .hdr or .exr");
        if (pathRow("environment", "sky.hdr", "Load", state.environmentPath)) {
            actions.changed = state.options;
            actions.changed->environment = state.environmentPath;
        }
    }
    if (current.empty()) return;
    rowLabel("Rotation", "Counter-clockwise, seen from above (--environment-rotation)");
    const double least = -180, most = 180;
    ImGui::SliderScalar("##rotation", ImGuiDataType_Double, &state.options.environmentRotation, &least, &most, "%.0f°",
                        ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemDeactivatedAfterEdit()) actions.changed = state.options;
}

// A size of lights: their own, or one for all.
void lightSizeRow(const char* name, const char* label, const char* tooltip, double first, double most,
                  const char* format, std::optional<double>& size) {
    ImGui::PushID(name);
    rowLabel(label, tooltip);
    bool given = size.has_value();
    if (ImGui::Checkbox("##given", &given)) size = given ? std::optional(first) : std::nullopt;
    notePlace(name);
    ImGui::SameLine();
    if (size) {
        const double least = 0;
        ImGui::SetNextItemWidth(-1);
        ImGui::SliderScalar("##size", ImGuiDataType_Double, &*size, &least, &most, format,
                            ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    } else {
        ImGui::TextDisabled("their own");
    }
    ImGui::PopID();
}

void shadowRows(ViewState& state, ViewActions& actions) {
    rowLabel("Ground", "A grey ground beneath the scene, which catches its shadows (--ground)");
    bool ground = state.options.ground;
    if (ImGui::Checkbox("##ground", &ground)) {
        actions.changed = state.options;
        actions.changed->ground = ground;
    }
    rowLabel("Shadows", "Soft shadows of lights and surroundings (--shadows)");
    const std::vector<std::string> names = {"with a ground", "on", "off"};
    const int chosen = combo("##shadows", names, names[static_cast<std::size_t>(state.options.settings.shadows)]);
    if (chosen >= 0) state.options.settings.shadows = static_cast<Shadows>(chosen);
    const Shadows shadows = state.options.settings.shadows;
    if (shadows == Shadows::off || (shadows == Shadows::automatic && !state.options.ground)) return;
    lightSizeRow("lightAngle", "Suns' size", "What directional lights measure across (--light-angle)", 5, 90, "%.3g°",
                 state.options.lightAngle);
    lightSizeRow("lightRadius", "Lamps' radius", "Radius of point and spot lights (--light-radius)", 0.1, 10, "%.3g m",
                 state.options.lightRadius);
}

}  // namespace

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
        environmentRows(state, actions);
    }
    shadowRows(state, actions);
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
