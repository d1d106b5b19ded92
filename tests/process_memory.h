#pragma once
// What a running process holds, by /proc.

#include <sys/types.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace defocus {

struct Held {
    double megabytes = 0;  // resident
    int handles = 0;       // open descriptors
};

inline Held heldBy(pid_t process) {
    Held held;
    const std::string folder = "/proc/" + std::to_string(process) + "/";
    std::ifstream file(folder + "statm");
    std::uint64_t size = 0, resident = 0;
    file >> size >> resident;
    held.megabytes = static_cast<double>(resident) * 4096e-6;
    std::error_code gone;
    using Files = std::filesystem::directory_iterator;
    held.handles = static_cast<int>(std::distance(Files(folder + "fd", gone), Files()));
    return held;
}

// A number of rounds from the environment, where scripts/soak asks for more than the tests do.
inline int roundsOr(const char* variable, int standard) {
    const char* const text = std::getenv(variable);
    return text != nullptr ? std::atoi(text) : standard;
}

}  // namespace defocus
