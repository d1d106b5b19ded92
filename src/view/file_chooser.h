#pragma once
// Asks where a scene lies: by the desktop's own dialog (zenity or kdialog) where there is one, else by a browser of the
// window's own.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "view/widgets.h"

namespace defocus {

// A dialog of the desktop, which runs beside the window.
class DesktopDialog {
public:
    DesktopDialog() = default;
    ~DesktopDialog();
    DesktopDialog(const DesktopDialog&) = delete;
    DesktopDialog& operator=(const DesktopDialog&) = delete;

    // Begins in `folder`. False where no program for it is found on $PATH, or it doesn't start.
    bool open(const std::filesystem::path& folder);
    [[nodiscard]] bool running() const { return process_ > 0; }
    struct Outcome {
        std::filesystem::path chosen;  // empty: nothing
        bool failed = false;           // the program couldn't show its dialog
    };
    // Once it is closed. Nothing while it is open.
    std::optional<Outcome> take();

private:
    void stop();

    pid_t process_ = -1;
    int output_ = -1;
    std::string text_;
};

// Folders and scenes to walk through, drawn by Dear ImGui over the picture.
class FileBrowser {
public:
    void open(const std::filesystem::path& folder, std::vector<std::filesystem::path> recent);
    void close() { opened_ = false; }
    [[nodiscard]] bool opened() const { return opened_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    // Once a scene is chosen: its path.
    std::optional<std::filesystem::path> draw(float scale);

private:
    struct Entry {
        std::filesystem::path path;
        std::string name;
        bool folder = false;
    };
    void enter(const std::filesystem::path& folder);
    std::optional<std::filesystem::path> entryRows();
    std::optional<std::filesystem::path> recentRows() const;
    [[nodiscard]] std::optional<std::filesystem::path> typed();

    bool opened_ = false;
    bool justOpened_ = false;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::string fault_;  // why the folder can't be read
    std::string text_;   // a path, or a part of the names that are shown
    std::vector<std::filesystem::path> recent_;
};

}  // namespace defocus
