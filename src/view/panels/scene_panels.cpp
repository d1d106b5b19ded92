// Draws the panel sections for the scene: opening files, cameras, undo, saved views and animation.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "frame/report/plan_warnings.h"
#include "frame/setup/moment.h"
#include "view/panels/panels.h"
#include "view/state/key_commands.h"
#include "view/widgets/rows.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

// Draws a field for the scene's path, a button for the file dialog, and a menu of recent scenes.
void openRow(const Ui& ui) {
    ViewState& state = ui.state;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float arrow = ImGui::GetFrameHeight();
    const float button = ImGui::CalcTextSize("Open…").x + 2 * style.FramePadding.x;
    ImGui::SetNextItemWidth(-button - arrow - style.ItemSpacing.x - 1);
    const bool entered = ImGui::InputTextWithHint("##open", "enter or drop a .glb or .gltf", &state.openPath,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("open path");
    if (entered && !state.openPath.empty()) ui.actions.open = state.openPath;
    ImGui::SameLine();
    if (ImGui::Button("Open…")) ui.actions.openDialog = true;
    notePlace("open");
    tooltip("Choose a file (Ctrl O)");
    ImGui::SameLine(0, 1);
    if (ImGui::ArrowButton("##recent", ImGuiDir_Down)) ImGui::OpenPopup("recent");
    notePlace("recent");
    tooltip("Recent scenes");
    if (!ImGui::BeginPopup("recent")) return;
    if (state.recent.empty()) ImGui::TextDisabled("none yet");
    for (const std::filesystem::path& path : state.recent) {
        if (ImGui::MenuItem(path.filename().c_str())) ui.actions.open = path;
        notePlace("recent " + path.filename().string());
        tooltip(path.string());
    }
    ImGui::EndPopup();
}

void undoRow(const Ui& ui) {
    const auto button = [](const char* name, const char* help, bool enabled, bool& pressed) {
        ImGui::BeginDisabled(!enabled);
        if (ImGui::Button(name)) pressed = true;
        ImGui::EndDisabled();
        notePlace(name);
        tooltip(help);
        ImGui::SameLine();
    };
    const EditHistory& history = ui.document.history;
    button("Undo", "Undo changes to camera, lens, environment, levels and exposure (Ctrl Z)", history.undoSteps() > 0,
           ui.actions.undo);
    button("Redo", "Redo (Ctrl Shift Z)", history.redoSteps() > 0, ui.actions.redo);
    button("Reset all", "Restore the settings, camera and lens with which the scene was opened; can be undone",
           history.undoSteps() > 0, ui.actions.resetAll);
    ImGui::NewLine();
}

// Draws a list of the file's features that the program ignores.
void ignoredRows(const Scene& scene) {
    std::vector<std::string> lines = ignoredWarnings(scene);
    const std::vector<std::string> damage = damageWarnings(scene);
    lines.insert(lines.end(), damage.begin(), damage.end());
    if (lines.empty()) return;
    const bool open = ImGui::TreeNode("ignored", "Not drawn (%d)", static_cast<int>(lines.size()));
    notePlace("ignored");
    if (!open) return;
    for (const std::string& line : lines) ImGui::TextWrapped("%s", line.c_str());
    ImGui::TreePop();
}

void clipRow(const Scene& scene, ViewState& state) {
    if (scene.clips.size() < 2) return;
    std::vector<std::string> names;
    for (const AnimationClip& clip : scene.clips)
        names.push_back(fmt::format("{}: {}", names.size(), clip.name.empty() ? "clip" : clip.name));
    rowLabel("Clip", "Number and name of the animation (--clip)");
    std::string name = names[static_cast<std::size_t>(clipOf(state.options, scene))];
    if (combo("##clip", names, name))
        state.options.clip = clipText(scene, static_cast<int>(std::ranges::find(names, name) - names.begin()));
}

void shutterRows(Request& request) {
    settingRow(request, "shutter");
    if (!(request.shutter.value_or(0) > 0)) return;
    settingRow(request, "shutterPosition");
    rowLabel(
        "Motion segments",
        "Number of straight segments that approximate a vertex's path while the shutter is open (--motion-segments)");
    std::uint32_t segments = std::get<std::uint32_t>(request.motionSegments);
    if (slider("##segments", segments, 1, 64)) request.motionSegments = segments;
}

}  // namespace

void scenePanel(const Ui& ui) {
    openRow(ui);
    if (ui.document.frame == nullptr) return;
    ViewState& state = ui.state;
    ignoredRows(ui.scene());
    std::vector<std::string> cameras = cameraNames(ui.scene());
    cameras.insert(cameras.begin(), "auto");
    rowLabel("Camera", "Camera of the file (keys 1 … 9), or 'auto' to frame the scene (key 0)");
    std::string camera = settingNamed("camera")->text(state.options).value_or(ui.document.frame->cameraName);
    if (combo("##camera", cameras, camera)) ui.actions.chooseCamera = camera;
    rowLabel("Mouse", "orbit: turn the camera around the point in focus. fly: turn the camera on the spot (V)");
    enumCombo("##navigation", state.navigation, "orbit\0fly\0");
    if (ImGui::Button("Frame all")) frameScene(*ui.document.frame, state);
    ImGui::SameLine();
    if (ImGui::Button("Frame selection")) frameSelection(*ui.document.frame, state);
    undoRow(ui);
}

void viewsPanel(const Ui& ui) {
    ViewState& state = ui.state;
    ViewActions& actions = ui.actions;
    if (pathRow("view", "name of the view", "Save", state.viewName) && !state.viewName.empty())
        actions.saveView = state.viewName;
    notePlace("save view");
    if (state.savedViews.empty()) ImGui::TextDisabled("Save camera and lens for this scene");
    for (std::size_t i = 0; i < state.savedViews.size(); ++i) {
        const SavedView& view = state.savedViews[i];
        ImGui::PushID(static_cast<int>(i));
        const float button = ImGui::GetFrameHeight();
        const float width = ImGui::GetContentRegionAvail().x - button - ImGui::GetStyle().ItemSpacing.x;
        if (ImGui::Button(view.name.c_str(), {width, 0})) actions.goToView = i;
        notePlace("view " + view.name);
        tooltip(fmt::format("{:.3g} mm, f/{:.3g}, focused at {:.3g} m", view.lens.focalLength, view.lens.fStop,
                            view.lens.focusDistance));
        ImGui::SameLine();
        if (ImGui::Button("×", {button, 0})) actions.deleteView = i;
        tooltip("Delete the view");
        ImGui::PopID();
    }
}

void animationPanel(const Ui& ui) {
    ViewState& state = ui.state;
    const Scene& scene = ui.scene();
    clipRow(scene, state);
    if (ImGui::Button(state.playing ? "Pause" : "Play")) state.playing = !state.playing;
    tooltip("Space");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    const AnimationClip& clip = scene.clips[static_cast<std::size_t>(clipOf(state.options, scene))];
    if (slider("##time", state.options.time, 0, std::max(1e-3, static_cast<double>(clip.duration)), "%.2f s"))
        state.playing = false;
    rowLabel("Speed");
    slider("##speed", state.animationSpeed, 0.1, 4, "%.2f");
    shutterRows(state.options);
}

}  // namespace defocus::engine
