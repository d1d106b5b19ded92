#pragma once
// The computer that a bench runs on, in the words that its system has for it.

#include <cstdint>
#include <string>

namespace defocus {

struct Machine {
    std::string processor;  // "AMD EPYC …"; empty: not known
    unsigned threads = 0;   // that run at once
    std::uint64_t memoryBytes = 0;
    std::string system;  // "Linux 6.1.0 x86_64"
};

Machine thisMachine();

}  // namespace defocus
