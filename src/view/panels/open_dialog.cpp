#include "view/panels/open_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "view/widgets/widgets.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool isScene(const fs::path& path) {
    const std::string extension = lower(path.extension().string());
    return extension == ".glb" || extension == ".gltf";
}

std::string homeFolder() {
    const char* const home = std::getenv("HOME");
    return home == nullptr ? "" : home;
}

fs::path sceneFolder(const ViewState& state) {
    const fs::path& scene = state.options.scene;
    std::error_code ignored;
    return scene.empty() ? fs::current_path(ignored) : fs::absolute(scene).parent_path();
}

}  // namespace

void FileBrowser::open(const fs::path& folder) {
    opened_ = justOpened_ = true;
    enter(folder);
}

// Lists a folder. If the folder can't be read, keeps the current list and sets fault_.
void FileBrowser::enter(const fs::path& folder) {
    std::error_code fault;
    fs::directory_iterator files(folder, fs::directory_options::skip_permission_denied, fault);
    fault_ = fault ? folder.string() + ": " + fault.message() : "";
    text_.clear();
    if (fault) return;
    folder_ = fs::absolute(folder).lexically_normal();
    entries_.clear();
    for (; files != fs::directory_iterator(); files.increment(fault)) {
        std::error_code ignored;
        const std::string name = files->path().filename().string();
        const bool isFolder = files->is_directory(ignored);
        if (!name.starts_with('.') && (isFolder || isScene(files->path())))
            entries_.push_back({files->path(), name, isFolder});
        if (fault) break;
    }
    std::ranges::sort(entries_, [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : lower(a.name) < lower(b.name);
    });
}

bool FileBrowser::shows(const Entry& entry) const {
    return lower(entry.name).find(lower(text_)) != std::string::npos;
}

// Enters a folder, or returns the path of a file. `entry` is passed by value, because entering a folder replaces
// entries_.
std::optional<fs::path> FileBrowser::enterOrChoose(Entry entry) {
    if (!entry.folder) return entry.path;
    enter(entry.path);
    return std::nullopt;
}

// Handles Enter in the text field: opens the typed path or, if it doesn't exist, the first entry in the list.
std::optional<fs::path> FileBrowser::typed() {
    const fs::path path = text_.starts_with('~') ? fs::path(homeFolder() + text_.substr(1)) : folder_ / text_;
    std::error_code ignored;
    const bool isFolder = fs::is_directory(path, ignored);
    if (!text_.empty() && (isFolder || fs::is_regular_file(path, ignored))) return enterOrChoose({path, "", isFolder});
    const auto first = std::ranges::find_if(entries_, [&](const Entry& entry) { return shows(entry); });
    if (first != entries_.end()) return enterOrChoose(*first);
    fault_ = "'" + text_ + "' does not exist in this folder";
    return std::nullopt;
}

std::optional<fs::path> FileBrowser::pathRows() {
    ImGui::BeginDisabled(!folder_.has_relative_path());
    if (ImGui::Button("Up")) enter((folder_ / "..").lexically_normal());
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Home") && !homeFolder().empty()) enter(homeFolder());
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(folder_.c_str());

    std::optional<fs::path> chosen;
    if (std::exchange(justOpened_, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##name", "part of a name, or a path", &text_, ImGuiInputTextFlags_EnterReturnsTrue))
        chosen = typed();
    if (!fault_.empty()) ImGui::TextWrapped("%s", fault_.c_str());
    return chosen;
}

std::optional<fs::path> FileBrowser::entryRows() {
    const Entry* clicked = nullptr;
    int rows = 0;
    for (const Entry& entry : entries_) {
        if (!shows(entry)) continue;
        ImGui::PushID(rows++);
        if (ImGui::Selectable((entry.folder ? entry.name + "/" : entry.name).c_str())) clicked = &entry;
        notePlace("file " + entry.name);
        ImGui::PopID();
    }
    if (rows == 0)
        ImGui::TextDisabled("%s", entries_.empty() ? "no scenes in this folder" : "no file name contains this text");
    return clicked == nullptr ? std::nullopt : enterOrChoose(*clicked);
}

std::optional<fs::path> FileBrowser::draw(float scale) {
    if (!opened_) return std::nullopt;
    constexpr const char* title = "Open a scene";
    if (justOpened_) ImGui::OpenPopup(title);
    centreDialog(680 * scale, 460 * scale);
    bool open = true;
    if (!ImGui::BeginPopupModal(title, &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return std::nullopt;
    std::optional<fs::path> chosen = pathRows();
    ImGui::BeginChild("files", {0, -ImGui::GetFrameHeightWithSpacing()}, true);
    if (const auto path = entryRows()) chosen = path;
    ImGui::EndChild();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) open = false;
    ImGui::SameLine();
    ImGui::TextDisabled("Enter opens the first entry");
    if (!open || chosen) {
        opened_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return chosen;
}

void openSceneDialog(OpenDialog& dialog, const ViewState& state) {
    if (dialog.desktop.running() || dialog.browser.opened() || state.exportDialog) return;
    const fs::path folder = sceneFolder(state);
    if (!dialog.desktop.open(folder)) dialog.browser.open(folder);
}

std::optional<fs::path> drawOpenDialog(OpenDialog& dialog, const ViewState& state, float scale) {
    std::optional<fs::path> chosen = dialog.browser.draw(scale);
    const std::optional<DesktopDialog::Outcome> outcome = dialog.desktop.take();
    if (outcome && !outcome->chosen.empty()) chosen = outcome->chosen;
    if (outcome && outcome->failed && !dialog.browser.opened() && !state.exportDialog)
        dialog.browser.open(sceneFolder(state));
    return chosen;
}

}  // namespace defocus::engine
