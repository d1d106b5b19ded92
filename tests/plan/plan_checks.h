#pragma once
// Helpers for tests of frame plans: settings with a number of samples, and a search in a plan's list of omitted items.

#include <algorithm>
#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline RenderSettings settingsFor(std::uint32_t samples) {
    return {.sampleCount = samples, .thresholds = {0.5, 2}};
}

// Returns whether an entry in the plan's list of omitted items contains `what`.
inline bool leftOut(const FramePlan& plan, const std::string& what) {
    return std::any_of(plan.leftOut.begin(), plan.leftOut.end(),
                       [&](const LeftOut& entry) { return entry.what.find(what) != std::string::npos; });
}

}  // namespace defocus::engine
