#pragma once
// What the rows of a bench were measured on and with.

#include <string>

namespace defocus {

struct BenchSubject {
    std::string program;  // name and version
    std::string scene;
    std::string device;
    std::string driver;
    bool software = false;  // a software driver: its timer queries miss vertex work
    int width = 0;          // px
    int height = 0;         // px
    int runs = 0;
    double pyramidMilliseconds = 0;
};

}  // namespace defocus
