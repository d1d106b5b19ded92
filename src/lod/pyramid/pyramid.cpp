#include "lod/pyramid/pyramid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>

#include "core/enum_name.h"
#include "core/error.h"
#include "core/memory.h"
#include "lod/pyramid/blurred_error.h"
#include "lod/pyramid/build_memory.h"
#include "lod/pyramid/clusters.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/surface_distance.h"
#include "lod/pyramid/vertex_order.h"
#include "lod/simplify/level_fit.h"
#include "lod/simplify/simplify.h"
#include "lod/simplify/weld.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

namespace {

constexpr double minEdgeGrowth = 1.05;   // min ratio of the mean edge lengths of consecutive levels
constexpr double minEdgeToError = 2;     // min ratio of a level's mean edge length to its error
constexpr double minErrorGrowth = 1.25;  // min ratio of the errors of consecutive levels, from level 1 on
constexpr double errorFloor = 1e-6;      // min error of level 1, relative to the bounding box's diagonal
// Min and max number of sample points on each surface for measuring the distance between a level and level 0. Between
// these bounds, one point per triangle of the surface is used, so that measuring takes little time compared with
// simplification.
constexpr std::size_t minErrorPoints = 256;
constexpr std::size_t maxErrorPoints = 1024;
constexpr double errorPercentile = 0.99;
// Number of levels that suffices for 2³² triangles, because each level has at most ¾ of the triangles of the next finer
// level.
constexpr std::size_t maxPossibleLevels = 128;

TriangleSet<MeshVertexNumber> allTriangles(const Mesh& mesh, const Numbered<FileVertexNumber, MeshVertexNumber>& ids) {
    TriangleSet<MeshVertexNumber> level;
    level.indices.reserve(3 * mesh.triangleCount());
    for (const Primitive& primitive : mesh.primitives) {
        const std::size_t count = primitive.indices.size() / 3 * 3;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t v = primitive.indices[i];
            if (v >= ids.size())
                fail("mesh \"{}\": index {} is out of range; there are {} vertices", mesh.name, v, ids.size());
            level.indices.push_back(ids[{v}]);
        }
        level.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(count));
    }
    return level;
}

template <typename Numbers>
std::vector<std::uint32_t> plain(const Numbers& numbers) {
    std::vector<std::uint32_t> values;
    values.reserve(numbers.size());
    for (const auto number : numbers) values.push_back(number.value);
    return values;
}

bool isIdentity(const Numbered<MeshVertexNumber, FileVertexNumber>& first, std::size_t count) {
    if (first.size() != count) return false;
    for (const MeshVertexNumber v : first.numbers())
        if (first[v].value != v.value) return false;
    return true;
}

// Returns whether the mesh has so few duplicates, `equal` of `count` vertices, that a copy without them would need more
// memory than it saves.
bool areFew(std::size_t equal, std::size_t count) {
    return equal < count / 4;
}

// Keeps duplicates as separate vertices, so that all vertices have the same numbers as in the file. Triangles still use
// only the first of several equal vertices.
void leaveApart(WeldedVertices& unique, TriangleSet<MeshVertexNumber>& triangles, std::size_t count) {
    for (MeshVertexNumber& v : triangles.indices) v = {unique.first[v].value};
    unique.first.resize(count);
    for (const MeshVertexNumber v : unique.first.numbers()) unique.first[v] = {v.value};
}

