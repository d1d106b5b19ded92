#pragma once
// The built-in scene: a school of fish after the one in Jeong, Kim and Lee 2011. Every fish is a different mesh (shape,
// fins, scales in relief, pattern), made deterministically by this generator; no file is needed.

#include <cstdint>

#include "core/progress.h"
#include "scene/scene.h"

namespace defocus::engine {

struct FishSchoolOptions {
    int fishCount = 20;             // 1 … 10,000
    int trianglesPerFish = 90'000;  // about; 200 … 10,000,000
    std::uint32_t seed = 1;
};

// The school with its camera (fStop and focusDistance set), lights and environment. Throws Error for options out of
// range.
Scene fishSchool(const FishSchoolOptions& options = {}, const Progress& progress = {});

}  // namespace defocus::engine
