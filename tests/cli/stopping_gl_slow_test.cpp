// Tests that a signal or the time limit ends a render promptly, even in the middle of a block of samples that takes a
// long time.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/become_program.h"
#include "cli/program.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

using Words = std::vector<std::string>;
using Seconds = std::chrono::duration<double>;

class Stopping : public ProgramTest {
protected:
    struct End {
        int code = -1;  // exit code, or 128 + the number of the signal that ended the program
        double seconds = 0;
        std::string said;
    };

    // Runs the program `defocus`. Sends `signal` after `after` seconds; 0 sends no signal. `End::seconds` is the time
    // from the signal to the end, or the duration of the program without a signal.
    [[nodiscard]] End ended(Words words, int signal = 0, double after = 0) const {
        const pid_t child = ::fork();
        if (child == 0) {
            const int nothing = ::open("/dev/null", O_WRONLY);
            const int said = ::open((folder() / "said").c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
            becomeProgram(std::move(words), folder(), cacheFolder().parent_path(), nothing, said);
        }
        if (signal != 0) {
            std::this_thread::sleep_for(Seconds(after));
            ::kill(child, signal);
        }
        const auto begin = std::chrono::steady_clock::now();
        int status = 0;
        ::waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                Seconds(std::chrono::steady_clock::now() - begin).count(), withoutProgress(textOf(folder() / "said"))};
    }

    // Renders a complete frame with one sample, so that the caches contain the level-of-detail pyramids and the
    // shaders.
    void warmUp(Words words) const {
        words.insert(words.end(), {"--samples", "1", "-o", "warm.png"});
        ASSERT_EQ(run(words).exitCode, 0);
    }

    const Words costly = {"render", "--quiet", "--size", "512x384", "--field-curvature", "1000"};
};

// On two cores, the frame takes minutes, and its first block of 64 samples half of that. The signal thus arrives within
// this block.
TEST_F(Stopping, aSignalEndsARenderWithinASecond) {
    warmUp(costly);
    for (const int signal : {SIGINT, SIGTERM}) {
        Words words = costly;
        words.insert(words.end(), {"--samples", "128", "-o", "a.exr"});
        const End end = ended(words, signal, 4);
        EXPECT_EQ(end.code, 1);
        EXPECT_LT(end.seconds, 1.5);
        EXPECT_NE(end.said.find("of 128 samples; no image was written"), std::string::npos) << end.said;
        EXPECT_EQ(fileCount(), 2u) << "warm.png and said";
    }
}

TEST_F(Stopping, partialImagesAreKeptOnDemand) {
    warmUp(costly);
    Words words = costly;
    words.insert(words.end(), {"--samples", "128", "--keep-partial", "-o", "a.exr"});
    const End end = ended(words, SIGTERM, 6);
    EXPECT_EQ(end.code, 1);
    EXPECT_NE(end.said.find("of 128 samples: the image from these samples was written"), std::string::npos) << end.said;
    Metadata metadata;
    const Image image = readImage(folder() / "a.exr", metadata);
    EXPECT_EQ(image.width, 512);
    const int samples = std::get<int>(metadata.at("defocus:samples"));
    EXPECT_GT(samples, 0);
    EXPECT_LT(samples, 128);
}

// With the method `line`, one step (a call of Renderer::advance()) takes seconds, so the signal usually arrives within
// a step. On a fast machine, the first step may end before the signal arrives.
TEST_F(Stopping, aLongStepIsNotAwaited) {
    warmUp({"render", "--quiet", "--size", "512x384"});
    const Words words = {"render",    "--quiet", "--size",         "512x384", "--method", "line",
                         "--samples", "64",      "--keep-partial", "-o",      "a.exr"};
    const End end = ended(words, SIGINT, 4);
    EXPECT_EQ(end.code, 1);
    EXPECT_LT(end.seconds, 2.5);
    EXPECT_NE(end.said.find("of 64 samples"), std::string::npos) << end.said;
}

TEST_F(Stopping, theSecondThreadWritesTheImageSoFar) {
    warmUp({"render", "--quiet", "--size", "512x384"});
    const Words words = {"render",    "--quiet", "--size",         "512x384", "--method", "stochastic",
                         "--samples", "128",     "--keep-partial", "-o",      "a.exr"};
    const End end = ended(words, SIGINT, 10);
    EXPECT_EQ(end.code, 1);
    EXPECT_LT(end.seconds, 2.5);
    EXPECT_NE(end.said.find("the image from these samples was written"), std::string::npos) << end.said;
    Metadata metadata;
    EXPECT_EQ(readImage(folder() / "a.exr", metadata).width, 512);
}

// The time limit also ends a render while a batch of samples is drawn together. A batch of 16 samples (--wave 16) takes
// seconds.
TEST_F(Stopping, theTimeLimitEndsALargeWave) {
    warmUp(costly);
    Words words = costly;
    words.insert(words.end(), {"--time-limit", "2", "--wave", "16", "-o", "a.exr"});
    const End end = ended(words);
    EXPECT_EQ(end.code, 0) << end.said;
    EXPECT_LT(end.seconds, 7);
}

// The frame has a single block of 64 samples, which takes more than ten seconds.
TEST_F(Stopping, theTimeLimitEndsABlock) {
    warmUp(costly);
    Words words = costly;
    words.insert(words.end(), {"--time-limit", "2", "-o", "a.exr"});
    const End end = ended(words);
    EXPECT_EQ(end.code, 0) << end.said;
    EXPECT_LT(end.seconds, 7);
    Metadata metadata;
    static_cast<void>(readImage(folder() / "a.exr", metadata));
    EXPECT_LT(std::get<int>(metadata.at("defocus:samples")), 64);
    EXPECT_EQ(std::get<std::string>(metadata.at("defocus:stopped")), "the time limit is reached");
}

}  // namespace
}  // namespace defocus::engine
