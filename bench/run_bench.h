#pragma once
// What the main of each bench does: it keeps freed memory, as `defocus` does, and an error is one line on stderr, after
// the program's name, and exit code 1.

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "core/memory.h"

namespace defocus::engine {

// `run` takes nothing and returns the exit code.
template <typename Run>
int runBench(const char* program, const Run& run) {
    keepFreedMemory();
    try {
        return run();
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", program, error.what());
        return 1;
    }
}

}  // namespace defocus::engine
