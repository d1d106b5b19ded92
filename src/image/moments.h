#pragma once
// Where an image's light lies and how far it spreads: what blurred points are measured by.
//
// A uniform disk of radius R has a variance of R²/4 an axis; a regular n-gon with circumradius R has
// R²/12·(2 + cos(2π/n)). A square of w px adds w²/12, the box filter of the pixel 1/12 (Sheppard's correction).

#include <glm/vec2.hpp>

#include "image/image.h"

namespace defocus::engine {

struct Moments {             // of the first channel
    double energy = 0;       // sum over pixels
    glm::dvec2 mean{0};      // px from the top left corner; NaN without energy
    glm::dvec2 variance{0};  // px²
};

Moments momentsOf(const Image& image);

// The (circum)radius in px of the blur that an image of a square of `square` px shows, by its second moment.
double radiusBySecondMoment(const Moments& moments, int bladeCount, double square);

}  // namespace defocus::engine
