#pragma once
// Measures how wrong a level is once it is blurred. Each level and level 0 are drawn from a few directions (picture.h),
// with the materials of the mesh, under the lights that a scene without lights gets. So colour, light (by normals) and
// the place of outlines all count, as far as each can be seen. The difference from level 0 is first averaged over
// square patches, with its sign, and then squared: E(level, s) is what a blur of size s leaves of the difference.
//
// The same pictures of level 0 tell how wrong a lens sample is. V(s) is the standard deviation of the light within
// patches of side s: one sample that falls anywhere in a blur of that size is off by so much, and N samples of a
// sequence by V · N^−p. E and V have the same unit, so their ratio doesn't depend on how bright the object is or how it
// is shown. Light above four times the mesh's mean counts as that much, after the blur, because a picture shows it as
// white.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/finish.h"
#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Fills Pyramid::smallestPatch, Pyramid::contrast and PyramidLevel::blurredError from the rest of the pyramid and the
// finishes of the mesh's primitives. Without finishes all are white and matt. Errors grow by a tenth or more from level
// to level, so that a level can be found for any target. `helpers`: threads beside the caller's; the result doesn't
// depend on their number.
void measureBlurredErrors(Pyramid& pyramid, std::span<const Finish> finishes, std::size_t helpers = 0);

// Returns the directions from the mesh to the eyes; unit length.
std::vector<glm::dvec3> blurredErrorViews();

// In units of the mean light of the mesh; brighter light is shown as if it were only this bright.
inline constexpr double shownWhite = 4;

// Return E² and V² for a patch of side `side` (object units, ≥ 0). They are continuous in the side. Beyond the largest
// patch of the table, E falls as 1/side, as that of a spot does.
double squaredError(const Pyramid& pyramid, std::size_t level, double side);
double squaredContrast(const Pyramid& pyramid, double side);

// Returns the λ at which the level's error is measuredLimit(light, edge) times V. Error and V are root mean squares
// over patches of these sides (object units). The edge is the level's mean edge, at `pixelsPerUnit` (> 0) px per object
// unit. λ is continuous in all of them, and 0 if no level's error is known.
double levelOfBlurredError(const Pyramid& pyramid, std::span<const double> sides, double pixelsPerUnit, double light);

}  // namespace defocus::engine
