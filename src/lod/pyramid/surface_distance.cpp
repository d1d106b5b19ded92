// Measures distances between surfaces (Cignoni, Rocchini and Scopigno 1998, Metro: Measuring Error on Simplified
// Surfaces), with sample points from the R2 sequence (Roberts 2018, The Unreasonable Effectiveness of Quasirandom
// Sequences). The bounding volume hierarchy uses the Morton order of triangles (Lauterbach et al. 2009, Fast BVH
// Construction on GPUs).

#include "lod/pyramid/surface_distance.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "core/bounds.h"
#include "core/morton_order.h"
#include "lod/simplify/triangle.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxTrianglesPerLeaf = 4;
constexpr std::size_t arity = 4;  // children per node of the bounding volume hierarchy
// Bound on the rounding error of a difference of coordinates in single precision, relative to the largest coordinate of
// the surface and the point.
constexpr float rounding = 2.5e-7f;
constexpr double infinity = std::numeric_limits<double>::infinity();
// Steps of the R2 sequence: 1/g and 1/g², where g³ = g + 1.
constexpr double stepU = 0.7548776662466927;
constexpr double stepV = 0.5698402909980532;

using Triangle = std::array<glm::vec3, 3>;

double areaOf(const Triangle& t) {
    const glm::dvec3 a = t[0];
    return 0.5 * glm::length(glm::cross(glm::dvec3(t[1]) - a, glm::dvec3(t[2]) - a));
}

struct Box {
    glm::vec3 minimum{std::numeric_limits<float>::infinity()};
    glm::vec3 maximum{-std::numeric_limits<float>::infinity()};
};

Box around(const Box& a, const Box& b) {
    return {glm::min(a.minimum, b.minimum), glm::max(a.maximum, b.maximum)};
}

Box boxOf(const Triangle& t) {
    return {glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
}

// Returns the triangles with finite corners and positive area, in Morton order. `count` is the number of triangles
// before invalid ones are removed.
template <typename TriangleAt>
LargeVector<Triangle> inMortonOrder(std::size_t count, const TriangleAt& triangle) {
    LargeVector<std::uint64_t> keys;  // Morton code in the upper 32 bits, triangle number in the lower 32 bits
    keys.reserve(count);
    Box bounds;
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle t = triangle(i);
        if (!isFinite(t[0]) || !isFinite(t[1]) || !isFinite(t[2]) || !(areaOf(t) > 0)) continue;
        bounds = around(bounds, boxOf(t));
        keys.push_back(i);
    }
    const glm::dvec3 size = glm::dvec3(bounds.maximum) - glm::dvec3(bounds.minimum);
    const double longest = std::max({size.x, size.y, size.z});
    for (std::uint64_t& key : keys) {
        const Triangle t = triangle(key);
        const glm::dvec3 centre = (glm::dvec3(t[0]) + glm::dvec3(t[1]) + glm::dvec3(t[2])) / 3.0;
        key |= std::uint64_t{mortonCode((centre - glm::dvec3(bounds.minimum)) * (maxMortonCell / longest))} << 32;
    }
    sortByMortonCode(keys);
    LargeVector<Triangle> sorted;
    sorted.reserve(keys.size());
    for (const std::uint64_t key : keys) sorted.push_back(triangle(key & 0xffffffffu));
    return sorted;
}

// Returns the number of the first triangle of a leaf. For the index after the last leaf, returns the triangle count.
std::size_t leafStart(const Surface& surface, std::size_t leaf) {
    return leaf * surface.triangles.size() >> surface.leafBits;
}

void buildNodes(Surface& surface) {
    std::size_t leaves = arity;
    std::size_t inner = 1;
    while (leaves * maxTrianglesPerLeaf < surface.triangles.size()) {
        inner += leaves;
        leaves *= arity;
    }
    surface.leafBits = std::countr_zero(leaves);
    surface.nodes.resize(inner);
    LargeVector<Box> boxes(inner + leaves);  // boxes of the inner nodes, then of the leaves
    for (std::size_t leaf = 0; leaf < leaves; ++leaf)
        for (std::size_t t = leafStart(surface, leaf); t < leafStart(surface, leaf + 1); ++t)
            boxes[inner + leaf] = around(boxes[inner + leaf], boxOf(surface.triangles[t]));
    for (std::size_t i = inner; i-- > 0;)
        for (std::size_t k = 0; k < arity; ++k) {
            const Box& child = boxes[arity * i + 1 + k];
            boxes[i] = around(boxes[i], child);
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                surface.nodes[i].minimum[axis][k] = child.minimum[axis];
                surface.nodes[i].maximum[axis][k] = child.maximum[axis];
            }
        }
    const glm::vec3 extent = glm::max(glm::abs(boxes[0].minimum), glm::abs(boxes[0].maximum));
    surface.extent = std::max({extent.x, extent.y, extent.z});
}

