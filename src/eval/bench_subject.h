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
    std::string commit;                 // commit of the program; empty if unknown
    std::vector<std::string> commands;  // all commands that contributed to these results
    Machine machine;
    std::string device;
    std::string driver;
    bool software = false;  // true: a software driver, whose timer queries miss the vertex work
    std::string scene;      // empty if the bench has scenes of its own
    std::string camera;
    std::optional<Lens> lens;  // none if the bench has lenses of its own
    int width = 0;             // px; 0 if the bench has sizes of its own
    int height = 0;            // px
    int runs = 0;              // runs of each frame; 0 if nothing is timed
    double pyramidMilliseconds = 0;
};

// Returns the head of a bench's JSON file: all members of `subject` that are set. `bench` is the name of the command.
nlohmann::ordered_json subjectJson(const std::string& bench, const BenchSubject& subject);

}  // namespace defocus::engine
