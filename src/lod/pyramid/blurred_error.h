#pragma once
// How wrong is a level once it is blurred? Each level and level 0 are looked at from a few directions (picture.h), with
// the materials of the mesh, under the lights of scenes that have none. So colour, light (by normals) and the place of
// outlines all count, as far as each can be seen. What the level changes is averaged over square patches first, with
// its sign, and then squared: E(level, s) is what a blur of size s leaves of it.
//
// The same pictures of level 0 tell how much a lens sample errs: V(s) is the standard deviation of the light within
// patches of side s, which is what one sample that falls anywhere in a blur of that size is off by; N samples of a
// sequence are off by V · N^−p. Both are in the same unit, so that how bright the object is and how it is shown cancel.
// Light above four times the mesh's mean counts as that much, after the blur, as it does in a picture of it: it is
// white.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lod/pyramid/finish.h"
#include "lod/pyramid/pyramid.h"

namespace defocus {

// Fills Pyramid::smallestPatch, Pyramid::contrast and PyramidLevel::blurredError from the rest and the finishes of the
// mesh's primitives; none: all are white and matt. Deterministic, whatever the number of `helpers`, which are threads
// beside the caller's. Errors grow by a tenth or more from level to level,
// so that a level can be found for any target.
void measureBlurredErrors(Pyramid& pyramid, std::span<const Finish> finishes, std::size_t helpers = 0);

// The directions from the mesh to the eyes, unit.
std::vector<glm::dvec3> blurredErrorViews();

// Light that is brighter, in units of the mean light of the mesh, is shown as bright as that.
inline constexpr double shownWhite = 4;

// E and V squared for a patch of side `side`, in object units, ≥ 0; continuous in it. Beyond the largest patch E falls
// as that of a spot, with the side.
double squaredError(const Pyramid& pyramid, std::size_t level, double side);
double squaredContrast(const Pyramid& pyramid, double side);

// λ where the level's error is `share` times V, both root mean squares over patches of these sides (object units). It
// is continuous in sides and share; 0 where no level's error is known.
double levelOfBlurredError(const Pyramid& pyramid, std::span<const double> sides, double share);

}  // namespace defocus
