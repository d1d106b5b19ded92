#pragma once
// Runs the program as a child process, in a folder of its own, with a cache of its own.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cli/run_program.h"

namespace defocus {

struct Outcome {
    int exitCode = -1;  // 128 + number of the signal that ended it
    std::string out;
    std::string err;
};

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
    Outcome run(const std::vector<std::string>& arguments, std::size_t mostFileBytes = 0) const {
        const std::filesystem::path out = root_ / "stdout";
        const std::filesystem::path err = root_ / "stderr";
        // A copy of this process does: it need not load hundreds of shared libraries anew, which takes longer than most
        // of the tests. But threads aren't copied: where the test has made any, a GL driver's for example, it begins
        // anew.
        const bool copy = threadCount() == threadsAtStart;
        std::fflush(nullptr);  // or the child would write it once more
        const pid_t child = ::fork();
        if (child == 0) runChild(arguments, out, err, mostFileBytes, copy);
        int status = 0;
        ::waitpid(child, &status, 0);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), textOf(out), textOf(err)};
    }

    static std::string textOf(const std::filesystem::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

private:
    [[noreturn]] void runChild(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                               const std::filesystem::path& err, std::size_t mostFileBytes, bool copy) const {
        const int outFile = ::open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        const int errFile = ::open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (::chdir(folder().c_str()) != 0 || ::dup2(outFile, 1) < 0 || ::dup2(errFile, 2) < 0) ::_exit(99);
        if (mostFileBytes > 0) {
            const rlimit limit{mostFileBytes, mostFileBytes};
            ::setrlimit(RLIMIT_FSIZE, &limit);
        }
        ::setenv("XDG_CACHE_HOME", cacheFolder().parent_path().c_str(), 1);
        std::vector<std::string> words = {DEFOCUS_PROGRAM};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> pointers;
        pointers.reserve(words.size() + 1);
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        if (copy) {
            const int code = runProgram(static_cast<int>(words.size()), pointers.data());
            std::fflush(nullptr);
            ::_exit(code);  // without destructors, which would wait for threads that weren't copied
        }
        ::execv(DEFOCUS_PROGRAM, pointers.data());
        ::_exit(98);
    }

    static std::size_t threadCount() {
        using Files = std::filesystem::directory_iterator;
        return static_cast<std::size_t>(std::distance(Files("/proc/self/task"), Files()));
    }

    static inline const std::size_t threadsAtStart = threadCount();  // libraries begin some as they are loaded
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

}  // namespace defocus
