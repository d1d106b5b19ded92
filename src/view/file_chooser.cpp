#include "view/file_chooser.h"

#include <fcntl.h>
#include <imgui_stdlib.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <sstream>

extern char** environ;

namespace defocus {

namespace {

namespace fs = std::filesystem;

// The program's path, as a shell would find it.
fs::path onPath(const std::string& program) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path file = fs::path(folder) / program;
        if (::access(file.c_str(), X_OK) == 0) return file;
    }
    return {};
}

std::vector<std::string> dialogCommand(const fs::path& folder) {
    const std::string begin = (folder / "").string();
    if (const fs::path zenity = onPath("zenity"); !zenity.empty())
        return {zenity.string(),
                "--file-selection",
                "--title=Open a scene",
                "--filename=" + begin,
                "--file-filter=glTF scenes | *.glb *.gltf *.GLB *.GLTF",
                "--file-filter=All files | *"};
    if (const fs::path kdialog = onPath("kdialog"); !kdialog.empty())
        return {kdialog.string(), "--title", "Open a scene", "--getopenfilename", begin, "glTF scenes (*.glb *.gltf)"};
    return {};
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool isScene(const fs::path& path) {
    const std::string extension = lower(path.extension().string());
    return extension == ".glb" || extension == ".gltf";
}

}  // namespace

// ---- the desktop's dialog -----------------------------------------------------------------------

DesktopDialog::~DesktopDialog() {
    stop();
}

bool DesktopDialog::open(const fs::path& folder) {
    if (running()) return true;
    std::vector<std::string> command = dialogCommand(folder);
    int ends[2];
    if (command.empty() || ::pipe2(ends, O_CLOEXEC) != 0) return false;
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    const int fault = ::posix_spawn(&process_, words[0], &actions, nullptr, words.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (fault != 0) {
        ::close(ends[0]);
        process_ = -1;
        return false;
    }
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    output_ = ends[0];
    text_.clear();
    return true;
}

std::optional<DesktopDialog::Outcome> DesktopDialog::take() {
    if (!running()) return std::nullopt;
    std::array<char, 4096> bytes;
    ssize_t count = 0;
    while ((count = ::read(output_, bytes.data(), bytes.size())) > 0)
        text_.append(bytes.data(), static_cast<std::size_t>(count));
    int status = 0;
    if (count != 0 || ::waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
    process_ = -1;
    ::close(output_);
    constexpr int cancelled = 1;  // of zenity and kdialog
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (!text_.empty() && text_.back() == '\n') text_.pop_back();
    return Outcome{code == 0 ? fs::path(text_) : fs::path(), code != 0 && code != cancelled};
}

void DesktopDialog::stop() {
    if (!running()) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
    ::close(output_);
    process_ = -1;
}

// ---- the window's own ---------------------------------------------------------------------------

void FileBrowser::open(const fs::path& folder, std::vector<fs::path> recent) {
    opened_ = justOpened_ = true;
    recent_ = std::move(recent);
    enter(folder);
}

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

// What Enter in the field means: a path, or the only name that is left.
std::optional<fs::path> FileBrowser::typed() {
    const fs::path path = text_.starts_with('~') && std::getenv("HOME") != nullptr
                              ? fs::path(std::getenv("HOME") + text_.substr(1))
                              : folder_ / text_;
    std::error_code ignored;
    if (!text_.empty() && fs::is_directory(path, ignored)) {
        enter(path);
        return std::nullopt;
    }
    if (!text_.empty() && fs::is_regular_file(path, ignored)) return path;
    const Entry* first = nullptr;
    for (const Entry& entry : entries_)
        if (first == nullptr && lower(entry.name).find(lower(text_)) != std::string::npos) first = &entry;
    if (first == nullptr) {
        fault_ = "there is no '" + text_ + "' here";
    } else if (first->folder) {
        enter(fs::path(first->path));
    } else {
        return first->path;
    }
    return std::nullopt;
}

std::optional<fs::path> FileBrowser::entryRows() {
    std::optional<fs::path> chosen;
    fs::path next;
    int index = 0;
    for (const Entry& entry : entries_) {
        if (lower(entry.name).find(lower(text_)) == std::string::npos) continue;
        ImGui::PushID(index++);
        const std::string label = entry.folder ? entry.name + "/" : entry.name;
        if (ImGui::Selectable(label.c_str())) {
            if (entry.folder)
                next = entry.path;
            else
                chosen = entry.path;
        }
        notePlace("file " + entry.name);
        ImGui::PopID();
    }
    if (index == 0) ImGui::TextDisabled("%s", entries_.empty() ? "no scenes here" : "no name has this in it");
    if (!next.empty()) enter(next);
    return chosen;
}

std::optional<fs::path> FileBrowser::recentRows() const {
    std::optional<fs::path> chosen;
    if (recent_.empty()) ImGui::TextDisabled("none yet");
    for (const fs::path& path : recent_) {
        ImGui::PushID(path.c_str());
        if (ImGui::Selectable(path.filename().c_str())) chosen = path;
        tooltip(path.string());
        ImGui::PopID();
    }
    return chosen;
}

std::optional<fs::path> FileBrowser::draw(float scale) {
    if (!opened_) return std::nullopt;
    constexpr const char* title = "Open a scene";
    if (justOpened_) ImGui::OpenPopup(title);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(680 * scale, window.x - 8), std::min(460 * scale, window.y - 8)});
    bool stays = true;
    std::optional<fs::path> chosen;
    if (!ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return chosen;
    ImGui::BeginDisabled(!folder_.has_relative_path());
    if (ImGui::Button("Up")) enter(folder_.parent_path().empty() ? folder_ : (folder_ / "..").lexically_normal());
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Home") && std::getenv("HOME") != nullptr) enter(std::getenv("HOME"));
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(folder_.c_str());

    if (std::exchange(justOpened_, false)) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##name", "part of a name, or a path", &text_, ImGuiInputTextFlags_EnterReturnsTrue))
        chosen = typed();
    if (!fault_.empty()) ImGui::TextWrapped("%s", fault_.c_str());

    const float bottom = -ImGui::GetFrameHeightWithSpacing();
    const float left = 200 * scale;
    ImGui::BeginChild("recent", {left, bottom}, true);
    ImGui::TextDisabled("Recent");
    if (const auto path = recentRows()) chosen = path;
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("files", {0, bottom}, true);
    if (const auto path = entryRows()) chosen = path;
    ImGui::EndChild();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) stays = false;
    ImGui::SameLine();
    ImGui::TextDisabled("Enter opens the first; a file can be dropped on the window, too");
    if (!stays || chosen) {
        opened_ = false;
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return chosen;
}

}  // namespace defocus
