#pragma once
// What the tests of plans ask for, and look for.

#include <algorithm>
#include <string>

#include "plan/frame_plan.h"

namespace defocus::engine {

inline RenderSettings settingsFor(std::uint32_t samples) {
    RenderSettings settings;
    settings.sampleCount = samples;
    settings.thresholds = {0.5, 2};
    return settings;
}

// Whether the plan names something left out whose name holds `what`.
inline bool leftOut(const FramePlan& plan, const std::string& what) {
    return std::any_of(plan.leftOut.begin(), plan.leftOut.end(),
                       [&](const LeftOut& entry) { return entry.what.find(what) != std::string::npos; });
}

}  // namespace defocus::engine
