#pragma once
// The lines of each pixel: a wagon wheel through the lens centre (Tzeng et al. 2012). Line i of n has the angle π·(i +
// r)/n. Each variant of ray_sets.h rotates the wheel by another r and offsets the lines in the pixel differently.
// Without this, lines of one direction at the same position of all pixels would be visible as strobing, which the paper
// leaves unsolved.
//
// The lines' positions in the pixel are well distributed over the pixel and the wheel together. With few lines, these
// positions alone antialias surfaces in focus.
//
// Angles are measured in equal shares of the aperture's light, so that all lines have equal weight for any aperture
// without an image.

#include "lens/aperture.h"
#include "render/lens_space/ray_sets.h"

namespace defocus::engine {

struct LineSets {
    // LensAndPixel: vector (u, k·v) from the centre to the rim; values: backward, forwardShare, shading position on a
    // segment [0, 1).
    RaySets sets;
    // Per line: xy is a unit vector across it in (u, v); z is the max distance of a variant from the line.
    std::vector<glm::vec4> strips;
};

// Returns the lines of a plan. `turned`: false for the same wheel and position in all pixels, as published. Throws
// Error for an aperture image.
LineSets lineSets(const FramePlan& plan, bool turned);

// Returns the distance from the aperture's centre to its rim at `angle`, before rotation and anamorphic squeeze.
double apertureRim(const Aperture& aperture, double angle);

}  // namespace defocus::engine