// Computes the mean and max edge length of a level over all faces.
void measureEdges(PyramidLevel& level, std::span<const std::uint32_t> indices) {
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

// Appends a level's indices to Pyramid::indices. Returns the level with its index ranges and clusters.
PyramidLevel appendLevel(Pyramid& pyramid, const TriangleSet<MeshVertexNumber>& triangles,
                         std::vector<Cluster> clusters, const SurvivalOrder& order) {
    PyramidLevel level;
    level.clusters = std::move(clusters);
    level.vertexCount = order.vertexCounts[pyramid.levels.size()];
    level.triangleCount = static_cast<std::uint32_t>(triangles.count());
    auto first = static_cast<std::uint32_t>(pyramid.indices.size());
    for (Cluster& cluster : level.clusters) cluster.indices.first += first;
    for (const std::uint32_t count : triangles.primitiveIndexCounts) {
        level.primitives.push_back({first, count});
        first += count;
    }
    for (const MeshVertexNumber v : triangles.indices) pyramid.indices.push_back(order.numbers[v].value);
    return level;
}

// Returns a rank k such that the k-th largest of `count` random samples is very likely at least the true 99th
// percentile. The margin is two standard deviations of the number of samples beyond the percentile.
std::size_t percentileRank(std::size_t count) {
    const auto number = static_cast<double>(count);
    const double deviation = std::sqrt(errorPercentile * (1 - errorPercentile) * number);
    return count - static_cast<std::size_t>(std::min(errorPercentile * number + 2 * deviation, number - 1));
}

// Returns the distance between the surfaces of the mesh and of a level: the larger of the distances in both directions,
// at most the bounding box's diagonal. Without this limit, the distance to a level without area would be infinite.
double levelError(const Surface& mesh, const Surface& level, double diagonal) {
    const std::size_t points = std::clamp(mesh.triangles.size(), minErrorPoints, maxErrorPoints);
    const std::size_t rank = percentileRank(points);
    const double oneWay = largeDistance(mesh, level, points, rank, 0);
    return std::min(largeDistance(level, mesh, points, rank, oneWay), diagonal);
}

// Raises errors and mean edge lengths so that both grow strictly with the level. Every target then selects a unique
// level.
void separateSizes(std::vector<PyramidLevel>& levels, double diagonal) {
    for (std::size_t l = 1; l < levels.size(); ++l) {
        levels[l].error = std::max({levels[l].error, minErrorGrowth * levels[l - 1].error, errorFloor * diagonal});
        levels[l].meanEdge =
            std::max({levels[l].meanEdge, minEdgeGrowth * levels[l - 1].meanEdge, minEdgeToError * levels[l].error});
    }
}

// Data of a level while the final vertex order is unknown.
struct FittedLevel {
    TriangleSet<LevelVertexNumber> own;                     // the level's triangles; empty after clustering
    TriangleSet<MeshVertexNumber> triangles;                // the same triangles in cluster order; empty before
    Numbered<LevelVertexNumber, MeshVertexNumber> numbers;  // number of each vertex in the mesh
    LevelFit fit;
    std::vector<Cluster> clusters;
    std::vector<Ball> removed;  // bounding spheres of the removed components
    double error = 0;
};

FittedLevel fitted(const FitSource& source, SimplifiedLevel level) {
    FittedLevel result;
    result.fit = fitLevel(source, level.mesh, std::move(level.anchors));
    conserve(source, level.mesh, result.fit);
    result.removed = std::move(level.removed);
    result.own = std::move(level.mesh.triangles);
    result.numbers = std::move(level.numbers);
    return result;
}

// Returns the level with the original attributes of its vertices. A twin (copy of a vertex) has the attributes of the
// copied vertex.
FittedLevel surviving(const Vertices& vertices, SimplifiedLevel level) {
    FittedLevel result;
    const auto own = [&]<typename T>(const std::vector<T>& values, Numbered<LevelVertexNumber, T>& kept) {
        if (values.empty()) return;
        kept.reserve(level.mesh.sources.size());
        for (const MeshVertexNumber v : level.mesh.sources) kept.push_back(values[v.value]);
    };
    own(vertices.positions, result.fit.positions);
    own(vertices.normals, result.fit.normals);
    own(vertices.colors, result.fit.colors);
    own(vertices.uv0, result.fit.uv0);
    own(vertices.uv1, result.fit.uv1);
    result.removed = std::move(level.removed);
    result.own = std::move(level.mesh.triangles);
    result.numbers = std::move(level.numbers);
    return result;
}

// Returns the diagonal of the triangles' bounding box; vertices with NaN or infinite coordinates are ignored.
double diagonalOf(const Vertices& vertices, const TriangleSet<MeshVertexNumber>& triangles) {
    Bounds bounds;
    for (const MeshVertexNumber v : triangles.indices)
        if (isFinite(vertices.positions[v.value])) bounds.extend(glm::dvec3(vertices.positions[v.value]));
    return bounds.empty() ? 0 : glm::length(bounds.size());
}

// Returns an upper bound on the distance from the removed components to the level, never below the size of any removed
// component.
double removedError(const std::vector<Ball>& removed, const Surface& level) {
    double error = 0;
    for (const Ball& ball : removed)
        error = std::max(error, ball.radius + std::max(ball.radius, distanceTo(level, ball.centre)));
    return error;
}

// Measures the distance between the level and the mesh.
void measure(FittedLevel& level, const Surface& mesh, double diagonal) {
    const Surface surface = prepareSurface(level.fit.positions, level.own);
    level.error =
        std::max(levelError(mesh, surface, diagonal), std::min(removedError(level.removed, surface), diagonal));
    level.removed = {};
}

// Reorders the level's triangles into clusters. `positions` covers the mesh's vertices and the copies in
// Simplification::twins.
void cluster(FittedLevel& level, const WeldedPositions& positions) {
    Numbered<LevelVertexNumber, PositionNumber> places;
    places.reserve(level.numbers.size());
    for (const MeshVertexNumber v : level.numbers) places.push_back(positions.id[v]);
    level.clusters = clusterTriangles(level.own, level.fit.positions, places, positions.first.size());
    level.triangles.primitiveIndexCounts = std::move(level.own.primitiveIndexCounts);
    level.triangles.indices.reserve(level.own.indices.size());
    for (const LevelVertexNumber v : level.own.indices) level.triangles.indices.push_back(level.numbers[v]);
    level.own = {};
}

// Returns an attribute of the first `count` vertices in the order of `sources`: the fitted value if the level has one,
// else the original value.
template <typename T>
std::vector<T> inOrder(const std::vector<T>& own, const Numbered<LevelVertexNumber, T>& fitted,
                       const Numbered<PyramidVertexNumber, LevelVertexNumber>& fittedAt,
                       const Numbered<PyramidVertexNumber, MeshVertexNumber>& sources, std::size_t count) {
    std::vector<T> result;
    if (own.empty()) return result;
    result.reserve(count);
    for (const auto v : numbersBelow<PyramidVertexNumber>(count))
        result.push_back(fittedAt[v].isValid() ? fitted[fittedAt[v]] : own[sources[v].value]);
    return result;
}

// Returns one finish (simplified material) per primitive; empty without PyramidOptions::finishes.
std::vector<Finish> finishesOf(const Mesh& mesh, const PyramidOptions& options) {
    std::vector<Finish> finishes;
    if (options.finishes == nullptr) return finishes;
    for (const Primitive& primitive : mesh.primitives) finishes.push_back(options.finishes->of(primitive.material));
    return finishes;
}

// Returns the fraction of the vertices that each level after level 0 keeps; empty if each level halves the triangles.
std::vector<double> vertexShares(LevelVertices vertices) {
    return vertices == LevelVertices::quarters ? std::vector{0.75, 0.5} : std::vector<double>();
}

// Approximate fraction of the work that is complete after collapsing, fitting, measuring and clustering.
constexpr double shareOfCollapses = 0.6, shareUntilFitted = 0.7, shareUntilMeasured = 0.8, shareUntilClustered = 0.85;

// Returns the reason why no collapse is attempted and only level 0 is built; nullopt if coarser levels are to be made.
std::optional<PyramidEnd> endWithoutCollapses(const Mesh& mesh, const PyramidOptions& options) {
    if (options.maxLevels <= 1) return PyramidEnd::maxLevels;
    if (options.vertices == LevelVertices::quarters) return {};  // vertex counts are fixed: no triangle limit applies
    if (mesh.triangleCount() <= options.minTriangles) return PyramidEnd::minTriangles;
    if (mesh.triangleCount() < minTrianglesPerPrimitive * mesh.primitives.size()) return PyramidEnd::smallSaving;
    return {};
}

// Builds the pyramid without the measurements on finished levels (blurred errors and deformation bounds).
Pyramid assembled(const Mesh& mesh, const PyramidOptions& options, std::size_t helpers,
                  const std::function<void(double)>& reach) {
    // Merge equal vertices, then find vertices at equal positions.
    WeldedVertices unique = weldVertices(mesh);
    std::vector<FittedLevel> levels(1);
    levels[0].triangles = allTriangles(mesh, unique.id);
    const bool hasNormals = !mesh.vertices.normals.empty();
    if (isScattered(levels[0].triangles, unique.first.size())) {
        sortSpatially(unique, mesh.vertices.positions);
        levels[0].triangles = allTriangles(mesh, unique.id);
        sortSpatially(levels[0].triangles);
    } else if (hasNormals && areFew(mesh.vertices.count() - unique.first.size(), mesh.vertices.count())) {
        leaveApart(unique, levels[0].triangles, mesh.vertices.count());
    }
    unique.id = {};
    // The mesh's vertices without duplicates. Empty if the mesh's own vertices are used, because they have normals and
    // few or no duplicates.
    Vertices joined;
    const bool asTheyAre = hasNormals && isIdentity(unique.first, mesh.vertices.count());
    if (!asTheyAre) joined = gathered(mesh.vertices, plain(unique.first));
    if (!asTheyAre && joined.normals.empty())
        joined.normals = smoothNormals(joined.positions, plain(levels[0].triangles.indices));
    const Vertices& vertices = asTheyAre ? mesh.vertices : joined;
    WeldedPositions positions = weldPositions(vertices.positions);

    // Simplify the mesh. In the meantime, other threads fit the attributes of finished levels to the mesh.
    Pyramid pyramid;
    Simplification simplification;
    double diagonal = 0;
    const bool fits = options.vertices == LevelVertices::fitted;
    if (const std::optional<PyramidEnd> end = endWithoutCollapses(mesh, options)) {
        simplification.end = *end;
    } else {
        const VertexGroups smoothing = smoothingGroups(vertices.normals, positions);
        // Data for fitting the attributes of all levels to the mesh. They are created only when level 1 is complete,
        // because memory use peaks while the complete mesh is being collapsed.
        std::optional<FitSource> source;
        std::once_flag prepared;
        const auto prepare = [&] { source.emplace(prepareFit(vertices, positions, smoothing, levels[0].triangles)); };
        std::vector<FittedLevel> coarser(
            std::min<std::size_t>(maxPossibleLevels, static_cast<std::size_t>(options.maxLevels) - 1));
        Tasks tasks(helpers);
        simplification =
            simplify(vertices, positions, smoothing, levels[0].triangles,
                     {options.minTriangles, options.maxLevels - 1, fits, vertexShares(options.vertices),
                      [&](double lost) { reach(shareOfCollapses * lost); }},
                     tasks, [&](std::uint32_t l, SimplifiedLevel level) {
                         if (fits) std::call_once(prepared, prepare);
                         coarser[l] = fits ? fitted(*source, std::move(level)) : surviving(vertices, std::move(level));
                     });
        tasks.wait();
        if (simplification.levelCount > 0) diagonal = diagonalOf(vertices, levels[0].triangles);
        coarser.resize(simplification.levelCount);
        std::move(coarser.begin(), coarser.end(), std::back_inserter(levels));
    }
    reach(shareUntilFitted);
    if (mesh.triangleCount() >= fewestToGiveBack) giveBackFreedMemory();
    pyramid.repairedFaces = simplification.repairedFaces;
    pyramid.end = simplification.end;

    // Number the twins (copies of vertices) after the mesh's own vertices, and treat them like these from here on.
    // Level 0 uses no twins.
    const std::size_t ownCount = vertices.count();
    for (const MeshVertexNumber v : simplification.twins) positions.id.push_back(positions.id[v]);

    // Measure the levels, then cluster their triangles; each step frees its memory before the next step starts.
    if (levels.size() > 1) {
        const Surface surface = prepareSurface(vertices.positions, levels[0].triangles);
        Tasks tasks(helpers);
        for (std::size_t l = 1; l < levels.size(); ++l) tasks.add([&, l] { measure(levels[l], surface, diagonal); });
        tasks.wait();
    }
    reach(shareUntilMeasured);
    {
        Tasks tasks(helpers);
        tasks.add([&] {
            levels[0].clusters =
                clusterTriangles(levels[0].triangles, vertices.positions, positions.id, positions.first.size());
        });
        for (std::size_t l = 1; l < levels.size(); ++l) tasks.add([&, l] { cluster(levels[l], positions); });
        tasks.wait();
    }

    reach(shareUntilClustered);

    // Sort vertices by the coarsest level that uses them.
    std::vector<TriangleSet<MeshVertexNumber>> triangles;
    triangles.reserve(levels.size());
    for (FittedLevel& level : levels) triangles.push_back(std::move(level.triangles));
    const SurvivalOrder order = sortBySurvival(triangles, positions);
    Numbered<PyramidVertexNumber, MeshVertexNumber> sources;
    sources.reserve(order.vertices.size());
    for (const MeshVertexNumber v : order.vertices)
        sources.push_back(indexOf(v) < ownCount ? v : simplification.twins[indexOf(v) - ownCount]);
    pyramid.vertices = gathered(vertices, plain(sources));
    pyramid.source.reserve(sources.size());
    for (const MeshVertexNumber v : sources) pyramid.source.push_back(unique.first[v].value);
    pyramid.bounds = boundsOf(pyramid.vertices.positions);

    // Build each level. `fittedAt` maps mesh vertices to vertices of the level.
    Numbered<MeshVertexNumber, LevelVertexNumber> fittedAt(ownCount + simplification.twins.size());
    Numbered<PyramidVertexNumber, LevelVertexNumber> inPrefix;
    std::size_t indexCount = 0;
    for (const TriangleSet<MeshVertexNumber>& level : triangles) indexCount += level.indices.size();
    pyramid.indices.reserve(indexCount);
    for (std::size_t l = 0; l < levels.size(); ++l) {
        FittedLevel& done = levels[l];
        PyramidLevel level = appendLevel(pyramid, triangles[l], std::move(done.clusters), order);
        level.error = done.error;
        for (const LevelVertexNumber v : done.numbers.numbers()) fittedAt[done.numbers[v]] = v;
        inPrefix.clear();
        for (const auto v : numbersBelow<PyramidVertexNumber>(level.vertexCount))
            inPrefix.push_back(fittedAt[order.vertices[v]]);
        for (const MeshVertexNumber v : done.numbers) fittedAt[v] = {};
        level.positions = inOrder(vertices.positions, done.fit.positions, inPrefix, sources, level.vertexCount);
        level.normals = inOrder(vertices.normals, done.fit.normals, inPrefix, sources, level.vertexCount);
        level.colors = inOrder(vertices.colors, done.fit.colors, inPrefix, sources, level.vertexCount);
        level.uv0 = inOrder(vertices.uv0, done.fit.uv0, inPrefix, sources, level.vertexCount);
        level.uv1 = inOrder(vertices.uv1, done.fit.uv1, inPrefix, sources, level.vertexCount);
        measureEdges(level, std::span(pyramid.indices).last(triangles[l].indices.size()));
        pyramid.levels.push_back(std::move(level));
        done = {};
    }
    separateSizes(pyramid.levels, glm::length(pyramid.bounds.size()));
    return pyramid;
}

Pyramid build(const Mesh& mesh, const PyramidOptions& options, std::size_t helpers,
              const std::function<void(double)>& step) {
    requireRoomToBuild(mesh, options);
    Pyramid pyramid = assembled(mesh, options, helpers, [&](double share) {
        if (step) step(share);
    });
    if (mesh.triangleCount() >= fewestToGiveBack) giveBackFreedMemory();
    measureBlurredErrors(pyramid, finishesOf(mesh, options), helpers);
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
            // A vertex without joint weights follows the first joint.
            const bool moved = glm::any(glm::greaterThan(vertices.weights[v], glm::vec4(0)));
            if (!moved) extendJoint(0, position);
        }
    pyramid.morphBounds.clear();
    for (const MorphTarget& target : mesh.morphTargets) {
        Bounds& bounds = pyramid.morphBounds.emplace_back(boundsOf(target.positions));
        bounds.extend(glm::dvec3(0));
    }
}

const char* levelVerticesName(LevelVertices vertices) {
    return enumName<LevelVertices::quarters>(vertices, {"fitted", "surviving", "quarters"});
}

Pyramid buildPyramid(const Mesh& mesh, const PyramidOptions& options, std::size_t helpers,
                     const std::function<void(double)>& step) {
    return build(mesh, options, helpers, step);
}

std::uint64_t trianglesOf(std::span<const Mesh> meshes) {
    std::uint64_t all = 0;
    for (const Mesh& each : meshes) all += each.triangleCount();
    return all;
}

Pyramid fullDetail(const Mesh& mesh) {
    PyramidOptions options;
    options.maxLevels = 1;
    return build(mesh, options, 0, {});
}

}  // namespace defocus::engine
