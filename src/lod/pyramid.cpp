#include "lod/pyramid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>

#include "core/error.h"
#include "core/parallel.h"
#include "lod/gathered.h"
#include "lod/level_fit.h"
#include "lod/level_order.h"
#include "lod/simplify.h"
#include "lod/surface_distance.h"
#include "lod/weld.h"

namespace defocus {

namespace {

constexpr double leastEdgeGrowth = 1.05;   // from level to level
constexpr double leastEdgeToError = 2;     // a level can't be as fine as its edges say where its error outgrew them
constexpr double leastErrorGrowth = 1.25;  // from level to level, from level 1 on
constexpr double errorFloor = 1e-6;        // of the box's diagonal
// Points on each of two surfaces at which a level's distance to level 0 is measured: as many as the mesh has triangles,
// within these bounds, so that it stays cheap beside the simplification.
constexpr std::size_t leastErrorPoints = 256;
constexpr std::size_t mostErrorPoints = 1024;
constexpr double errorPercentile = 0.99;

LevelTriangles allTriangles(const Mesh& mesh, const std::vector<std::uint32_t>& vertexIds) {
    LevelTriangles level;
    for (const Primitive& primitive : mesh.primitives) {
        const std::size_t count = primitive.indices.size() / 3 * 3;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t v = primitive.indices[i];
            if (v >= vertexIds.size())
                fail("mesh \"{}\": index {} is beyond its {} vertices", mesh.name, v, vertexIds.size());
            level.indices.push_back(vertexIds[v]);
        }
        level.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(count));
    }
    return level;
}

// Mean and greatest length of all faces' edges.
void measureEdges(PyramidLevel& level, const std::vector<std::uint32_t>& indices) {
    double sum = 0;
    double longest = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const double length = glm::distance(glm::dvec3(level.positions[indices[i + k]]),
                                                glm::dvec3(level.positions[indices[i + (k + 1) % 3]]));
            sum += length;
            longest = std::max(longest, length);
        }
    const double mean = indices.empty() ? 0 : sum / static_cast<double>(indices.size());
    level.meanEdge = std::isfinite(mean) ? mean : 0;
    level.longestEdge = std::isfinite(longest) ? longest : 0;
}

// Appends a level's ranges and indices; `triangles` are in final vertex numbers.
PyramidLevel appendLevel(Pyramid& pyramid, const LevelTriangles& triangles, std::vector<Cluster> clusters,
                         std::uint32_t vertexCount) {
    PyramidLevel level;
    level.clusters = std::move(clusters);
    level.vertexCount = vertexCount;
    level.triangleCount = static_cast<std::uint32_t>(triangles.indices.size() / 3);
    auto first = static_cast<std::uint32_t>(pyramid.indices.size());
    for (Cluster& cluster : level.clusters) cluster.indices.first += first;
    for (const std::uint32_t count : triangles.primitiveIndexCounts) {
        level.primitives.push_back({first, count});
        first += count;
    }
    pyramid.indices.insert(pyramid.indices.end(), triangles.indices.begin(), triangles.indices.end());
    return level;
}

// The value that the 99th percentile of the distances that `sample` was drawn from does not exceed, but for the bad
// luck of two standard deviations of the number of points beyond it.
double upperPercentile(std::vector<double> sample) {
    if (sample.empty()) return 0;
    const auto count = static_cast<double>(sample.size());
    const double deviation = std::sqrt(errorPercentile * (1 - errorPercentile) * count);
    const auto rank = static_cast<std::ptrdiff_t>(std::min(errorPercentile * count + 2 * deviation, count - 1));
    std::nth_element(sample.begin(), sample.begin() + rank, sample.end());
    return sample[static_cast<std::size_t>(rank)];
}

// Of the level's surface from the mesh's, whichever way it is larger; at most the box's diagonal, where the level has
// no area left.
double levelError(const Surface& mesh, const Surface& level, double diagonal) {
    const std::size_t points = std::clamp(mesh.triangles.size(), leastErrorPoints, mostErrorPoints);
    return std::min(std::max(upperPercentile(sampleDistances(mesh, level, points)),
                             upperPercentile(sampleDistances(level, mesh, points))),
                    diagonal);
}

// Strictly growing, so that a level can be found for any target.
void separateSizes(std::vector<PyramidLevel>& levels, double diagonal) {
    for (std::size_t l = 1; l < levels.size(); ++l) {
        levels[l].error = std::max({levels[l].error, leastErrorGrowth * levels[l - 1].error, errorFloor * diagonal});
        levels[l].meanEdge = std::max(
            {levels[l].meanEdge, leastEdgeGrowth * levels[l - 1].meanEdge, leastEdgeToError * levels[l].error});
    }
}

