#pragma once
// Reads the memory use and the number of open file descriptors of a running process from /proc.

#include <sys/types.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace defocus::engine {

struct Held {
    // resident memory in MB, without file-backed pages, which the system can drop and reload at will
    double megabytes = 0;
    int handles = 0;  // number of open file descriptors
};

inline Held heldBy(pid_t process) {
    Held held;
    const std::string folder = "/proc/" + std::to_string(process) + "/";
    std::ifstream file(folder + "status");
    for (std::string line; std::getline(file, line);)
        for (const char* kind : {"RssAnon:", "RssShmem:"})
            if (line.starts_with(kind)) held.megabytes += 1.024e-3 * std::stod(line.substr(line.find(':') + 1));
    std::error_code gone;
    using Files = std::filesystem::directory_iterator;
    held.handles = static_cast<int>(std::distance(Files(folder + "fd", gone), Files()));
    return held;
}

// Returns the number of rounds that an environment variable sets, or `fallback` if the variable is not set.
// scripts/soak sets higher numbers.
inline int roundsOr(const char* variable, int fallback) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? std::atoi(text) : fallback;
}

}  // namespace defocus::engine
