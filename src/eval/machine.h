#pragma once
// Describes the computer that a bench runs on, in the words of its operating system.

#include <cstdint>
#include <string>

namespace defocus::engine {

struct Machine {
    std::string processor;  // "AMD EPYC …"; empty if unknown
    unsigned threads = 0;   // hardware threads
    std::uint64_t memoryBytes = 0;
    std::string system;  // "Linux 6.1.0 x86_64"
};

Machine thisMachine();

}  // namespace defocus::engine