Pyramid build(const Mesh& mesh, const PyramidOptions& options) {
    // Join equal vertices; weld the positions of the rest.
    const Welded unique = weldVertices(mesh);
    std::vector<LevelTriangles> triangles = {allTriangles(mesh, unique.id)};
    Vertices vertices = gathered(mesh.vertices, unique.first);
    Welded positions = weldPositions(vertices.positions);
    if (vertices.normals.empty()) vertices.normals = smoothNormals(vertices.positions, triangles.front().indices);

    // Simplify.
    Pyramid pyramid;
    std::vector<double> errors = {0};
    Simplification simplification;
    if (options.mostLevels > 1)
        simplification =
            simplify(vertices, positions, triangles.front(), {options.leastTriangles, options.mostLevels - 1});
    pyramid.repairedFaces = simplification.repairedFaces;

    // Twins are vertices like others from here on; no corner of level 0 uses them.
    const std::size_t ownCount = vertices.count();
    std::vector<std::uint32_t> withTwins(ownCount);
    std::iota(withTwins.begin(), withTwins.end(), 0u);
    withTwins.insert(withTwins.end(), simplification.twins.begin(), simplification.twins.end());
    vertices = gathered(vertices, withTwins);
    for (const std::uint32_t v : simplification.twins) positions.id.push_back(positions.id[v]);

    // Fit the levels' shape and looks to the mesh, and measure how far they are from it.
    const FitSource source = prepareFit(vertices, positions, ownCount, triangles.front().indices);
    std::vector<LevelFit> fits = {{vertices.positions, vertices.normals, vertices.colors}};
    Surface surface;
    if (!simplification.levels.empty()) surface = prepareSurface(vertices.positions, triangles.front().indices);
    for (SimplifiedLevel& level : simplification.levels) {
        fits.push_back(fitLevel(source, level.anchors, level.triangles.indices));
        const Surface fitted = prepareSurface(fits.back().positions, level.triangles.indices);
        errors.push_back(levelError(surface, fitted, glm::length(source.bounds.size())));
        triangles.push_back(std::move(level.triangles));
    }

    // Order triangles by clusters and vertices by survival.
    std::vector<std::vector<Cluster>> clusters;
    for (std::size_t l = 0; l < triangles.size(); ++l)
        clusters.push_back(clusterTriangles(triangles[l], fits[l].positions));
    const SurvivalOrder order = sortBySurvival(triangles, positions);
    pyramid.vertices = gathered(vertices, order.vertices);
    pyramid.source = gathered(gathered(unique.first, withTwins), order.vertices);
    pyramid.bounds = boundsOf(pyramid.vertices.positions);

    // Describe each level.
    for (std::size_t l = 0; l < triangles.size(); ++l) {
        PyramidLevel level = appendLevel(pyramid, triangles[l], std::move(clusters[l]), order.vertexCounts[l]);
        level.error = errors[l];
        const std::vector<std::uint32_t> prefix(order.vertices.begin(), order.vertices.begin() + level.vertexCount);
        level.positions = gathered(fits[l].positions, prefix);
        level.normals = gathered(fits[l].normals, prefix);
        level.colors = gathered(fits[l].colors, prefix);
        measureEdges(level, triangles[l].indices);
        pyramid.levels.push_back(std::move(level));
    }
    separateSizes(pyramid.levels, glm::length(pyramid.bounds.size()));
    measureDeformations(pyramid, mesh);
    return pyramid;
}

}  // namespace

void measureDeformations(Pyramid& pyramid, const Mesh& mesh) {
    const Vertices& vertices = pyramid.vertices;
    const auto extendJoint = [&](std::size_t joint, const glm::vec3& position) {
        if (pyramid.jointBounds.size() <= joint) pyramid.jointBounds.resize(joint + 1);
        pyramid.jointBounds[joint].extend(glm::dvec3(position));
    };
    const auto extend = [&](const glm::vec3& position, const glm::u16vec4& joints, const glm::vec4& weights) {
        for (int i = 0; i < 4; ++i)
            if (weights[i] > 0) extendJoint(joints[i], position);
    };
    pyramid.jointBounds.clear();
    for (const PyramidLevel& level : pyramid.levels)
        for (std::size_t v = 0; v < level.positions.size() && !vertices.joints.empty(); ++v) {
            const glm::vec3& position = level.positions[v];
            extend(position, vertices.joints[v], vertices.weights[v]);
            if (!vertices.joints1.empty()) extend(position, vertices.joints1[v], vertices.weights1[v]);
            // A vertex that no joint moves follows the first.
            const bool moved = glm::any(glm::greaterThan(vertices.weights[v], glm::vec4(0)));
            if (!moved) extendJoint(0, position);
        }
    pyramid.morphBounds.clear();
    for (const MorphTarget& target : mesh.morphTargets) {
        Bounds& bounds = pyramid.morphBounds.emplace_back(boundsOf(target.positions));
        bounds.extend(glm::dvec3(0));
    }
}

Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options) {
    return build(mesh, options);
}

std::vector<Pyramid> buildPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options,
                                   const Progress& progress) {
    // The largest first, so that no core is left with a large one at the end.
    std::vector<std::size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return meshes[a].triangleCount() > meshes[b].triangleCount();
    });

    std::vector<Pyramid> pyramids(meshes.size());
    std::mutex mutex;
    std::uint64_t done = 0;
    parallelFor(meshes.size(), [&](std::size_t i) {
        pyramids[order[i]] = build(meshes[order[i]], options);
        const std::scoped_lock lock(mutex);
        report(progress, "pyramids", ++done, meshes.size());
    });
    return pyramids;
}

Pyramid fullDetail(const Mesh& mesh) {
    PyramidOptions options;
    options.mostLevels = 1;
    return build(mesh, options);
}

}  // namespace defocus
