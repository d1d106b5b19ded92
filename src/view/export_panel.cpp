#include "view/export_panel.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace defocus {

namespace {

// Size and samples of a still; the field of its path comes before.
void stillRows(const PanelContext& context, ViewState& state) {
    const glm::ivec2 size = state.exportSize.value_or(context.pictureSize);
    std::array<int, 2> edited = {size.x, size.y};
    rowLabel("Size", "px; the picture's own unless it is given");
    if (ImGui::InputInt2("##size", edited.data()))
        state.exportSize = glm::ivec2(std::clamp(edited[0], 1, 16384), std::clamp(edited[1], 1, 16384));
    rowLabel("Samples");
    int samples = static_cast<int>(state.options.settings.sampleCount);
    if (ImGui::SliderInt("##samples", &samples, 1, 4096, samples == 0 ? "auto" : "%d", ImGuiSliderFlags_Logarithmic))
        state.options.stop.sampleLimit = state.options.settings.sampleCount =
            static_cast<std::uint32_t>(std::clamp(samples, 1, static_cast<int>(mostSamples)));
}

bool isThere(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

}  // namespace

std::string freeName(const std::string& path) {
    const std::filesystem::path given(path);
    for (int i = 2;; ++i) {
        std::filesystem::path next = given;
        next.replace_filename(fmt::format("{}-{}{}", given.stem().string(), i, given.extension().string()));
        if (!isThere(next.string())) return next.string();
    }
}

void exportSection(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!section("Export", false)) return;
    stillRows(context, state);
    if (context.exporting) {
        ImGui::ProgressBar(static_cast<float>(context.exportShare), {-ImGui::GetFontSize() * 5, 0});
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) actions.cancelExport = true;
    } else {
        if (ImGui::Button("Export still…")) actions.askExport = true;
        notePlace("export still");
        tooltip("Asks where it shall go (Ctrl E)");
        ImGui::SameLine();
        if (ImGui::Button("Copy as command")) actions.copyCommand = true;
        tooltip("Puts the 'defocus render' command that makes this picture on the clipboard (Ctrl C)");
    }
    rowLabel("Shot", "Key frames, two seconds apart, for 'defocus capture'");
    ImGui::InputText("##shot", &state.shotPath);
    if (ImGui::Button("Record key")) actions.recordKey = true;
    tooltip("Camera, lens and focus as they are now (K)");
    if (state.shotKeys.empty()) return;
    ImGui::SameLine();
    if (ImGui::Button(fmt::format("Save {} keys###save", state.shotKeys.size()).c_str())) actions.saveShot = true;
    ImGui::SameLine();
    if (ImGui::Button("Forget")) state.shotKeys.clear();
}

void drawExportDialog(const PanelContext& context, ViewState& state, ViewActions& actions) {
    if (!state.exportDialog) return;
    constexpr const char* title = "Export a still";
    ExportDialog& dialog = *state.exportDialog;
    if (dialog.fresh) ImGui::OpenPopup(title);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(460 * context.scale, window.x - 8), 0});
    bool stays = true;
    if (!ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        state.exportDialog.reset();
        return;
    }
    rowLabel("File", ".exr is linear, .png and .jpg are tone-mapped");
    if (std::exchange(dialog.fresh, false)) ImGui::SetKeyboardFocusHere();
    const std::string before = state.exportPath;
    bool confirmed = ImGui::InputText("##file", &state.exportPath,
                                      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    if (state.exportPath != before) dialog.asksToReplace = false;
    stillRows(context, state);
    if (dialog.asksToReplace) {
        ImGui::PushStyleColor(ImGuiCol_Text, context.colors.warm);
        ImGui::TextWrapped("%s is there already. Replace it?", state.exportPath.c_str());
        ImGui::PopStyleColor();
        confirmed = ImGui::Button("Replace");
        notePlace("replace");
        ImGui::SameLine();
        const std::string other = freeName(state.exportPath);
        if (ImGui::Button(fmt::format("Write {}###other", std::filesystem::path(other).filename().string()).c_str())) {
            state.exportPath = other;
            confirmed = true;
        }
        notePlace("another name");
    } else {
        confirmed = ImGui::Button("Export") || confirmed;
        notePlace("export");
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) stays = false;
    if (confirmed && !state.exportPath.empty()) {
        if (!dialog.asksToReplace && isThere(state.exportPath)) {
            dialog.asksToReplace = true;
        } else {
            actions.exportStill = true;
            stays = false;
        }
    }
    if (!stays) {
        state.exportDialog.reset();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

}  // namespace defocus
