#pragma once
// The shape of the aperture and how its light is spread: a map of the unit square to the lens. It is continuous but for
// a ring's or an image's seams, so that points that are well spread over the square are so over the lens.
//
// Lens samples weigh the same, so a blurred point has the same energy, and an image the same exposure, whatever the
// shape. With t ∈ [0, 1] the share of the area that lies nearer to the centre, the light's density is
//   1 + k·(2t − 1)                                                              (k: Lens::sphericalAberration)
// over the disk, polygon or ring, and the image's value over an image. A blade's edge at angle φ from its middle has
// the radius (1 − q)·cos(π/n)/cos φ + q for n blades of curvature q: a chord at 0, an arc of the circle at 1.

#include <glm/vec2.hpp>
#include <vector>

#include "lens/lens.h"

namespace defocus::engine {

// Where the light of an aperture image passes, as cumulative sums over square cells, row by row from the top: pixels,
// or parts of pixels of a small image, or groups of pixels of a large one.
struct ApertureImage {
    int columns = 0;
    int rows = 0;
    std::vector<double> rowEnds;  // share of all light up to the end of each row; the last is 1
    std::vector<float> cellEnds;  // columns · rows; share of its row's light up to the end of each cell
};

// What Lens says of its aperture, ready to be sampled. Costly to make for an image only.
struct Aperture {
    int bladeCount = 0;
    double bladeRotation = 0;  // radians
    double bladeCurvature = 0;
    double anamorphicRatio = 1;
    double obstruction = 0;  // share of the area
    double sphericalAberration = 0;
    ApertureImage image;  // without rows: none
};

// The longer side of an aperture image spans the lens; what lies outside the unit disk is blocked. The image's top is
// the lens's top. Throws Error for an image that is empty, black within the disk, or holds values below 0, NaN or
// infinity.
Aperture makeAperture(const Lens& lens);

// (r, s) ∈ [0, 1)² → (u, v) in the unit disk; +u right, +v up. (1/2, 1/2) is the centre, where the shape has one: a
// ring and an image have none.
glm::dvec2 apertureSample(const Aperture& aperture, const glm::dvec2& square);

// (r, s) ∈ [0, 1)² → the unit disk, area preserving and continuous (Shirley and Chiu 1997).
glm::dvec2 concentricDisk(const glm::dvec2& square);

// The inverse of concentricDisk, for a point of the unit disk.
glm::dvec2 squareOfConcentricDisk(const glm::dvec2& disk);

// Is it a disk of which each part lets the same light through?
bool isUniformDisk(const Aperture& aperture);

}  // namespace defocus::engine
