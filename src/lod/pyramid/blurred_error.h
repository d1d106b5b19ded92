#pragma once
// Measures the error of a level of detail after blurring. Level 0 (the full mesh) and each coarser level are rendered
// from several directions (picture.h) with the mesh's materials, and with the lights that a scene without lights gets
// by default. The error therefore includes visible differences in colour, shading and outlines. The signed difference
// from level 0 is averaged over square patches and then squared. E(level, s) is the RMS of the difference that remains
// after a blur of size s.
//
// The images of level 0 also give the error of a lens sample. V(s) is the standard deviation of the radiance within
// patches of side s. One sample at a random position within a blur of size s has the error V(s). N samples have the
// error V(s) · N^−p, where p is the convergence rate of the sample sequence. E and V have the same unit, so that their
// ratio is independent of the object's brightness and of the exposure. After averaging, radiance is clamped to four
// times the mean radiance of the mesh, because brighter values appear white in an image.
//
// Errors are measured on two backgrounds: black, and a grey of the mesh's mean radiance. On black, outlines dominate
// both E and V. A real background may hide the outlines; the error of the samples then depends only on the contrast of
// the shading. On both backgrounds, the relative error E/V of a level must stay below a limit (measuredLimit). On grey,
// V is the mean of the patches' standard deviations. Their RMS would be dominated by the few edges where samples have
// large errors. A level's errors are spread over smooth surfaces, where they are more visible.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/finish.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Computes Pyramid::smallestPatch, Pyramid::contrast and PyramidLevel::blurredError. `finishes` are the simplified
// materials of the mesh's primitives; if empty, all primitives are white and matt. Errors are raised where needed, so
// that they grow by at least 10 % per level and every target error selects a unique level. `helpers` is the number of
// additional threads; it does not affect the result.
void measureBlurredErrors(Pyramid& pyramid, std::span<const Finish> finishes, std::size_t helpers = 0);

// Returns the directions from which levels are rendered and compared: unit vectors from the mesh to the eye.
std::vector<glm::dvec3> blurredErrorViews();

// Radiance is clamped to this multiple of the mesh's mean radiance, because brighter values appear white in an image.
inline constexpr double shownWhite = 4;

// Return the squared error E² of a level, and the squared contrast V² of level 0. The blur is represented by square
// patches of side `side` (object units, ≥ 0). E² and V² are continuous in `side`. On a grey background, V is at least
// 0.4 % of the mean radiance. Beyond the largest measured patch, E falls as 1/side, as for a single bright spot.
double squaredError(const Pyramid& pyramid, std::size_t level, double side, Surround surround = Surround::black);
double squaredContrast(const Pyramid& pyramid, double side, Surround surround = Surround::black);

// Returns the real-valued level λ at which the relative error E/V reaches the limit measuredLimit(light, edge). E is
// the level's error and V the contrast of level 0, both as RMS over square patches with the sides `sides` (object
// units). Of the backgrounds black and grey, the one with the larger E/V counts. `light` is the threshold
// LodThresholds::light in px. `edge` is the level's mean edge length in px, at `pixelsPerUnit` (> 0) px per object
// unit. Returns the coarsest level if E/V stays below the limit, and 0 if `light` is 0 or no errors were measured. λ is
// continuous in all arguments.
double levelOfBlurredError(const Pyramid& pyramid, std::span<const double> sides, double pixelsPerUnit, double light);

}  // namespace defocus::engine
