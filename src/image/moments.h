#pragma once
// Computes the moments of an image: the centroid and the variance of its intensity, for measuring the blur of a point.
//
// The variance along an axis is R²/4 for a uniform disk of radius R, and R²/12·(2 + cos(2π/n)) for a regular n-gon with
// circumradius R. A blurred square of w px has an additional variance of w²/12. The pixel's box filter adds 1/12 px²
// (Sheppard's correction).

#include <glm/vec2.hpp>

#include "image/image.h"

namespace defocus::engine {

struct Moments {             // moments of an image's first channel
    double energy = 0;       // sum of the channel over all pixels
    glm::dvec2 mean{0};      // centroid in px from the top left corner; NaN if energy is 0
    glm::dvec2 variance{0};  // variance along x and y, px²
};

Moments momentsOf(const Image& image);

// Returns the radius of a blur in px (circumradius for a polygon). `moments` belong to the image of a square that had a
// side of `square` px before blurring. `bladeCount` 0 means a disk.
double radiusBySecondMoment(const Moments& moments, int bladeCount, double square);

}  // namespace defocus::engine
