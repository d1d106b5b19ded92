#include "lod/pyramid/pyramid.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "lod/pyramid/surface_distance.h"
#include "lod/simplify/gathered.h"
#include "lod/simplify/level_fit.h"
#include "lod/simplify/level_growth.h"
#include "lod/simplify/level_order.h"
#include "lod/simplify/simplify.h"
#include "lod/simplify/smoothing_groups.h"
#include "lod/simplify/weld.h"

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
constexpr std::size_t mostPossibleLevels = 128;  // each leaves three quarters of at most 2³² triangles
constexpr double mostSpread = 2;                 // of numbers, in square roots of the vertices' count
constexpr std::uint32_t unfitted = 0xffffffffu;

TriangleSet allTriangles(const Mesh& mesh, const std::vector<std::uint32_t>& vertexIds) {
    TriangleSet level;
    level.indices.reserve(3 * mesh.triangleCount());
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

bool isIdentity(const std::vector<std::uint32_t>& numbers, std::size_t count) {
    if (numbers.size() != count) return false;
    for (std::size_t v = 0; v < count; ++v)
        if (numbers[v] != v) return false;
    return true;
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
PyramidLevel appendLevel(Pyramid& pyramid, const TriangleSet& triangles, std::vector<Cluster> clusters,
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

// How many of `count` distances are larger than, or as large as, the value that the 99th percentile of what they were
// drawn from does not exceed, but for the bad luck of two standard deviations of the number of points beyond it.
std::size_t percentileRank(std::size_t count) {
    const auto number = static_cast<double>(count);
    const double deviation = std::sqrt(errorPercentile * (1 - errorPercentile) * number);
    return count - static_cast<std::size_t>(std::min(errorPercentile * number + 2 * deviation, number - 1));
}

// Of the level's surface from the mesh's, whichever way it is larger; at most the box's diagonal, where the level has
// no area left.
double levelError(const Surface& mesh, const Surface& level, double diagonal) {
    const std::size_t points = std::clamp(mesh.triangles.size(), leastErrorPoints, mostErrorPoints);
    const std::size_t rank = percentileRank(points);
    const double oneWay = largeDistance(mesh, level, points, rank, 0);
    return std::min(largeDistance(level, mesh, points, rank, oneWay), diagonal);
}

// Strictly growing, so that a level can be found for any target.
void separateSizes(std::vector<PyramidLevel>& levels, double diagonal) {
    for (std::size_t l = 1; l < levels.size(); ++l) {
        levels[l].error = std::max({levels[l].error, leastErrorGrowth * levels[l - 1].error, errorFloor * diagonal});
        levels[l].meanEdge = std::max(
            {levels[l].meanEdge, leastEdgeGrowth * levels[l - 1].meanEdge, leastEdgeToError * levels[l].error});
    }
}

// Whether triangles that follow each other, and their corners, have numbers far apart, so that caches are of little
// help: on a grid in rows they are √n apart.
bool isScattered(const TriangleSet& triangles, std::size_t vertexCount) {
    const std::vector<std::uint32_t>& v = triangles.indices;
    const auto apart = [](std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; };
    std::uint64_t sum = 0;
    for (std::size_t i = 3; i < v.size(); ++i) sum += apart(v[i], v[i - 3]);
    for (std::size_t i = 0; i < v.size(); i += 3) sum += apart(v[i], v[i + 1]);
    return static_cast<double>(sum) >
           mostSpread * std::sqrt(static_cast<double>(vertexCount)) * static_cast<double>(v.size());
}

// Numbers vertices, and then orders the triangles of each primitive, so that what is near in space is so in memory.
void sortSpatially(Welded& unique, const std::vector<glm::vec3>& positions) {
    if (unique.first.empty()) return;
    std::vector<glm::vec3> places = gathered(positions, unique.first);
    for (glm::vec3& place : places)
        if (!isFinite(place)) place = glm::vec3(0);
    std::vector<std::uint32_t> order(places.size());
    meshopt_spatialSortRemap(order.data(), &places[0].x, places.size(), sizeof(glm::vec3));
    for (std::uint32_t& id : unique.id) id = order[id];
    std::vector<std::uint32_t> first(places.size());
    for (std::size_t v = 0; v < order.size(); ++v) first[order[v]] = unique.first[v];
    unique.first = std::move(first);
}

void sortSpatially(TriangleSet& triangles) {
    std::size_t first = 0;
    std::vector<std::array<std::uint32_t, 4>> sorted;  // the triangle, after the place that it is sorted by
    for (const std::uint32_t count : triangles.primitiveIndexCounts) {
        std::uint32_t* const indices = triangles.indices.data() + first;
        sorted.clear();
        for (std::size_t i = 0; i < count; i += 3)
            sorted.push_back(
                {std::min({indices[i], indices[i + 1], indices[i + 2]}), indices[i], indices[i + 1], indices[i + 2]});
        std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
        for (std::size_t t = 0; t < sorted.size(); ++t) std::copy_n(sorted[t].begin() + 1, 3, indices + 3 * t);
        first += count;
    }
}

// A level until its vertices are in their final order.
struct FittedLevel {
    TriangleSet triangles;            // first in numbers of its own vertices, then in those of `numbers`
    std::vector<std::uint32_t> numbers;  // of its vertices, see SimplifiedLevel
    LevelFit fit;                        // of the same
    std::vector<Cluster> clusters;
    std::vector<Ball> removed;  // see SimplifiedLevel
    double error = 0;
};

FittedLevel fitted(const FitSource& source, SimplifiedLevel level) {
    FittedLevel result;
    result.fit = fitLevel(source, level.mesh, std::move(level.anchors));
    growComponents(result.fit.positions, level, source.bounds);
    result.removed = std::move(level.removed);
    result.triangles = std::move(level.mesh.triangles);
    result.numbers = std::move(level.numbers);
    return result;
}

// At least as far as any point of what the level lacks is from what it has, and as large as what it lacks.
double removedError(const std::vector<Ball>& removed, const Surface& level) {
    double error = 0;
    for (const Ball& ball : removed)
        error = std::max(error, ball.radius + std::max(ball.radius, distanceTo(level, ball.centre)));
    return error;
}

// How far the level is from the mesh.
void measure(FittedLevel& level, const Surface& mesh, double diagonal) {
    const Surface surface = prepareSurface(level.fit.positions, level.triangles.indices);
    level.error =
        std::max(levelError(mesh, surface, diagonal), std::min(removedError(level.removed, surface), diagonal));
    level.removed = {};
}

// Orders the level's triangles by clusters; `positions` are the mesh's, twins included.
void cluster(FittedLevel& level, const Welded& positions) {
    const std::vector<std::uint32_t> places = gathered(positions.id, level.numbers);
    level.clusters = clusterTriangles(level.triangles, level.fit.positions, places, positions.first.size());
    for (std::uint32_t& v : level.triangles.indices) v = level.numbers[v];
}

// Values of the first `count` vertices in the order of `sources`: the level's where it has any, else the mesh's.
template <typename T>
std::vector<T> inOrder(const std::vector<T>& own, const std::vector<T>& fitted,
                       const std::vector<std::uint32_t>& fittedAt, const std::vector<std::uint32_t>& sources,
                       std::size_t count) {
    std::vector<T> result;
    if (own.empty()) return result;
    result.reserve(count);
    for (std::size_t v = 0; v < count; ++v)
        result.push_back(fittedAt[v] == unfitted ? own[sources[v]] : fitted[fittedAt[v]]);
    return result;
}

Pyramid build(const Mesh& mesh, const PyramidOptions& options, std::size_t helpers) {
    // Join equal vertices; weld the positions of the rest.
    Welded unique = weldVertices(mesh);
    std::vector<FittedLevel> levels(1);
    levels[0].triangles = allTriangles(mesh, unique.id);
    if (isScattered(levels[0].triangles, unique.first.size())) {
        sortSpatially(unique, mesh.vertices.positions);
        levels[0].triangles = allTriangles(mesh, unique.id);
        sortSpatially(levels[0].triangles);
    }
    unique.id = {};
    Vertices joined;  // unless the mesh has them as they are
    const bool asTheyAre = !mesh.vertices.normals.empty() && isIdentity(unique.first, mesh.vertices.count());
    if (!asTheyAre) joined = gathered(mesh.vertices, unique.first);
    if (!asTheyAre && joined.normals.empty())
        joined.normals = smoothNormals(joined.positions, levels[0].triangles.indices);
    const Vertices& vertices = asTheyAre ? mesh.vertices : joined;
    Welded positions = weldPositions(vertices.positions);

    // Simplify, and fit every level while the next ones are made.
    Pyramid pyramid;
    Simplification simplification;
    double diagonal = 0;
    if (options.mostLevels > 1) {
        const std::vector<std::uint32_t> smoothing = smoothingGroups(vertices.normals, positions.id);
        std::optional<FitSource> source;  // once the first level is there: collapsing the whole mesh takes most memory
        std::once_flag prepared;
        const auto prepare = [&] {
            source.emplace(prepareFit(vertices, positions, smoothing, levels[0].triangles.indices));
        };
        std::vector<FittedLevel> coarser(
            std::min<std::size_t>(mostPossibleLevels, static_cast<std::size_t>(options.mostLevels) - 1));
        Tasks tasks(helpers);
        simplification = simplify(vertices, positions, smoothing, levels[0].triangles,
                                  {options.leastTriangles, options.mostLevels - 1}, tasks,
                                  [&](std::uint32_t l, SimplifiedLevel level) {
                                      std::call_once(prepared, prepare);
                                      coarser[l] = fitted(*source, std::move(level));
                                  });
        tasks.wait();
        if (source) diagonal = glm::length(source->bounds.size());
        coarser.resize(simplification.levelCount);
        std::move(coarser.begin(), coarser.end(), std::back_inserter(levels));
    }
    if (mesh.triangleCount() >= fewestToGiveBack) giveBackFreedMemory();
    pyramid.repairedFaces = simplification.repairedFaces;
    pyramid.end = simplification.end;

    // Twins are vertices like others from here on; no corner of level 0 uses them.
    const std::size_t ownCount = vertices.count();
    for (const std::uint32_t v : simplification.twins) positions.id.push_back(positions.id[v]);

    // Measure them, then cluster them; each gives back what it takes before the next begins.
    if (levels.size() > 1) {
        const Surface surface = prepareSurface(vertices.positions, levels[0].triangles.indices);
        Tasks tasks(helpers);
        for (std::size_t l = 1; l < levels.size(); ++l) tasks.add([&, l] { measure(levels[l], surface, diagonal); });
        tasks.wait();
    }
    {
        Tasks tasks(helpers);
        tasks.add([&] {
            levels[0].clusters =
                clusterTriangles(levels[0].triangles, vertices.positions, positions.id, positions.first.size());
        });
        for (std::size_t l = 1; l < levels.size(); ++l) tasks.add([&, l] { cluster(levels[l], positions); });
        tasks.wait();
    }

    // Order vertices by survival.
    std::vector<TriangleSet> triangles;
    triangles.reserve(levels.size());
    for (FittedLevel& level : levels) triangles.push_back(std::move(level.triangles));
    const SurvivalOrder order = sortBySurvival(triangles, positions);
    std::vector<std::uint32_t> sources;
    sources.reserve(order.vertices.size());
    for (const std::uint32_t v : order.vertices)
        sources.push_back(v < ownCount ? v : simplification.twins[v - ownCount]);
    pyramid.vertices = gathered(vertices, sources);
    pyramid.source = gathered(unique.first, sources);
    pyramid.bounds = boundsOf(pyramid.vertices.positions);

    // Describe each level.
    std::vector<std::uint32_t> fittedAt(ownCount + simplification.twins.size(), unfitted);
    std::vector<std::uint32_t> inPrefix;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        FittedLevel& done = levels[l];
        PyramidLevel level = appendLevel(pyramid, triangles[l], std::move(done.clusters), order.vertexCounts[l]);
        level.error = done.error;
        for (std::size_t v = 0; v < done.numbers.size(); ++v) fittedAt[done.numbers[v]] = static_cast<std::uint32_t>(v);
        inPrefix.clear();
        for (std::size_t v = 0; v < level.vertexCount; ++v) inPrefix.push_back(fittedAt[order.vertices[v]]);
        for (const std::uint32_t v : done.numbers) fittedAt[v] = unfitted;
        level.positions = inOrder(vertices.positions, done.fit.positions, inPrefix, sources, level.vertexCount);
        level.normals = inOrder(vertices.normals, done.fit.normals, inPrefix, sources, level.vertexCount);
        level.colors = inOrder(vertices.colors, done.fit.colors, inPrefix, sources, level.vertexCount);
        measureEdges(level, triangles[l].indices);
        pyramid.levels.push_back(std::move(level));
        done = {};
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

Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options, std::size_t helpers) {
    return build(mesh, options, helpers);
}

std::size_t pyramidHelpers(const Mesh& mesh, std::span<const Mesh> meshes) {
    std::uint64_t all = 0;
    for (const Mesh& each : meshes) all += each.triangleCount();
    const double share =
        static_cast<double>(mesh.triangleCount()) / static_cast<double>(std::max<std::uint64_t>(1, all));
    const auto cores = std::llround(share * std::max(1u, std::thread::hardware_concurrency()));
    return static_cast<std::size_t>(std::max(1ll, cores) - 1);
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
        pyramids[order[i]] = build(meshes[order[i]], options, pyramidHelpers(meshes[order[i]], meshes));
        const std::scoped_lock lock(mutex);
        report(progress, "pyramids", ++done, meshes.size());
    });
    return pyramids;
}

Pyramid fullDetail(const Mesh& mesh) {
    PyramidOptions options;
    options.mostLevels = 1;
    return build(mesh, options, 0);
}

}  // namespace defocus
