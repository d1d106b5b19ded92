#pragma once
// What photographers ask of a lens: from where to where is the picture sharp enough?
//
// With A the aperture's diameter, v the distance from lens to sensor and s the focus distance (all m), a point at depth
// z leaves a disk of diameter C(z) = A·v·|1/s − 1/z| on the sensor. For a largest acceptable disk C the depths between
//   1/near = 1/s + C/(A·v)   and   1/far = 1/s − C/(A·v)
// are in focus; the hyperfocal distance is the s for which far is infinite. For an off-axis graphics camera v is the
// focal length f, so that with f-number N
//   hyperfocal H = f²/(N·C),  near = H·s/(H + s),  far = H·s/(H − s);
// with focus breathing v = f·s/(s − f) is the thin lens's, and these are the textbook's
//   H = f²/(N·C) + f,  near = s·(H − f)/(H + s − 2f),  far = s·(H − f)/(H − s).
//   Ray 2002, Applied Photographic Optics, chapter 22.
// All this is the plain lens's: limits, ranges, tilt and curvature of the blur (circle_of_confusion.h) are left aside.

#include <glm/vec2.hpp>

#include "lens/lens.h"

namespace defocus::engine {

struct DepthOfField {
    double hyperfocal = 0;  // m; 0 where everything is always in focus
    double near = 0;        // m
    double far = 0;         // m; may be infinite
};

// `acceptable`: the largest diameter on the sensor that passes for a point, mm, > 0.
DepthOfField depthOfField(const Lens& lens, double acceptable);

// The part of the sensor that an image of `width` x `height` px shows, mm: horizontalAperture wide.
glm::dvec2 sensorSize(const Lens& lens, int width, int height);

// The customary acceptable circle of confusion: the sensor's diagonal over 1500, mm (0.029 mm for 36 × 24 mm).
double customaryCircleOfConfusion(const Lens& lens, int width, int height);

}  // namespace defocus::engine
