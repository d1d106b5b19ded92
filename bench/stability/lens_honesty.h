#pragma once
// Tests whether the blur follows the lens and nothing else. It compares the diameter and the energy of a blurred point
// of light with the formula, while one parameter at a time changes: f-number, focus distance, depth, sensor, lens
// samples, resolution, or a setting of the method.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus::engine {

inline constexpr double honestDiameter = 0.5;  // px, max diameter error of a disk that follows the lens
// Max energy error of a disk that follows the lens, as a share of the sharp light's energy. Noise alone is 0.02 for
// methods with 256 independent samples per pixel.
inline constexpr double honestEnergy = 0.05;

struct HonestyRow {
    std::string method;        // with its settings, written as for parseMethodUse
    std::string varied;        // what changed, such as "f/2.8"
    double expected = 0;       // px, the diameter by the formula
    double measured = 0;       // px, the diameter by the second moment
    double energy = 0;         // as a share of the sharp light's
    std::string leftOut = {};  // why this driver can't draw it; the figures are then unset
    [[nodiscard]] bool followsLens() const;
};

// Returns every method of the table with its defaults, each followed by its variants. A variant sets one setting to
// another choice or to its max value.
std::vector<std::string> honestyMethods();

// Measures all rows of each method. The light is a square of 3 px on a black wall at the same depth. The measured
// diameter is that of a uniform disk with the same second moment as the image. A method that the driver can't draw has
// one row with the reason. Needs a current GL context.
void measureHonesty(const std::vector<std::string>& methods, const std::function<void(const HonestyRow&)>& visit,
                    const Progress& progress = {});

}  // namespace defocus::engine
