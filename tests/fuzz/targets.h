#pragma once
// Declares functions that process untrusted bytes. The fuzzer calls them with generated inputs (scripts/fuzz), and a
// test calls them with inputs that once caused faults (tests/fuzz/corpus). An Error is a correct rejection. Any other
// outcome is a defect: another exception, a sanitizer's report, or minutes of work.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace defocus::engine {

struct FuzzTarget {
    const char* name = "";
    void (*run)(std::span<const std::byte> bytes) = nullptr;
    std::vector<std::vector<std::byte>> (*seeds)() = nullptr;  // returns the initial inputs
    // max length of an input; longer inputs find no further faults
    std::size_t maxBytes = 0;
};

// Fuzz targets by name:
//   gltf      a scene file, from which a small frame is planned, without and with a ground and shadows
//   shot      a shot file
//   cache     a pyramid file with a correct checksum
//   image     an image file, read as an environment, an aperture, a tile, and as input of `compare` and `merge`; the
//             first byte selects the format
//   usda      a USD text file with a camera
//   lens      a file of lens images (views from lens points), refocused within the range that the file states
//   settings  lines of "name=value" for the table of settings; the values also go to the parsers of other options
std::span<const FuzzTarget> fuzzTargets();

// Returns the target with this name. Throws Error if there is none.
const FuzzTarget& fuzzTargetNamed(const std::string& name);

}  // namespace defocus::engine
