#pragma once
// Computes the depth of field: the range of depths that appears acceptably sharp.
//
// Let A be the aperture's diameter, v the distance from lens to sensor, and s the focus distance (all in m). A point at
// depth z forms a disk of diameter C(z) = A·v·|1/s − 1/z| on the sensor. For an acceptable diameter C, the depths in
// focus lie between
//   1/near = 1/s + C/(A·v)   and   1/far = 1/s − C/(A·v).
// The hyperfocal distance is the s for which far is infinite. For an off-axis graphics camera v is the focal length f.
// With f-number N,
//   hyperfocal H = f²/(N·C),  near = H·s/(H + s),  far = H·s/(H − s).
// With focus breathing v = f·s/(s − f), as for the thin lens, and the textbook formulas apply:
//   H = f²/(N·C) + f,  near = s·(H − f)/(H + s − 2f),  far = s·(H − f)/(H − s).
//   Ray 2002, Applied Photographic Optics, chapter 22.
// The artistic controls of circle_of_confusion.h are ignored: limits, focus range, tilt and curvature.

#include <glm/vec2.hpp>

#include "lens/lens.h"

namespace defocus::engine {

struct DepthOfField {
    double hyperfocal = 0;  // hyperfocal distance in m; 0 for a pinhole, where all depths are in focus
    double near = 0;        // min depth in focus, m
    double far = 0;         // max depth in focus, m; may be infinite
};

// Returns the depth of field. `acceptable`, in mm and > 0, is the largest diameter on the sensor that still appears as
// a point.
DepthOfField depthOfField(const Lens& lens, double acceptable);

// Returns the size in mm of the sensor area that an image of `width` x `height` px shows; its width is
// horizontalAperture.
glm::dvec2 sensorSize(const Lens& lens, int width, int height);

// Returns the customary acceptable circle of confusion in mm: the sensor's diagonal over 1500 (0.029 mm for 36 × 24
// mm).
double customaryCircleOfConfusion(const Lens& lens, int width, int height);

}  // namespace defocus::engine
