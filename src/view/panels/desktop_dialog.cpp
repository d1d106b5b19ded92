#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <vector>

#include "view/panels/open_dialog.h"

extern char** environ;

namespace defocus::engine {

namespace {

// Starts a program from $PATH with its standard output redirected to `output`. Returns the process id; −1 if the
// program is not installed.
pid_t startProgram(std::vector<std::string> command, int output) {
    std::vector<char*> words;
    for (std::string& word : command) words.push_back(word.data());
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    pid_t process = -1;
    const int fault = ::posix_spawnp(&process, words[0], &actions, nullptr, words.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return fault == 0 ? process : -1;
}

}  // namespace

DesktopDialog::~DesktopDialog() {
    if (!running()) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
    ::close(output_);
}

bool DesktopDialog::open(const std::filesystem::path& folder) {
    if (running()) return true;
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return false;
    const std::string begin = (folder / "").string();
    process_ = startProgram({"zenity", "--file-selection", "--title=Open a scene", "--filename=" + begin,
                             "--file-filter=glTF scenes | *.glb *.gltf *.GLB *.GLTF", "--file-filter=All files | *"},
                            ends[1]);
    if (!running())
        process_ = startProgram(
            {"kdialog", "--title", "Open a scene", "--getopenfilename", begin, "glTF scenes (*.glb *.gltf)"}, ends[1]);
    ::close(ends[1]);
    if (!running()) {
        ::close(ends[0]);
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
    constexpr int cancelled = 1;  // exit code of zenity and kdialog for a cancelled dialog
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    if (!text_.empty() && text_.back() == '\n') text_.pop_back();
    return Outcome{code == 0 ? std::filesystem::path(text_) : std::filesystem::path(), code != 0 && code != cancelled};
}

}  // namespace defocus::engine
