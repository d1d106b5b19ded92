#pragma once
// Describes the conditions of a bench for its results file: scene, camera, program and machine.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/machine.h"
#include "lens/lens.h"

namespace defocus::engine {

struct BenchSubject {
    std::string program;                // name and version of the program
    std::string commit;                 // commit of the program's sources; empty if unknown
    std::vector<std::string> commands;  // command lines of all runs whose results are included
    Machine machine;
    std::string device;
    std::string driver;
    bool software = false;  // true for a software driver, whose timer queries miss the vertex work
    std::string scene;      // scene file; empty if the bench builds its own scenes
    std::string camera;
    std::optional<Lens> lens;  // lens of all frames; nullopt if it varies within the bench
    int width = 0;             // image width in px; 0 if the bench uses several sizes
    int height = 0;            // image height in px
    int runs = 0;              // timed runs of each frame; 0 if nothing is timed
    double pyramidMilliseconds = 0;
};

// Returns, as JSON, the members of `subject` that are set. A bench's results file begins with them. `bench`: name of
// the command.
nlohmann::ordered_json subjectJson(const std::string& bench, const BenchSubject& subject);

}  // namespace defocus::engine
