// Tests that a capture that is killed at any time leaves only complete frames under their final names, and that
// resuming gives frames that are bit-identical to those of an uninterrupted run.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "cli/shots.h"
#include "cli/traced_child.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

constexpr int frames = 24;

class Survival : public Capture {
protected:
    // Replaces a forked process with the capture command.
    void become() const {
        const int nothing = ::open("/dev/null", O_WRONLY);
        const int said = ::open((folder() / "said").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (::chdir(folder().c_str()) != 0 || ::dup2(nothing, 1) < 0 || ::dup2(said, 2) < 0) ::_exit(99);
        ::setenv("XDG_CACHE_HOME", cacheFolder().parent_path().c_str(), 1);
        ::execl(DEFOCUS_PROGRAM, DEFOCUS_PROGRAM, "capture", "shot.json", "--quiet", "--range", "0:23", "--resume",
                static_cast<char*>(nullptr));
        ::_exit(98);
    }
    [[nodiscard]] pid_t start() const {
        const pid_t child = ::fork();
        if (child == 0) become();
        return child;
    }
    [[nodiscard]] TracedChild startTraced() const {
        return {[this] { become(); }, "frames"};
    }

    static int waitFor(pid_t child) {
        int status = 0;
        ::waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

    static fs::path frame(const std::string& where, int number) {
        return fs::path(where) / ((number < 10 ? "000" : "00") + std::to_string(number) + ".exr");
    }

    [[nodiscard]] int framesThere() const {
        int there = 0;
        for (int number = 0; number < frames; ++number) there += fs::exists(folder() / frame("frames", number)) ? 1 : 0;
        return there;
    }

    // Waits until at least `count` frames are finished or the child process has ended.
    void waitForFrames(int count, pid_t child) const {
        siginfo_t ended{};
        while (framesThere() < count && ended.si_pid == 0)
            ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    }

    void expectNothingHalf() const {
        for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "frames"))
            EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
    }
};

#define DEFOCUS_TRACED_OR_SKIP(child) \
    if (!(child).traced()) GTEST_SKIP() << "processes can't be traced here (ptrace)"

// A capture that is killed 50 times loses no finished frame and can be resumed. Each kill comes before a random write
// to a frame's file or before the file is renamed.
TEST_F(Survival, killedFiftyTimesAndResumed) {
    const Outcome full = capture({"--range", "0:23", "-o", "whole/####.exr"});
    ASSERT_EQ(full.exitCode, 0) << full.err;
    TracedChild undisturbed = startTraced();
    DEFOCUS_TRACED_OR_SKIP(undisturbed);
    ASSERT_EQ(undisturbed.end(), 0) << bytesOf("said");
    const int calls = undisturbed.calls();
    ASSERT_GE(calls, 2 * frames);
    fs::remove_all(folder() / "frames");

    std::mt19937 random(7);
    int before = 0;
    for (int i = 0; i < 50; ++i) {
        // Each run is killed within the first third of the calls of an uninterrupted run. It starts with more than half
        // of the frames missing, so it cannot finish before the kill.
        TracedChild child = startTraced();
        EXPECT_EQ(child.end(std::uniform_int_distribution(1, calls / 3)(random), SIGKILL), 128 + SIGKILL) << i;
        for (int number = 0; number < frames; ++number) {
            if (!fs::exists(folder() / frame("frames", number))) continue;
            EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
        }
        const int there = framesThere();
        EXPECT_GE(there, before) << "a finished frame was lost";
        before = there;
        if (there < frames / 2) continue;
        fs::remove_all(folder() / "frames");
        before = 0;
    }
    ASSERT_EQ(waitFor(start()), 0) << bytesOf("said");
    for (int number = 0; number < frames; ++number)
        EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
    expectNothingHalf();
}

// Several captures can render the same frames at once. Each has its own temporary files, ignores those of the other
// captures, and renames complete frames to their final names. The frames of all captures are bit-identical. The
// captures start together, or each starts after the previous one has finished some frames.
TEST_F(Survival, severalAtOnceOnTheSameFrames) {
    ASSERT_EQ(capture({"--range", "0:23", "-o", "whole/####.exr"}).exitCode, 0);
    for (int round = 0; round < 3; ++round) {
        fs::remove_all(folder() / "frames");
        std::vector<pid_t> children;
        for (int i = 0; i < 4; ++i) {
            children.push_back(start());
            waitForFrames(2 * round * (i + 1), children.back());
        }
        for (const pid_t child : children) EXPECT_EQ(waitFor(child), 0) << bytesOf("said");
        for (int number = 0; number < frames; ++number)
            EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
        expectNothingHalf();
    }
}

// An interrupted capture ends between two frames and prints how to resume. The signal arrives while the capture writes
// its first frame.
TEST_F(Survival, interruptedItEndsWithTheFrameAndSaysHowToGoOn) {
    TracedChild child = startTraced();
    DEFOCUS_TRACED_OR_SKIP(child);
    ASSERT_EQ(child.end(1, SIGINT), 1) << bytesOf("said");
    const std::string said = bytesOf("said");
    EXPECT_NE(said.find("stopped before frame "), std::string::npos) << said;
    EXPECT_NE(said.find("--resume"), std::string::npos) << said;
    int there = 0;
    while (fs::exists(folder() / frame("frames", there))) ++there;
    EXPECT_NE(said.find(": " + std::to_string(there) + " of 24 frames are finished"), std::string::npos) << said;
    EXPECT_EQ(waitFor(start()), 0);
    EXPECT_TRUE(fs::exists(folder() / frame("frames", 23)));
}

// On a full file system of 200 kB, a capture keeps its complete frames and leaves no partial ones.
TEST_F(Survival, fullFileSystemKeepsWholeFrames) {
    std::ofstream(folder() / "inside.sh") << "mount -t tmpfs -o size=200k tmpfs small || exit 9\n"
                                             "'" DEFOCUS_PROGRAM
                                             "' capture shot.json --quiet --range 0:23 -o small/####.exr 2> said\n"
                                             "echo $? > code\ncp -r small kept\n";
    fs::create_directory(folder() / "small");
    const std::string command = "cd '" + folder().string() + "' && XDG_CACHE_HOME='" +
                                cacheFolder().parent_path().string() +
                                "' unshare --map-root-user --user --mount sh inside.sh > /dev/null 2>&1";
    if (std::system(command.c_str()) != 0 || !fs::exists(folder() / "code"))
        GTEST_SKIP() << "no small file system can be mounted here (unshare)";
    EXPECT_EQ(bytesOf("code"), "1\n");
    EXPECT_NE(bytesOf("said").find("No space left on device"), std::string::npos) << bytesOf("said");
    ASSERT_EQ(capture({"--range", "0:23", "-o", "whole/####.exr"}).exitCode, 0);
    int kept = 0;
    for (int number = 0; number < frames; ++number) {
        if (!fs::exists(folder() / frame("kept", number))) continue;
        ++kept;
        EXPECT_TRUE(bytesOf(frame("kept", number)) == bytesOf(frame("whole", number))) << number;
    }
    EXPECT_GT(kept, 2);
    EXPECT_LT(kept, frames);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "kept"))
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

}  // namespace
}  // namespace defocus::engine
