#pragma once
// Describes what a bench measured, and with which program and machine.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/machine.h"
#include "lens/lens.h"

namespace defocus::engine {

struct BenchSubject {
    std::string program;                // name and version
    std::string commit;                 // of the program; empty if it isn't known
    std::vector<std::string> commands;  // all commands that contributed to these results
    Machine machine;
    std::string device;
    std::string driver;
    bool software = false;  // true for a software driver, whose timer queries miss the work on vertices
    std::string scene;      // empty if the bench has scenes of its own
    std::string camera;
    std::optional<Lens> lens;  // none if the bench has lenses of its own
    int width = 0;             // px; 0 if the bench has sizes of its own
    int height = 0;            // px
    int runs = 0;              // of each frame; 0 if nothing is timed
    double pyramidMilliseconds = 0;
};

// Returns the head of a bench's JSON file: all of the above that is set. `bench` is the name of the command.
nlohmann::ordered_json subjectJson(const std::string& bench, const BenchSubject& subject);

}  // namespace defocus::engine