// Returns lower bounds of the squared distances from `p` to the node's four bounding boxes. `slack` is the max rounding
// error of a coordinate difference.
Four squaredDistances(const BoxNode& node, const glm::vec3& p, float slack) {
    const Four zero{};
    Four sums{};
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const Four below = node.minimum[axis] - p[axis];
        const Four above = p[axis] - node.maximum[axis];
        const Four outside = (below > above ? below : above) - slack;
        const Four distance = outside > zero ? outside : zero;
        sums += distance * distance;
    }
    return sums;
}

double squaredDistance(const Triangle& t, const glm::dvec3& p) {
    const glm::dvec3 offset = p - closestPoint(p, glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2]));
    return glm::dot(offset, offset);
}

struct Nearest {
    double squaredDistance = infinity;
    std::size_t triangle = 0;
};

// Returns the triangle that is closest to `p`. The search starts with the triangle `guess`, which is probably close,
// and stops at the first triangle with a squared distance of at most `enough`.
Nearest nearestTriangle(const Surface& surface, const glm::dvec3& p, std::size_t guess, double enough) {
    struct Entry {
        float squaredDistance;
        std::size_t node;
    };
    // Room for three pending nodes on each of at most 32 tree levels, plus the children of the current node.
    std::array<Entry, 3 * 32 + arity> stack;
    std::size_t size = 0;
    Nearest nearest{squaredDistance(surface.triangles[guess], p), guess};
    if (!std::isfinite(nearest.squaredDistance)) nearest.squaredDistance = infinity;
    const glm::vec3 place(p);
    const float slack = rounding * std::max({surface.extent, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
    // Returns the smallest squared distance so far, slightly enlarged to allow for rounding of the boxes' squared
    // distances.
    const auto bound = [&] { return static_cast<float>(nearest.squaredDistance * (1 + 1e-6)); };
    float max = bound();
    stack[size++] = {0, 0};
    while (size > 0) {
        if (nearest.squaredDistance <= enough) break;
        const Entry entry = stack[--size];
        if (!(entry.squaredDistance < max)) continue;
        if (entry.node >= surface.nodes.size()) {
            const std::size_t leaf = entry.node - surface.nodes.size();
            const std::size_t end = leafStart(surface, leaf + 1);
            for (std::size_t t = leafStart(surface, leaf); t < end; ++t)
                if (const double squared = squaredDistance(surface.triangles[t], p); squared < nearest.squaredDistance)
                    nearest = {squared, t};
            max = bound();
            continue;
        }
        // Push the child nodes in order of decreasing distance, so that the nearest child is on top of the stack.
        const Four squared = squaredDistances(surface.nodes[entry.node], place, slack);
        const std::size_t first = size;
        for (std::size_t k = 0; k < arity; ++k) {
            if (!(squared[k] < max)) continue;
            std::size_t at = size++;
            for (; at > first && stack[at - 1].squaredDistance < squared[k]; --at) stack[at] = stack[at - 1];
            stack[at] = {squared[k], arity * entry.node + 1 + k};
        }
    }
    return nearest;
}

// Maps (u, v), uniform in the unit square, to a uniform point on the triangle (Osada et al. 2002).
glm::dvec3 pointOf(const Triangle& t, double u, double v) {
    const double root = std::sqrt(u);
    return (1 - root) * glm::dvec3(t[0]) + root * (1 - v) * glm::dvec3(t[1]) + root * v * glm::dvec3(t[2]);
}

// Calls visit(point) for each sample point of sampleDistances().
template <typename Visit>
void forEachSample(const Surface& surface, std::size_t count, const Visit& visit) {
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double area = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * surface.areas.back();
        while (triangle + 1 < surface.areas.size() && surface.areas[triangle] < area) ++triangle;
        const double u = (static_cast<double>(i) + 0.5) * stepU;
        const double v = (static_cast<double>(i) + 0.5) * stepV;
        visit(pointOf(surface.triangles[triangle], u - std::floor(u), v - std::floor(v)));
    }
}

Distances summary(std::vector<double> distances) {
    Distances result;
    if (distances.empty()) return result;
    const auto count = static_cast<double>(distances.size());
    result.mean = std::accumulate(distances.begin(), distances.end(), 0.0) / count;
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.99 * count)) - 1;
    std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
    result.percentile99 = distances[static_cast<std::size_t>(rank)];
    result.maximum = *std::max_element(distances.begin() + rank, distances.end());
    return result;
}

