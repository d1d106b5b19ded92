#pragma once
// What the rows of a bench were measured on and with.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/machine.h"
#include "lens/lens.h"

namespace defocus {

struct BenchSubject {
    std::string program;                // name and version
    std::string commit;                 // of the program; empty: not known
    std::vector<std::string> commands;  // each one that added to these results
    Machine machine;
    std::string device;
    std::string driver;
    bool software = false;  // a software driver: its timer queries miss vertex work
    std::string scene;      // empty: the bench has scenes of its own
    std::string camera;
    std::optional<Lens> lens;  // none: the bench goes through lenses of its own
    int width = 0;             // px; 0: the bench goes through sizes of its own
    int height = 0;            // px
    int runs = 0;              // of each frame; 0: nothing is timed
    double pyramidMilliseconds = 0;
};

// The head of a bench's JSON file: all of the above that says something, under `bench`, the command's name.
nlohmann::ordered_json subjectJson(const std::string& bench, const BenchSubject& subject);

}  // namespace defocus
