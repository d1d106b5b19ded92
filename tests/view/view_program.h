#pragma once
// Runs `defocus view` on its own X server (Xvfb), with mouse and key events from xdotool. The program writes its state
// to a JSON file. After each input event, tests wait for frames that include the event, however long that takes; they
// never sleep for a fixed time.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "cli/run_program.h"

namespace defocus::engine {

class ViewProgram : public testing::Test {
protected:
    static void SetUpTestSuite() { beginServer({"-screen", "0", "1280x800x24"}); }
    static void TearDownTestSuite() { endServer(); }

    // Starts Xvfb; `words` are its command-line arguments that describe the screen.
    static void beginServer(std::vector<std::string> words) {
        if (std::system("command -v Xvfb xdotool >/dev/null 2>&1") != 0) return;
        int ends[2];
        if (::pipe(ends) != 0) return;
        server_ = ::fork();
        if (server_ == 0) {
            endWithTheTest();
            ::dup2(ends[1], 3);
            silence();
            // -r turns key repeat off, since key press and release may be far apart in time on a slow machine.
            const std::vector<std::string> others = {"-displayfd", "3", "-noreset", "-r", "-nolisten", "tcp"};
            words.insert(words.begin(), "Xvfb");
            words.insert(words.end(), others.begin(), others.end());
            std::vector<char*> pointers;
            for (std::string& word : words) pointers.push_back(word.data());
            pointers.push_back(nullptr);
            ::execvp("Xvfb", pointers.data());
            ::_exit(97);
        }
        ::close(ends[1]);
        std::string number;  // the display number and a line end, which may arrive in separate reads
        for (char letter = 0; ::read(ends[0], &letter, 1) == 1 && letter != '\n';) number += letter;
        ::close(ends[0]);
        if (!number.empty()) display_ = ":" + number;
    }
    static void endServer() {
        if (server_ > 0) stop(server_);
        server_ = -1;
        display_.clear();
    }

    void SetUp() override {
        if (display_.empty()) GTEST_SKIP() << "Xvfb and xdotool are needed (Debian: xvfb xdotool)";
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-view-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
        const char* const driver = std::getenv("DEFOCUS_EXPECTED_DRIVER");
        if (driver == nullptr) return;
        static const bool drawsHere = draws(driver);
        if (!drawsHere) GTEST_SKIP() << "skipped: no " << driver;
    }
    void TearDown() override {
        if (program_ > 0) stop(program_);
        std::error_code ignored;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
    }

    // Starts the program; `arguments` follow `view`. Relative file names refer to folder(). The program runs in a fork
    // of this process, which skips the loading of hundreds of shared libraries. Forks do not copy threads, so a test
    // that has started threads starts a new process instead.
    void start(std::vector<std::string> arguments, bool hasDisplay = true) {
        arguments.insert(arguments.begin(), {DEFOCUS_PROGRAM, "view", "--stats", "state.json"});
        const bool copy = threadCount() == threadsAtStart;
        std::fflush(nullptr);  // otherwise the child would write the buffered output again
        program_ = ::fork();
        if (program_ != 0) return;
        endWithTheTest();
        if (::chdir(folder_.c_str()) != 0) ::_exit(96);
        if (hasDisplay)
            ::setenv("DISPLAY", display_.c_str(), 1);
        else
            ::unsetenv("DISPLAY");
        ::setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
        ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
        ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
        const int err = ::open("stderr", O_CREAT | O_TRUNC | O_WRONLY, 0600);
        ::dup2(err, 2);
        std::vector<char*> words;
        for (std::string& word : arguments) words.push_back(word.data());
        words.push_back(nullptr);
        if (copy) {
            const int code = runProgram(static_cast<int>(arguments.size()), words.data());
            std::fflush(nullptr);
            ::_exit(code);
        }
        ::execv(DEFOCUS_PROGRAM, words.data());
        ::_exit(95);
    }

    // Waits up to `seconds` for the program to end and returns its exit code. If the program is still running then,
    // stops it and returns −1.
    int ended(double seconds = 180) {
        for (double waited = 0; waited < seconds; waited += 0.05) {
            int status = 0;
            if (::waitpid(program_, &status, WNOHANG) == program_) {
                program_ = -1;
                return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
            }
            pause(0.05);
        }
        if (program_ > 0) stop(program_);  // −1 means that the program did not start; kill(−1) would stop every process
        program_ = -1;
        return -1;
    }
    [[nodiscard]] bool running() const { return alive(); }
    [[nodiscard]] pid_t process() const { return program_; }