Surface surfaceOf(LargeVector<Triangle> triangles) {
    Surface surface;
    surface.triangles = std::move(triangles);
    if (surface.empty()) return surface;
    double area = 0;
    surface.areas.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) surface.areas.push_back(area += areaOf(t));
    buildNodes(surface);
    return surface;
}

}  // namespace

Surface prepareSurface(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices) {
    return surfaceOf(inMortonOrder(indices.size() / 3, [&](std::size_t t) {
        return Triangle{positions[indices[3 * t]], positions[indices[3 * t + 1]], positions[indices[3 * t + 2]]};
    }));
}

template <typename Vertex>
Surface prepareSurface(std::span<const glm::vec3> positions, const TriangleSet<Vertex>& triangles) {
    return surfaceOf(inMortonOrder(triangles.count(), [&](std::size_t t) {
        const auto v = triangles.corners(itemAt<TriangleNumber>(t));
        return Triangle{positions[indexOf(v[0])], positions[indexOf(v[1])], positions[indexOf(v[2])]};
    }));
}
template Surface prepareSurface(std::span<const glm::vec3>, const TriangleSet<MeshVertexNumber>&);
template Surface prepareSurface(std::span<const glm::vec3>, const TriangleSet<LevelVertexNumber>&);

double distanceTo(const Surface& surface, const glm::dvec3& point) {
    return surface.empty() ? infinity : std::sqrt(nearestTriangle(surface, point, 0, 0).squaredDistance);
}

std::vector<double> sampleDistances(const Surface& from, const Surface& to, std::size_t count) {
    if (from.empty()) return {};
    if (to.empty()) return std::vector<double>(count, infinity);
    std::vector<double> distances;
    distances.reserve(count);
    std::size_t nearest = 0;  // triangle nearest to the previous point, used as a first guess
    forEachSample(from, count, [&](const glm::dvec3& point) {
        const Nearest found = nearestTriangle(to, point, nearest, 0);
        nearest = found.triangle;
        distances.push_back(std::sqrt(found.squaredDistance));
    });
    return distances;
}

double largeDistance(const Surface& from, const Surface& to, std::size_t count, std::size_t rank, double min) {
    if (from.empty() || rank == 0 || count < rank) return min;
    if (to.empty()) return infinity;
    std::vector<double> largest(rank, min * min);  // largest squared distances, as a heap with the smallest on top
    std::size_t nearest = 0;                       // triangle nearest to the previous point, used as a first guess
    forEachSample(from, count, [&](const glm::dvec3& point) {
        const Nearest found = nearestTriangle(to, point, nearest, largest.front());
        nearest = found.triangle;
        if (!(found.squaredDistance > largest.front())) return;
        std::pop_heap(largest.begin(), largest.end(), std::greater());
        largest.back() = found.squaredDistance;
        std::push_heap(largest.begin(), largest.end(), std::greater());
    });
    return std::max(min, std::sqrt(largest.front()));
}

SurfaceDistance surfaceDistance(const Surface& first, const Surface& second, std::size_t count) {
    SurfaceDistance result;
    result.forward = summary(sampleDistances(first, second, count));
    result.backward = summary(sampleDistances(second, first, count));
    result.both = {std::max(result.forward.mean, result.backward.mean),
                   std::max(result.forward.percentile99, result.backward.percentile99),
                   std::max(result.forward.maximum, result.backward.maximum)};
    return result;
}

}  // namespace defocus::engine
