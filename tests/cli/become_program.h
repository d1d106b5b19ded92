#pragma once
// Replaces a forked process with the program `defocus`, for tests that kill, trace or run many programs at once.

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace defocus::engine {

// Replaces a forked process with the program `defocus`. It runs in `folder`, keeps its caches in `caches`, and writes
// to the file descriptors `out` and `error`. Never returns.
[[noreturn]] inline void becomeProgram(std::vector<std::string> words, const std::filesystem::path& folder,
                                       const std::filesystem::path& caches, int out, int error) {
    if (::chdir(folder.c_str()) != 0 || ::dup2(out, 1) < 0 || ::dup2(error, 2) < 0) ::_exit(99);
    ::setenv("XDG_CACHE_HOME", caches.c_str(), 1);
    words.insert(words.begin(), DEFOCUS_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    ::execv(DEFOCUS_PROGRAM, arguments.data());
    ::_exit(98);
}

}  // namespace defocus::engine
