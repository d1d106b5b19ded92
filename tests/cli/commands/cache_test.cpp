// Tests the cache on the command line: --cache-dir, --no-cache, `defocus cache list` and `defocus cache clear`.

#include <regex>

#include "cli/program.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class Cache : public ProgramTest {
protected:
    // Runs `defocus plan` for two small fish, which need level-of-detail pyramids. With --verbose, the program prints
    // how many pyramids came from the cache.
    Outcome plan(std::vector<std::string> arguments = {}, std::size_t maxFileBytes = 0) const {
        arguments.insert(arguments.begin(), {"plan", "--fish", "2", "--fish-triangles", "2000", "--samples", "64"});
        const Outcome outcome = run(arguments, maxFileBytes);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return outcome;
    }

    static std::size_t filesIn(const fs::path& folder) {
        if (!fs::exists(folder)) return 0;
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    static void expectOneWarning(const Outcome& outcome) {
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("warning: ")) << outcome.err;
    }
};

TEST_F(Cache, secondRunLoadsWhatTheFirstStored) {
    const Outcome first = plan({"--verbose"});
    EXPECT_TRUE(first.err.starts_with("0 of ")) << first.err;
    const std::size_t stored = filesIn(cacheFolder());
    ASSERT_GE(stored, 2u);
    const Outcome second = plan({"--verbose"});
    EXPECT_TRUE(second.err.starts_with(std::to_string(stored) + " of ")) << second.err;
    EXPECT_EQ(second.out, first.out);
    EXPECT_EQ(filesIn(cacheFolder()), stored);
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(Cache, isNotTouchedWithoutLevelsOrOnRequest) {
    const Outcome fresh = plan({"--no-cache", "--verbose"});
    EXPECT_EQ(fresh.err, "");
    plan({"--lod", "off"});
    EXPECT_EQ(filesIn(cacheFolder()), 0u);
    EXPECT_EQ(plan().out, fresh.out);
    expectOneLine(run({"plan", "--no-cache", "--cache-dir", "x"}), 2);
}

TEST_F(Cache, liesWhereItIsAskedFor) {
    plan({"--cache-dir", "my ünï cache"});
    EXPECT_GE(filesIn(folder() / "my ünï cache"), 2u);
    EXPECT_EQ(filesIn(cacheFolder()), 0u);
    EXPECT_TRUE(plan({"--cache-dir", "my ünï cache", "--verbose"}).err.find(" in my ünï cache") != std::string::npos);
}

TEST_F(Cache, aFolderThatCannotBeWrittenIsOneWarningAndNoFault) {
    const Outcome good = plan();
    std::ofstream(folder() / "file") << "no folder";
    const Outcome outcome = plan({"--cache-dir", "file"});
    expectOneWarning(outcome);
    EXPECT_NE(outcome.err.find("file"), std::string::npos);
    EXPECT_EQ(outcome.out, good.out);
    EXPECT_EQ(plan({"--cache-dir", "file", "--quiet"}).err, "");
    EXPECT_EQ(textOf(folder() / "file"), "no folder");
}

TEST_F(Cache, aFullDiskIsOneWarningAndLeavesNoFile) {
    const Outcome good = plan({"--no-cache"});
    const Outcome outcome = plan({}, 20'000);
    expectOneWarning(outcome);
    EXPECT_EQ(outcome.out, good.out);
    EXPECT_EQ(filesIn(cacheFolder()), 0u);
}

TEST_F(Cache, listShowsFilesAndTheirTotal) {
    const Outcome none = run({"cache", "list"});
    EXPECT_EQ(none.exitCode, 0);
    EXPECT_TRUE(none.out.starts_with("0 files, 0.0 MB, 0 triangles")) << none.out;

    plan({"--cache-dir", "here"});
    const Outcome outcome = run({"cache", "list", "--cache-dir", "here"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_EQ(outcome.err, "");
    // The printed total of triangles is the sum over the listed files.
    const std::regex line(R"(([0-9a-f]{16}\.pyramid) +[0-9.]+ MB  \d{4}-\d\d-\d\d \d\d:\d\d +(\d+)\n)");
    std::size_t files = 0;
    std::uint64_t triangles = 0;
    for (std::sregex_iterator match(outcome.out.begin(), outcome.out.end(), line), end; match != end; ++match) {
        ++files;
        triangles += std::stoull((*match)[2]);
        EXPECT_TRUE(fs::exists(folder() / "here" / (*match)[1].str()));
    }
    EXPECT_EQ(files, filesIn(folder() / "here"));
    EXPECT_GE(triangles, 2 * 2000u * 3 / 4);
    EXPECT_NE(outcome.out.find(std::to_string(triangles) + " triangles in here"), std::string::npos) << outcome.out;
    EXPECT_EQ(run({"cache", "--cache-dir", "here", "list"}).out, outcome.out);
}

TEST_F(Cache, clearRemovesItsFilesAndNoOthers) {
    plan();
    const std::size_t stored = filesIn(cacheFolder());
    std::ofstream(cacheFolder() / "notes.txt") << "mine";
    const Outcome outcome = run({"cache", "clear"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_TRUE(outcome.out.starts_with("removed " + std::to_string(stored) + " files, ")) << outcome.out;
    EXPECT_EQ(filesIn(cacheFolder()), 1u);
    EXPECT_EQ(textOf(cacheFolder() / "notes.txt"), "mine");
    EXPECT_TRUE(run({"cache", "clear"}).out.starts_with("removed 0 files, 0.0 MB"));
}

TEST_F(Cache, wrongCommandLinesAndFolders) {
    expectOneLine(run({"cache"}), 2);
    expectOneLine(run({"cache", "purge"}), 2);
    std::ofstream(folder() / "file") << "x";
    expectOneLine(run({"cache", "list", "--cache-dir", "file"}), 1);
    EXPECT_NE(run({"cache", "list", "--help"}).out.find("defocus cache clear"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
