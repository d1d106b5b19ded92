// A capture that is killed at any moment leaves whole frames under their names or none, and is resumed to the same
// bits.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "cli/shots.h"

namespace defocus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr int frames = 24;

class Survival : public Capture {
protected:
    // Starts the capture in a process of its own.
    [[nodiscard]] pid_t start() const {
        const pid_t child = ::fork();
        if (child != 0) return child;
        const int nothing = ::open("/dev/null", O_WRONLY);
        const int said = ::open((folder() / "said").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (::chdir(folder().c_str()) != 0 || ::dup2(nothing, 1) < 0 || ::dup2(said, 2) < 0) ::_exit(99);
        ::setenv("XDG_CACHE_HOME", cacheFolder().parent_path().c_str(), 1);
        ::execl(DEFOCUS_PROGRAM, DEFOCUS_PROGRAM, "capture", "shot.json", "--quiet", "--range", "0:23", "--resume",
                static_cast<char*>(nullptr));
        ::_exit(98);
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

    // Returns when at least `count` frames are finished, at the latest after 30 s.
    void waitForFrames(int count) const {
        for (int i = 0; i < 15'000 && framesThere() < count; ++i) std::this_thread::sleep_for(2ms);
    }
};

// Killed after some frames more than there were and a part of the next one, so that no machine is too fast or too slow
// for it.
TEST_F(Survival, killedTwentyTimesAndResumed) {
    const Outcome whole = capture({"--range", "0:23", "-o", "whole/####.exr"});
    ASSERT_EQ(whole.exitCode, 0) << whole.err;
    std::mt19937 random(7);
    int killed = 0;
    int before = 0;
    for (int i = 0; i < 20; ++i) {
        const pid_t child = start();
        waitForFrames(before + std::uniform_int_distribution(0, 4)(random));
        std::this_thread::sleep_for(std::chrono::microseconds(std::uniform_int_distribution(0, 20'000)(random)));
        ::kill(child, SIGKILL);
        killed += waitFor(child) == 128 + SIGKILL ? 1 : 0;
        for (int number = 0; number < frames; ++number) {
            if (!fs::exists(folder() / frame("frames", number))) continue;
            EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
        }
        const int there = framesThere();
        EXPECT_GE(there, before) << "a finished frame was lost";
        before = there;
        // Enough to be killed in: begin again when most is there.
        if (there <= frames / 2) continue;
        fs::remove_all(folder() / "frames");
        before = 0;
    }
    EXPECT_GE(killed, 10);
    ASSERT_EQ(waitFor(start()), 0) << bytesOf("said");
    for (int number = 0; number < frames; ++number)
        EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "frames"))
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

// Each has temporary files of its own, leaves those of the other alone, and renames whole frames of the same bits.
TEST_F(Survival, severalAtOnceOnTheSameFrames) {
    ASSERT_EQ(capture({"--range", "0:23", "-o", "whole/####.exr"}).exitCode, 0);
    for (int round = 0; round < 3; ++round) {
        fs::remove_all(folder() / "frames");
        std::vector<pid_t> children;
        for (int i = 0; i < 4; ++i) {
            children.push_back(start());
            std::this_thread::sleep_for(std::chrono::milliseconds(120 * round));
        }
        for (const pid_t child : children) EXPECT_EQ(waitFor(child), 0) << bytesOf("said");
        for (int number = 0; number < frames; ++number)
            EXPECT_TRUE(bytesOf(frame("frames", number)) == bytesOf(frame("whole", number))) << number;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder() / "frames"))
            EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
    }
}

// A machine that is done before the interruption reaches it draws more samples.
TEST_F(Survival, interruptedItEndsWithTheFrameAndSaysHowToGoOn) {
    const auto codeOfInterrupted = [&](int samples) {
        nlohmann::json document = shot();
        document["samples"] = samples;
        writeShot(document);
        fs::remove_all(folder() / "frames");
        const pid_t child = start();
        waitForFrames(1);
        ::kill(child, SIGINT);
        return waitFor(child);
    };
    int samples = 8;
    int code = codeOfInterrupted(samples);
    while (code == 0 && samples < 32'768) {
        ASSERT_EQ(framesThere(), frames);
        samples *= 4;
        code = codeOfInterrupted(samples);
    }
    ASSERT_EQ(code, 1) << bytesOf("said");
    const std::string said = bytesOf("said");
    EXPECT_NE(said.find("stopped before frame "), std::string::npos) << said;
    EXPECT_NE(said.find("--resume"), std::string::npos) << said;
    int there = 0;
    while (fs::exists(folder() / frame("frames", there))) ++there;
    EXPECT_NE(said.find(": " + std::to_string(there) + " of 24 frames are finished"), std::string::npos) << said;
    EXPECT_EQ(waitFor(start()), 0);
    EXPECT_TRUE(fs::exists(folder() / frame("frames", 23)));
}

// A real full disk: a file system of 200 kB.
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
}  // namespace defocus
