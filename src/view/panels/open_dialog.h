#pragma once
// Asks the user for a scene to open: with the desktop's file dialog or, if there is none, with the window's own
// browser.

#include <sys/types.h>

#include "view/state/view_state.h"

namespace defocus::engine {

// Runs the desktop's file dialog, zenity or kdialog, as a separate process.
class DesktopDialog {
public:
    DesktopDialog() = default;
    ~DesktopDialog();
    DesktopDialog(const DesktopDialog&) = delete;
    DesktopDialog& operator=(const DesktopDialog&) = delete;

    // Opens the dialog in `folder`. Returns false if neither zenity nor kdialog can be started.
    bool open(const std::filesystem::path& folder);
    [[nodiscard]] bool running() const { return process_ > 0; }
    struct Outcome {
        std::filesystem::path chosen;  // chosen file; empty: cancelled
        bool failed = false;           // true: the program could not show a dialog
    };
    // Returns the outcome once the dialog is closed; nullopt while it is open.
    std::optional<Outcome> take();

private:
    pid_t process_ = -1;
    int output_ = -1;
    std::string text_;
};

// The window's own dialog for choosing a scene file, drawn with ImGui.
class FileBrowser {
public:
    void open(const std::filesystem::path& folder);
    [[nodiscard]] bool opened() const { return opened_; }
    // Draws the dialog if it is open. Returns the scene once the user has chosen one.
    std::optional<std::filesystem::path> draw(float scale);

private:
    struct Entry {
        std::filesystem::path path;
        std::string name;
        bool folder = false;
    };
    void enter(const std::filesystem::path& folder);
    [[nodiscard]] bool shows(const Entry& entry) const;
    std::optional<std::filesystem::path> enterOrChoose(Entry entry);
    std::optional<std::filesystem::path> typed();
    std::optional<std::filesystem::path> pathRows();
    std::optional<std::filesystem::path> entryRows();

    bool opened_ = false;
    bool justOpened_ = false;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::string fault_;  // why the user's latest input had no effect
    std::string text_;   // text field: a path, or part of a name that filters the list
};

struct OpenDialog {
    DesktopDialog desktop;
    FileBrowser browser;
};

// Opens a dialog in the folder of the current scene.
void openSceneDialog(OpenDialog& dialog, const ViewState& state);

// Draws the built-in file browser if it is open. Returns the path of the scene once the user has chosen one.
std::optional<std::filesystem::path> drawOpenDialog(OpenDialog& dialog, const ViewState& state, float scale);

}  // namespace defocus::engine