    [[nodiscard]] nlohmann::json state() const {
        std::ifstream file(folder_ / "state.json");
        nlohmann::json value = nlohmann::json::parse(file, nullptr, false);
        return value.is_discarded() ? nlohmann::json::object() : value;
    }
    // Waits until the state satisfies `condition`; reached() then returns this state. Returns false if the program
    // ends, or after three minutes, since software drivers on busy machines are slow.
    bool reaches(const std::function<bool(const nlohmann::json&)>& condition) const {
        constexpr double maxSeconds = 180;
        for (double waited = 0; waited < maxSeconds; waited += 0.02) {
            // read before the state, so that the state of a program that just ended is still checked
            const bool ending = !alive();
            nlohmann::json now = state();
            if (!now.empty() && condition(now)) {
                reached_ = std::move(now);
                return true;
            }
            if (ending) return false;
            pause(0.02);
        }
        return false;
    }
    [[nodiscard]] const nlohmann::json& reached() const { return reached_; }
    // Calls `hand`, which simulates user input, until `condition` holds, at most ten times. Waits for a hundred frames
    // after each call.
    bool insists(const std::function<void()>& hand, const std::function<bool(const nlohmann::json&)>& condition) const {
        constexpr std::uint64_t patience = 100;
        for (int i = 0; i < 10 && alive(); ++i) {
            const std::uint64_t begin = framesDrawn();
            hand();
            const auto seen = [&](const nlohmann::json& s) {
                return condition(s) || s.at("frames").get<std::uint64_t>() >= begin + patience;
            };
            if (reaches(seen) && condition(reached_)) return true;
        }
        return false;
    }
    bool showsScene(const std::string& name) const {
        return reaches([&](const nlohmann::json& s) { return s.at("scene") == name && s.at("samples") > 0; });
    }

    // Runs an xdotool command line, such as "mousemove 10 20 click 1".
    void send(const std::string& commands) const {
        const std::string line = "DISPLAY=" + display_ + " xdotool " + commands + " >/dev/null 2>&1";
        EXPECT_EQ(std::system(line.c_str()), 0) << line;
    }
    // Runs an xdotool command line and waits for four frames: one that may have begun before the events, one that
    // handles them, and two in which the interface may respond.
    void act(const std::string& commands) const {
        send(commands);
        for (const std::uint64_t more : {1u, 3u}) {
            const std::uint64_t drawn = framesDrawn();
            reaches([&](const nlohmann::json& s) { return s.at("frames").get<std::uint64_t>() >= drawn + more; });
        }
    }
    // Runs several xdotool command lines, each in a frame of its own.
    void inTurn(const std::vector<std::string>& movements) const {
        for (const std::string& commands : movements) act(commands);
    }
    // Clicks at a pixel of the window. Without a window manager, the window is at the top-left corner of the screen, so
    // screen and window coordinates are equal.
    void click(int x, int y) const { inTurn({"mousemove " + std::to_string(x) + " " + std::to_string(y), "click 1"}); }
    void key(const std::string& name) const { act("key " + name); }

    static void pause(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
    [[nodiscard]] static const std::string& display() { return display_; }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::string textOf(const char* name) const {
        std::ifstream file(folder_ / name);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

private:
    // Returns whether `driver` can draw a window.
    bool draws(const std::string& driver) {
        start({"--fish", "1", "--fish-triangles", "200", "--frames", "1"});
        ended();
        return state().value("device", "").find(driver) != std::string::npos;
    }
    [[nodiscard]] std::uint64_t framesDrawn() const {
        const nlohmann::json now = state();
        return now.empty() ? 0 : now.at("frames").get<std::uint64_t>();
    }
    // Returns whether the program is still running. Does not reap the process, so that ended() can return its exit
    // code.
    [[nodiscard]] bool alive() const {
        siginfo_t info{};
        return program_ > 0 && ::waitid(P_PID, static_cast<id_t>(program_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
               info.si_pid == 0;
    }
    // Must be called in a child process: ends the child if the test is killed. Otherwise the child would keep the
    // test's output open.
    static void endWithTheTest() { ::prctl(PR_SET_PDEATHSIG, SIGKILL); }
    static void silence() {
        const int null = ::open("/dev/null", O_WRONLY);
        ::dup2(null, 1);
        ::dup2(null, 2);
    }
    static void stop(pid_t process) {
        ::kill(process, SIGTERM);
        for (int i = 0; i < 100; ++i) {
            if (::waitpid(process, nullptr, WNOHANG) != 0) return;
            pause(0.05);
        }
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
    }

    static std::size_t threadCount() {
        using Files = std::filesystem::directory_iterator;
        return static_cast<std::size_t>(std::distance(Files("/proc/self/task"), Files()));
    }

    // number of threads that libraries start when they are loaded
    static inline const std::size_t threadsAtStart = threadCount();
    static inline pid_t server_ = -1;
    static inline std::string display_;
    std::filesystem::path folder_;
    pid_t program_ = -1;
    mutable nlohmann::json reached_;
};

}  // namespace defocus::engine
