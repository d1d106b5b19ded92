// Draws the panel section for exporting stills, commands and shots, and the dialog for a still's file name.

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "view/panels/panels.h"
#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

bool fileExists(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

// Returns an unused file name: for "still.png", the first of "still-2.png", "still-3.png" … that doesn't exist.
std::string freeName(const std::string& path) {
    const fs::path given(path);
    for (int i = 2;; ++i) {
        fs::path next = given;
        next.replace_filename(fmt::format("{}-{}{}", given.stem().string(), i, given.extension().string()));
        if (!fileExists(next)) return next.string();
    }
}

// Draws the rows that set the size and the number of samples of a still.
void stillRows(ViewState& state) {
    const glm::ivec2 size = state.exportSize.value_or(state.pictureSize);
    std::array<int, 2> edited = {size.x, size.y};
    rowLabel("Size", "Size of the still in px. Default: the size of the image");
    if (ImGui::InputInt2("##size", edited.data()))
        state.exportSize = glm::ivec2(std::clamp(edited[0], 1, 16384), std::clamp(edited[1], 1, 16384));
    rowLabel("Samples");
    std::uint32_t samples = renderSettings(state.options).sampleCount;
    if (slider("##samples", samples, 1, 4096, ImGuiSliderFlags_Logarithmic)) state.options.samples = samples;
}

// Asks, inside the dialog, whether to replace the existing file or to write a new one. Returns true once the user has
// chosen.
bool replaceRows(const Ui& ui) {
    std::string& path = ui.state.exportPath;
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(ImGuiCol_PlotHistogramHovered));
    ImGui::TextWrapped("%s exists. Replace it?", path.c_str());
    ImGui::PopStyleColor();
    bool chosen = ImGui::Button("Replace");
    notePlace("replace");
    ImGui::SameLine();
    const std::string other = freeName(path);
    if (ImGui::Button(fmt::format("Write {}###other", fs::path(other).filename().string()).c_str())) {
        path = other;
        chosen = true;
    }
    notePlace("another name");
    return chosen;
}

// Draws the contents of the dialog. Returns false once the dialog should close.
bool dialogRows(const Ui& ui, ExportDialog& dialog) {
    std::string& path = ui.state.exportPath;
    rowLabel("File", ".exr is linear, .png and .jpg are tone-mapped");
    if (std::exchange(dialog.fresh, false)) ImGui::SetKeyboardFocusHere();
    const std::string before = path;
    bool confirmed =
        ImGui::InputText("##file", &path, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (path != before) dialog.asksToReplace = false;
    stillRows(ui.state);
    const bool replaces = dialog.asksToReplace;
    if (replaces) {
        confirmed = replaceRows(ui);
    } else {
        confirmed = ImGui::Button("Export") || confirmed;
        notePlace("export");
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) return false;
    if (!confirmed || path.empty()) return true;
    dialog.asksToReplace = !replaces && fileExists(path);
    ui.actions.exportStill = !dialog.asksToReplace;
    return dialog.asksToReplace;
}

}  // namespace

void exportPanel(const Ui& ui) {
    ViewState& state = ui.state;
    ViewActions& actions = ui.actions;
    ImGui::BeginDisabled(ui.still.has_value());
    if (ImGui::Button("Export still…")) actions.askExport = true;
    ImGui::EndDisabled();
    notePlace("export still");
    tooltip("Choose a file and export a still (Ctrl E)");
    ImGui::SameLine();
    if (ImGui::Button("Copy as command")) actions.copyCommand = true;
    tooltip("Copy the 'defocus render' command that renders this image (Ctrl C)");
    rowLabel("Shot", "Keyframes for 'defocus capture', 2 s apart");
    ImGui::InputText("##shot", &state.shotPath);
    if (ImGui::Button("Record keyframe")) actions.recordKey = true;
    tooltip("Record camera, lens and focus as a keyframe (K)");
    if (state.shotKeys.empty()) return;
    ImGui::SameLine();
    if (ImGui::Button(fmt::format("Save {} keyframes###save", state.shotKeys.size()).c_str())) actions.saveShot = true;
    ImGui::SameLine();
    if (ImGui::Button("Discard")) state.shotKeys.clear();
}

void drawExportDialog(const Ui& ui) {
    std::optional<ExportDialog>& dialog = ui.state.exportDialog;
    if (!dialog) return;
    constexpr const char* title = "Export a still";
    if (dialog->fresh) ImGui::OpenPopup(title);
    centreDialog(460 * ui.scale);
    bool open = true;
    if (!ImGui::BeginPopupModal(title, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        dialog.reset();
        return;
    }
    const bool stays = dialogRows(ui, *dialog);
    if (!stays || !open) {
        dialog.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace defocus::engine
