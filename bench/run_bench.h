#pragma once
// Implements the main function that the benches share. As in `defocus`, malloc keeps freed memory for later
// allocations. An error is printed as one line on stderr, after the program's name; the exit code is then 1.

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "core/memory.h"

namespace defocus::engine {

// Calls `run`, prints its errors, and returns the exit code.
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
