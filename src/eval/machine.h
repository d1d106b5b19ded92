#pragma once
// Describes the computer that a bench runs on, as its operating system reports it.

#include <cstdint>
#include <string>

namespace defocus::engine {

struct Machine {
    std::string processor;  // name of the processor, such as "AMD EPYC …"; empty if unknown
    unsigned threads = 0;   // number of hardware threads
    std::uint64_t memoryBytes = 0;
    std::string system;  // operating system, such as "Linux 6.1.0 x86_64"
};

Machine thisMachine();

}  // namespace defocus::engine
