#pragma once
// The lines of each pixel: a wagon wheel through the centre of the lens (Tzeng et al. 2012). Line i of n passes at the
// angle π·(i + r)/n, and each variant of ray_sets.h turns the wheel by another r and puts the lines at other places of
// the pixel. The paper leaves open how to avoid that lines of one direction, at the same place of all pixels, show as
// strobes.
//
// The lines of a pixel have places in it that are spread over the pixel and over the wheel together, because a wheel
// of few lines smooths what is in focus by those places alone.
//
// The angle is counted in equal shares of the aperture's light, so that all lines weigh the same for any shape without
// an image.

#include "lens/aperture.h"
#include "render/lens_space/ray_sets.h"

namespace defocus::engine {

struct LineSets {
    RaySets sets;  // lensAndPixel: the way (u, k·v) from the centre to the rim; values: backward, forwardShare, a
                   // number in [0, 1) that says where along a segment it is shaded
    std::vector<glm::vec4> strips;  // of each line: xy a unit vector across it in (u, v), z how far a variant leaves it
};

// `turned`: false for one wheel and one place for all pixels, as published. Throws Error for an aperture image.
LineSets lineSets(const FramePlan& plan, bool turned);

// The distance of the aperture's rim from its centre at `angle`, before rotation and anamorphic ratio.
double apertureRim(const Aperture& aperture, double angle);

}  // namespace defocus::engine
