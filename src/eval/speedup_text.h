#pragma once
// Rows of the speed-up benchmark as a table for people, as CSV and as JSON.

#include <span>
#include <string>

#include "eval/speedup.h"

namespace defocus {

std::string speedupHeader();                     // two lines
std::string speedupLine(const SpeedupRow& row);  // one line
std::string speedupCsv(std::span<const SpeedupRow> rows);

// What the rows were measured on and with.
struct BenchSubject {
    std::string program;  // name and version
    std::string scene;
    std::string device;
    std::string driver;
    bool software = false;  // a software driver: its timer queries miss vertex work
    int width = 0;
    int height = 0;
    int runs = 0;
    double pyramidMilliseconds = 0;
};

std::string speedupJson(std::span<const SpeedupRow> rows, const BenchSubject& subject);

}  // namespace defocus
