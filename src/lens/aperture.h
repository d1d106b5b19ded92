#pragma once
// Maps the unit square to points on the lens according to the aperture's shape and light distribution. The map is
// continuous except at the seams of a ring or an aperture image. Well-distributed points on the square are therefore
// well distributed on the lens.
//
// Lens samples have equal weight, so the shape changes neither the energy of a blurred point nor the exposure of the
// image. Let t ∈ [0, 1] be the fraction of the area that lies nearer to the centre than a point. The light density over
// a disk, polygon or ring is
//   1 + k·(2t − 1)                                                              (k: Lens::sphericalAberration)
// and over an aperture image it is the image's value. For n blades of curvature q, the edge at angle φ from a blade's
// middle has the radius (1 − q)·cos(π/n)/cos φ + q. The edge is a chord for q = 0 and an arc of the circle for q = 1.

#include <glm/vec2.hpp>
#include <vector>

#include "lens/lens.h"

namespace defocus::engine {

// Cumulative light transmission of an aperture image over square cells, row by row from the top. A cell is a pixel, a
// part of a pixel in small images, or a group of pixels in large images.
struct ApertureImage {
    int columns = 0;
    int rows = 0;
    std::vector<double> rowEnds;  // cumulative fraction of all light at the end of each row; the last is 1
    // For each cell: fraction of its row's light up to the cell's end; columns · rows values.
    std::vector<float> cellEnds;
};

// Precomputed aperture of a Lens, ready for sampling. Construction is expensive only for an aperture image.
struct Aperture {
    int bladeCount = 0;
    double bladeRotation = 0;  // rotation in radians
    double bladeCurvature = 0;
    double anamorphicRatio = 1;
    double obstruction = 0;  // fraction of the aperture's area that is obstructed
    double sphericalAberration = 0;
    ApertureImage image;  // empty if the lens has no aperture image
};

// Prepares the aperture of a lens. An aperture image is scaled so that its longer side spans the lens; the image's top
// is the lens's top. The area outside the unit disk is opaque. Throws Error if the image is empty or black within the
// disk, or if it contains negative, NaN or infinite values.
Aperture makeAperture(const Lens& lens);

// Maps (r, s) ∈ [0, 1)² to the lens point (u, v) in the unit disk; +u right, +v up. (1/2, 1/2) maps to the lens's
// centre, except with a ring-shaped aperture or an aperture image.
glm::dvec2 apertureSample(const Aperture& aperture, const glm::dvec2& square);

// Returns the light density at a lens point; 0 outside the aperture. The unit depends on the aperture: without an
// aperture image, the mean density over the aperture is 1. With an image, the result is the fraction of all light that
// passes through the image's cell (see ApertureImage) at the point.
double lightDensity(const Aperture& aperture, const glm::dvec2& point);

// Maps (r, s) ∈ [0, 1)² to the unit disk; the map is area-preserving and continuous (Shirley and Chiu 1997).
glm::dvec2 concentricDisk(const glm::dvec2& square);

// Inverse of concentricDisk: returns the point of the square that maps to the point `disk` of the unit disk.
glm::dvec2 squareOfConcentricDisk(const glm::dvec2& disk);

// Returns true if the aperture is a disk with uniform light density.
bool isUniformDisk(const Aperture& aperture);

}  // namespace defocus::engine
