#pragma once
// Chooses the lines of each pixel: a wagon wheel of n lines through the lens centre (Tzeng et al. 2012), in which line
// i has the angle π·(i + r)/n. Each variant (ray_sets.h) has its own rotation r of the wheel and its own positions of
// the lines in the pixel. Equal lines in all pixels would be visible as strobing, an open problem in the paper.
//
// The lines' positions in the pixel are well distributed over the pixel and the wheel jointly, because only the
// positions antialias surfaces in focus.
//
// Angles are spaced so that equal amounts of the aperture's light pass between them. Thus all lines have equal weight
// for any aperture that is not given by an image.

#include "lens/aperture.h"
#include "render/lens_space/ray_sets.h"

namespace defocus::engine {

struct LineSets {
    // GpuRay::lensAndPixel.xy is the vector (u, k·v) from the lens centre to the rim, where k = image width / height.
    // GpuRay::values: x is the length of the line behind the lens centre relative to the length ahead of the centre. y
    // is the fraction of the light ahead of the centre. z is the position of the shading point in a segment, [0, 1).
    RaySets sets;
    // Per line: xy is the unit vector in (u, v) perpendicular to the mean of the line's variants (ray_sets.h); z is the
    // max distance of a variant from that mean line.
    std::vector<glm::vec4> strips;
};

// Returns the lines of a frame's pixels. If `turned` is false, the lines have the same angles and positions in all
// pixels, as in the paper. Groups of `linesPerPosition` lines share a position in the pixel (Figure 2 of the paper).
// The angles of each group are evenly spread. Throws Error if the lens has an aperture image.
LineSets lineSets(const FramePlan& plan, bool turned, std::uint32_t linesPerPosition = 1);

// Returns the distance from the aperture's centre to its rim at `angle` in radians, without blade rotation and
// anamorphic squeeze.
double apertureRim(const Aperture& aperture, double angle);

}  // namespace defocus::engine
