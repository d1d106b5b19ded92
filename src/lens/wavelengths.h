#pragma once
// Axial chromatic aberration: the focus shifts with the wavelength. Each lens sample has a place in the band from red
// (0) to blue (1), a colour weight there, and a focus of its own; all of them share the samples of the frame.
//
// With D dioptres between the focus of red and of blue, 1/s(t) = 1/s + 3·D·(t − 1/2): the weights below have their
// centres at t = 1/3 (red), 1/2 (green) and 2/3 (blue), which are D apart. In C = a + b·w this adds 3·a·D·(1/2 − t) to
// b.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lens/lens_samples.h"

namespace defocus::engine {

// What the band's place `t` ∈ [0, 1] adds to b₁ and b₂ of a lens whose C(w) begins with `a`.
double chromaticShift(double a, double dioptres, double t);

// How much the samples count in red, green and blue: 2(1 − t), 3/2·(1 − (2t − 1)²), 2t, divided by their means over the
// samples, so that what is grey stays grey.
std::vector<glm::vec3> bandWeights(std::span<const LensSample> samples);

}  // namespace defocus::engine
