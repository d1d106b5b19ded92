#pragma once
// Runs the program `defocus` as a child process, with its own folder and cache.

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
    int exitCode = -1;  // 128 + the signal's number if a signal ended the program
    std::string out;
    std::string err;  // stderr without progress lines
};

// Removes progress lines such as "pyramids: 65 %, 3 s left". Their number varies from run to run, since progress is
// printed only after a second of work.
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

    // Working folder of the program; file names in its arguments are relative to this folder.
    [[nodiscard]] std::filesystem::path folder() const { return root_ / "work"; }

    // Folder in which the program caches pyramids. It is outside folder(), so that cached pyramids do not count as
    // output.
    [[nodiscard]] std::filesystem::path cacheFolder() const { return root_ / "caches" / "defocus"; }

    [[nodiscard]] std::size_t fileCount() const {
        using Files = std::filesystem::recursive_directory_iterator;
        return static_cast<std::size_t>(std::distance(Files(folder()), Files()));
    }

    // Runs the program. Writes beyond a file size of `maxFileBytes` fail as on a full disk; 0 sets no limit.
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

// Expects this exit code and exactly one line of output, on stderr, that begins with the program's name.
inline void expectOneLine(const Outcome& outcome, int exitCode) {
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("defocus: ")) << outcome.err;
    EXPECT_GT(outcome.err.size(), std::string("defocus: \n").size());
}

}  // namespace defocus::engine
