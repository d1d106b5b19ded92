#pragma once
// Runs the program as a child process, in a folder of its own, with a cache of its own.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "cli/program_copies.h"

namespace defocus::engine {

struct Outcome {
    int exitCode = -1;  // 128 + number of the signal that ended it
    std::string out;
    std::string err;  // without progress
};

// Lines as "pyramids: 65 %, 3 s left" come where work takes longer than a second, so that how many there are is chance.
inline std::string withoutProgress(const std::string& text) {
    static const std::regex line("(frame [0-9]+(, [^\n]*)?|[a-z ]+): [0-9]+ %(, [0-9:]+ (s|min|h) left)?\\n");
    return std::regex_replace(text, line, "");
}

class ProgramTest : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-app-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        root_ = pattern;
        std::filesystem::create_directory(folder());
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(root_, ignored);
    }

    // Where the program runs: relative names in `arguments` lie here.
    [[nodiscard]] std::filesystem::path folder() const { return root_ / "work"; }

    // Where the program keeps pyramids; outside `folder`, so that they aren't counted as its output.
    [[nodiscard]] std::filesystem::path cacheFolder() const { return root_ / "caches" / "defocus"; }

    [[nodiscard]] std::size_t fileCount() const {
        using Files = std::filesystem::recursive_directory_iterator;
        return static_cast<std::size_t>(std::distance(Files(folder()), Files()));
    }

    // `mostFileBytes`: writes beyond it fail, as on a full disk; 0: no limit.
    Outcome run(const std::vector<std::string>& arguments, std::size_t maxFileBytes = 0) const {
        const std::filesystem::path out = root_ / "stdout";
        const std::filesystem::path err = root_ / "stderr";
        const int status = ProgramCopies::run({.folder = folder(),
                                               .out = out,
                                               .err = err,
                                               .cacheHome = cacheFolder().parent_path(),
                                               .maxFileBytes = maxFileBytes,
                                               .arguments = arguments});
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), textOf(out),
                withoutProgress(textOf(err))};
    }

    static std::string textOf(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

private:
    std::filesystem::path root_;
};

// One line on stderr that begins with the program's name, nothing else said, and the exit code.
inline void expectOneLine(const Outcome& outcome, int exitCode) {
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("defocus: ")) << outcome.err;
    EXPECT_GT(outcome.err.size(), std::string("defocus: \n").size());
}

}  // namespace defocus::engine
