#pragma once
// Generates the built-in scene: a school of fish modelled on the scene of Jeong, Kim and Lee 2011. Each fish has a
// unique mesh with its own shape, fins, scales and pattern. The generator is deterministic and needs no file.

#include <cstdint>

#include "core/progress.h"
#include "scene/scene.h"

namespace defocus::engine {

struct FishSchoolOptions {
    int fishCount = 20;             // number of fish, 1 to 10,000
    int trianglesPerFish = 90'000;  // approximate number of triangles, 200 to 10,000,000
    std::uint32_t seed = 1;
};

// Returns the school of fish with lights, an environment and a camera whose fStop and focusDistance are set. Throws
// Error for options out of range.
Scene fishSchool(const FishSchoolOptions& options = {}, const Progress& progress = {});

}  // namespace defocus::engine
