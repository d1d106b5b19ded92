#pragma once
// Moments of an image: centroid and spread of its light, to measure blurred points.
//
// Variances per axis: R²/4 for a uniform disk of radius R, and R²/12·(2 + cos(2π/n)) for a regular n-gon with
// circumradius R. A square of w px adds w²/12, and the pixel's box filter adds 1/12 (Sheppard's correction).

#include <glm/vec2.hpp>

#include "image/image.h"

namespace defocus::engine {

struct Moments {             // moments of the first channel
    double energy = 0;       // sum over all pixels
    glm::dvec2 mean{0};      // px from the top left corner; NaN if energy is 0
    glm::dvec2 variance{0};  // px²
};

Moments momentsOf(const Image& image);

// Returns the (circum)radius in px of the blur of a square of `square` px, from the second moment. `bladeCount` 0 means
// a disk.
double radiusBySecondMoment(const Moments& moments, int bladeCount, double square);

}  // namespace defocus::engine
