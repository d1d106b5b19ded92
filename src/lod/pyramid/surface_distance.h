#pragma once
// Measures the distance between two triangle surfaces (Cignoni, Rocchini and Scopigno 1998, Metro: Measuring Error on
// Simplified Surfaces). Sample points are distributed evenly over the area of one surface. The closest point of the
// other surface is found with a bounding volume hierarchy.
//
// Lengths are in object units. Triangles without area and triangles with NaN or infinite corners are ignored. An empty
// surface has no sample points, and every distance to it is infinite. Deterministic. Scaling both surfaces by a power
// of two scales the distances by exactly the same factor.

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

// Bounding boxes of the four children of a node of the bounding volume hierarchy.
struct BoxNode {
    Four minimum[3];  // x, y and z; each vector has one value per child
    Four maximum[3];
};

// A surface with its bounding volume hierarchy, made by prepareSurface. It is immutable and may be read by several
// threads.
struct Surface {
    LargeVector<std::array<glm::vec3, 3>> triangles;  // in Morton order: neighbours in memory are close in space
    LargeVector<double> areas;                        // area of each triangle plus the areas of all triangles before it
    // Complete 4-ary tree: the root is node 0, and the children of node i are 4i + 1 … 4i + 4. Child indices beyond the
    // last node denote leaves. The leaves split the triangle list into nearly equal runs of up to 4 triangles.
    LargeVector<BoxNode> nodes;
    int leafBits = 0;  // log2 of the number of leaves
    float extent = 0;  // largest absolute coordinate of the surface

    [[nodiscard]] bool empty() const { return triangles.empty(); }
};

// Builds the bounding volume hierarchy of a surface. Three indices form a triangle; one or two remaining indices are
// ignored. All indices must be below positions.size().
Surface prepareSurface(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices);
template <typename Vertex>
Surface prepareSurface(std::span<const glm::vec3> positions, const TriangleSet<Vertex>& triangles);

// Returns the distance from `point` (finite) to the closest point of the surface; infinity for an empty surface.
double distanceTo(const Surface& surface, const glm::dvec3& point);

// Returns the distances from `count` points of `from` to the surface `to`. The area of `from` is divided into `count`
// equal strata, with one point each. The R2 sequence places each point within its triangle. Returns an empty vector if
// `from` is empty.
std::vector<double> sampleDistances(const Surface& from, const Surface& to, std::size_t count);

// Returns the `rank`-th largest (counted from 1) of the distances that sampleDistances returns, but at least `min`.
// Returns `min` if there are fewer than `rank` distances. Faster than sampleDistances, because the search for a closest
// point stops as soon as it cannot affect the result.
double largeDistance(const Surface& from, const Surface& to, std::size_t count, std::size_t rank, double min);

struct Distances {
    double mean = 0;
    double percentile99 = 0;  // 99th percentile of the distances, by the nearest-rank method
    double maximum = 0;
};

struct SurfaceDistance {
    Distances forward;   // distances from the first surface to the second
    Distances backward;  // distances from the second surface to the first
    Distances both;      // each value is the larger of `forward` and `backward`, like the two-sided Hausdorff distance
};

// Measures the distances from `count` points on each surface to the other surface. The error of the mean falls
// approximately as 1 / count. The maximum covers only these points, so that it is a lower bound of the Hausdorff
// distance.
SurfaceDistance surfaceDistance(const Surface& first, const Surface& second, std::size_t count);

}  // namespace defocus::engine
