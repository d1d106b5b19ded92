#pragma once
// Computes axial chromatic aberration: the focus distance depends on the wavelength. Each lens sample has a position in
// the band from red (0) to blue (1), which determines its colour weight and its focus distance. No additional samples
// are drawn.
//
// Let D be the dioptres between the focus distances of red and blue, and s the lens's focus distance. The focus
// distance at band position t is s(t), with 1/s(t) = 1/s + 3·D·(t − 1/2). The colour weights below have their centres
// at t = 1/3 (red), 1/2 (green) and 2/3 (blue); red and blue are D apart. At depth w, the clip-space blur
// (circle_of_confusion.h) is C = a + b·w with b = −a/s. The change of the focus distance therefore adds 3·a·D·(1/2 − t)
// to b.

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lens/lens_samples.h"

namespace defocus::engine {

// Returns the amount that axial chromatic aberration adds to both ClipCircleOfConfusion::front and ::behind at the band
// position `t`, from red (0) to blue (1). `a` is ClipCircleOfConfusion::a. `dioptres` is the difference between the
// focus distances of red and blue.
double chromaticShift(double a, double dioptres, double t);

// Returns each sample's weight in red, green and blue: 2(1 − t), 3/2·(1 − (2t − 1)²) and 2t. t is the sample's position
// in the band, from red (0) to blue (1). The weights are divided by their means over the samples, so that grey stays
// grey.
std::vector<glm::vec3> bandWeights(std::span<const LensSample> samples);

}  // namespace defocus::engine
