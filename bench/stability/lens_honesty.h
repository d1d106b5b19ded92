#pragma once
// Tests whether a method's blur depends on the lens alone. Compares the diameter and the total radiance (energy) of a
// blurred point of light with the lens equation, varying one parameter at a time: f-number, focus distance, depth,
// sensor, lens samples, resolution, or a setting of the method.

#include <functional>
#include <string>
#include <vector>

#include "core/progress.h"

namespace defocus::engine {

// Tolerances within which the blur disk of a small light agrees with the lens equation (HonestyRow::followsLens).
inline constexpr double honestDiameter = 0.5;  // max error of the blur disk's diameter, px
// Max error of the blur disk's total radiance (energy), relative to the energy of the light without blur. Noise alone
// causes errors of 0.02 for methods with 256 independent samples per pixel.
inline constexpr double honestEnergy = 0.05;

struct HonestyRow {
    std::string method;        // name of the method and its settings, in the format of parseMethodUse
    std::string varied;        // varied parameter, such as "f/2.8"
    double expected = 0;       // blur diameter by the lens equation, px
    double measured = 0;       // blur diameter derived from the image's second moment, px
    double energy = 0;         // radiance summed over the image, relative to the light without blur
    std::string leftOut = {};  // why the method was not measured, such as a limit of the driver; else empty
    [[nodiscard]] bool followsLens() const;
};

// Returns every method of the program's table with its default settings, each followed by variants of these settings. A
// variant changes one setting to another of its choices, or to its max value.
std::vector<std::string> honestyMethods();

// Measures the blur of a small light with each method, and calls `visit` with a row for each tested value of a
// parameter (such as the f-number). The light is a square of 3 px, in front of a black wall at nearly the same depth.
// The measured diameter is that of a uniform disk with the same second moment as the image. If a method fails, for
// example because the driver does not support it, its last row states the reason. Needs a current GL context.
void measureHonesty(const std::vector<std::string>& methods, const std::function<void(const HonestyRow&)>& visit,
                    const Progress& progress = {});

}  // namespace defocus::engine
