#pragma once
// Does the blur follow the lens, and only the lens? The disk of a point of light, its diameter and energy against the
// formula, while one thing at a time changes: f-number, focus distance, depth, sensor, lens samples, resolution, and
// what the method can be asked for.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus {

inline constexpr double honestDiameter = 0.5;  // px by which a disk that follows the lens may be off
inline constexpr double honestEnergy =
    0.05;  // of the sharp light's: 256 samples a pixel of its own leave a noise of 0.02

struct HonestyRow {
    std::string method;   // with its settings, as parseMethodUse has it
    std::string varied;   // "f/2.8"
    double expected = 0;  // diameter by the formula, px
    double measured = 0;  // by the second moment, px
    double energy = 0;    // of the sharp light's
    [[nodiscard]] bool followsLens() const;
};

// Every method of the table as it is by default; after each, the same with one setting at a time at each of its other
// choices, or at the most that it takes.
std::vector<std::string> honestyMethods();

// For each of `methods` one row after the other. The light is a square of 3 px on a black wall at its depth; the
// measured diameter is that of a uniform disk with the image's second moment. Needs a current GL context.
void measureHonesty(const std::vector<std::string>& methods, const std::function<void(const HonestyRow&)>& visit,
                    const Progress& progress = {});

}  // namespace defocus
