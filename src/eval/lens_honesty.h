#pragma once
// Does the blur follow the lens, and only the lens? The disk of a point of light, its diameter and energy against the
// formula, while one thing at a time changes: f-number, focus distance, depth, sensor, lens samples, resolution.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus {

struct HonestyRow {
    std::string method;
    std::string varied;   // "f-number 2.8"
    double expected = 0;  // diameter by the formula, px
    double measured = 0;  // by the second moment, px
    double energy = 0;    // of the sharp light's
};

// Each of `names`, or every method of the table, as it is by default, one row after the other. The light is a square of
// 3 px on a black wall at its depth; the measured diameter is that of a uniform disk with the image's second moment.
// Needs a current GL context.
void measureHonesty(const std::vector<std::string>& names, const std::function<void(const HonestyRow&)>& visit,
                    const Progress& progress = {});

}  // namespace defocus
