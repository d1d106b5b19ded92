// Tests that long runs do not accumulate memory or file descriptors, and that concurrent programs do not disturb each
// other. scripts/soak runs these tests with more rounds.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "cli/become_program.h"
#include "cli/shots.h"
#include "cli/traced_child.h"
#include "image/image_io.h"
#include "process_memory.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class Soak : public Capture {
protected:
    void become(std::vector<std::string> words) const {
        const int said = ::open((folder() / "said").c_str(), O_CREAT | O_APPEND | O_WRONLY, 0600);
        becomeProgram(std::move(words), folder(), cacheFolder().parent_path(), said, said);
    }
    [[nodiscard]] pid_t start(std::vector<std::string> words) const {
        const pid_t child = ::fork();
        if (child == 0) become(std::move(words));
        return child;
    }
};

// Memory and open file descriptors do not grow during a long video. The test measures both at each write and compares
// frames 90 … 109 with the last 20 frames: the median memory, and the min number of descriptors. It allows four more
// descriptors, because other files may be open during a write. A descriptor leaked in every twentieth frame would add
// nine.
TEST_F(Soak, aLongFilmTakesNoMoreMemoryAndLeavesNoHandleOpen) {
    const int frames = roundsOr("DEFOCUS_SOAK_FRAMES", 300);
    nlohmann::json document = shot();
    document["range"] = {0, frames - 1};
    document["lens"] = {{"fStop", {{"keys", {{{"frame", 0}, {"value", 1.4}}, {{"frame", frames}, {"value", 2.8}}}}}}};
    document["focus"] = {{"keys", {{{"frame", 0}, {"node", "Near"}}, {{"frame", frames}, {"distance", 8}}}}};
    writeShot(document);
    TracedChild child(
        [this] {
            become({"capture", "shot.json", "--quiet", "--size", "32x24", "-o", "frames/####.exr"});
        },
        "frames");
    if (!child.traced()) GTEST_SKIP() << "processes can't be traced here (ptrace)";
    std::vector<double> early, late;
    std::vector<int> earlyHandles, lateHandles;
    int frame = 0;
    const int code = child.end(0, 0, [&](pid_t process) {
        while (fs::exists(folder() / "frames" / fmt::format("{:04}.exr", frame))) ++frame;
        const bool isEarly = frame >= 90 && frame < 110;
        if (!isEarly && frame < frames - 20) return;
        const Held held = heldBy(process);
        (isEarly ? early : late).push_back(held.megabytes);
        (isEarly ? earlyHandles : lateHandles).push_back(held.handles);
    });
    ASSERT_EQ(code, 0) << bytesOf("said");
    ASSERT_FALSE(early.empty() || late.empty());
    const auto median = [](auto values) {
        std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
        return values[values.size() / 2];
    };
    const double before = median(early), after = median(late);
    const int fewestBefore = std::ranges::min(earlyHandles), fewestAfter = std::ranges::min(lateHandles);
    fmt::print("{} frames: {:.1f} MB about frame 100, {:.1f} MB at the end; {} and {} handles\n", frames, before, after,
               fewestBefore, fewestAfter);
    EXPECT_LE(after, 1.02 * before);
    EXPECT_LT(fewestAfter, fewestBefore + 5);
}

// Eight programs that share a cache folder build or read the same pyramids, render the same image, and leave no
// temporary file.
TEST_F(Soak, eightProgramsShareACacheFolder) {
    for (int round = 0; round < roundsOr("DEFOCUS_SOAK_ROUNDS", 2); ++round) {
        fs::remove_all(cacheFolder());
        std::vector<pid_t> children;
        for (int i = 0; i < 8; ++i)
            children.push_back(start({"render", "--quiet", "--size", "32x24", "--samples", "4", "--fish", "3",
                                      "--fish-triangles", "2000", "-o", fmt::format("{}.exr", i)}));
        for (const pid_t child : children) {
            int status = 0;
            ::waitpid(child, &status, 0);
            EXPECT_EQ(status, 0) << bytesOf("said");
        }
        for (int i = 1; i < 8; ++i)
            EXPECT_TRUE(readImage(folder() / fmt::format("{}.exr", i)).pixels == readImage(folder() / "0.exr").pixels);
        int files = 0;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(cacheFolder())) {
            EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
            files += entry.is_regular_file() ? 1 : 0;
        }
        EXPECT_GT(files, 0);
    }
}

}  // namespace
}  // namespace defocus::engine
