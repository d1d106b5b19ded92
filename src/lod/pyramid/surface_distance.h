#pragma once
// Measures how far two triangle surfaces are apart, as Cignoni, Rocchini and Scopigno do (1998, Metro: Measuring Error
// on Simplified Surfaces): from points spread evenly over the area of one surface to the closest points of the other,
// which a tree of boxes finds.
//
// Lengths are object units. A triangle without area, or with a corner that isn't finite, is no part of a surface. A
// surface may be empty: nothing is measured from it, and everything is infinitely far from it. Deterministic; equal
// surfaces scaled by a power of two give distances scaled by it, bit for bit.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/memory.h"
#include "lod/pyramid/four.h"
#include "lod/simplify/triangle_set.h"

namespace defocus::engine {

// Boxes around the four children of a node.
struct BoxNode {
    Four minimum[3];  // x, y, z
    Four maximum[3];
};

// prepareSurface makes one; from then on it is only read, by any number of threads.
struct Surface {
    LargeVector<std::array<glm::vec3, 3>> triangles;  // sorted along a Morton curve: neighbours are near in space
    LargeVector<double> areas;                        // of the triangles up to and with each one
    // A complete tree, root at 0, children of i at 4i + 1 … 4i + 4; those beyond the last node are leaves, of up to 4
    // triangles, which share the triangles evenly in their order.
    LargeVector<BoxNode> nodes;
    int leafBits = 0;  // of the number of leaves, a power of two
    float extent = 0;  // the largest absolute coordinate

    [[nodiscard]] bool empty() const { return triangles.empty(); }
};

// `indices` are three a triangle (a rest of one or two is passed over), all below positions.size().
Surface prepareSurface(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
template <typename Vertex>
Surface prepareSurface(std::span<const glm::vec3> positions, const TriangleSet<Vertex>& triangles);

// The distance from `point` (finite) to the closest point of the surface; infinite for an empty surface.
double distanceTo(const Surface& surface, const glm::dvec3& point);

// The distances to `to` from `count` points of `from`, each of which stands for an equal share of its area: there is
// one point in each stratum of the running area, placed within its triangle by the R2 sequence. None where `from` is
// empty.
std::vector<double> sampleDistances(const Surface& from, const Surface& to, std::size_t count);

// Returns the `rank`-th largest (from 1) of what sampleDistances would return, or `least` if that is larger or there
// are fewer. It is faster, because it stops looking for the closest point once it has found one that is near enough.
double largeDistance(const Surface& from, const Surface& to, std::size_t count, std::size_t rank, double min);

struct Distances {
    double mean = 0;
    double percentile99 = 0;  // nearest rank
    double maximum = 0;
};

struct SurfaceDistance {
    Distances forward;   // from points of the first to the second
    Distances backward;  // from points of the second to the first
    Distances both;      // the larger of the two, figure by figure, as the two-sided Hausdorff distance is
};

// Measures from `count` points on each surface. The mean's error falls with about 1 / count; the maximum is of these
// points only, a lower bound of the Hausdorff distance.
SurfaceDistance surfaceDistance(const Surface& first, const Surface& second, std::size_t count);

}  // namespace defocus::engine
