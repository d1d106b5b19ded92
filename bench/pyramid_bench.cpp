// Compares pyramids with levels from meshoptimizer and OpenMesh: build time, and similarity of the levels to the mesh.
//
// Time (CPU time). Held constant: the mesh, one thread, levels with half the triangles each, down to 64. "pyramid" is
// the complete buildPyramid: repair, collapses, errors, clusters, fitted positions, normals and colours. "levels" is
// only the repair, the collapses by quadrics of positions and attributes, and each level's list of triangles.
// "meshoptimizer" is meshopt_simplify, applied from level to level. "DecimaterT" is OpenMesh's decimater with its
// quadric module on a mesh with welded positions. meshoptimizer and DecimaterT produce no attributes. "times as fast"
// is the time of DecimaterT divided by the time of "levels" or "pyramid". "bytes each" is the peak memory of
// buildPyramid per triangle of the mesh, including the result. --million adds a fish with a million triangles, smooth
// and flat-shaded.
//
// Distance. Held constant: the mesh, welded by position, and the triangle count of each level. meshoptimizer simplifies
// level 0 directly to that count. The distance is the larger of the mean distances to and from level 0. The table lists
// the ratio of two distances, the pyramid's to meshoptimizer's, so values below 1 favour the pyramid. "mean" is the
// geometric mean of this ratio over all levels.
//
// Appearance. Held constant: the largest mesh of each scene, the triangle count of each level (meshoptimizer gets the
// counts of the pyramid), camera, lens, 32 lens samples, 512 x 384 px. Each level is drawn at the blur at which the
// default thresholds select it, and compared with level 0 under the same blur. meshoptimizer's levels keep the
// attributes of the surviving vertices; its meshopt_simplify ignores attributes (version 0.18).
//
// Normals. Compares the pyramid's levels with three kinds of normals: fitted normals, area-weighted means over the
// level's faces at each position, and normals copied from the surviving vertices.

#include <fmt/format.h>
#include <malloc.h>
#include <meshoptimizer.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "image/boxes.h"
#include "image/metrics.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/conserved.h"
#include "lod/pyramid/finish.h"
#include "lod/pyramid/level_selection.h"
#include "lod/pyramid/surface_distance.h"
#include "lod/simplify/simplify.h"
#include "lod/simplify/weld.h"
#include "render/accumulation/accumulation.h"
#include "render/methods.h"
#include "run_bench.h"
#include "scene/defaults.h"
#include "scene/gltf/gltf.h"
#include "school/fish_school.h"

namespace {

using namespace defocus;
using namespace defocus::engine;
using DecimatedMesh = OpenMesh::TriMesh_ArrayKernelT<>;

constexpr std::size_t minTriangles = 64;
constexpr std::uint32_t lensSamples = 32;
constexpr std::size_t distancePoints = 40'000;  // number of sample points on each surface

// Returns the min CPU time of this thread over all runs, in s. Unlike wall-clock time, CPU time excludes other load on
// the machine.
double secondsOf(int runs, const std::function<void()>& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    double min = std::numeric_limits<double>::infinity();
    for (int run = 0; run < runs; ++run) {
        const double start = now();
        work();
        min = std::min(min, now() - start);
    }
    return min;
}

// Returns the value in bytes of a line of /proc/self/status, such as "VmRSS"; 0 if the line is missing.
double memory(const std::string& line) {
    std::ifstream status("/proc/self/status");
    for (std::string text; std::getline(status, text);)
        if (text.starts_with(line)) return 1024 * std::atof(text.c_str() + line.size() + 1);
    return 0;
}

// Returns by how many bytes the peak memory of the process during `work` exceeds its memory before `work`.
double peakBytesOf(const std::function<void()>& work) {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // 5 resets the peak resident memory
    const double before = memory("VmRSS");
    work();
    return memory("VmHWM") - before;
}

// A mesh whose vertices at equal positions are merged (welded), as meshoptimizer and OpenMesh require.
struct JoinedSurface {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

JoinedSurface joinedSurface(const Mesh& mesh) {
    JoinedSurface surface;
    const WeldedPositions welded = weldPositions(mesh.vertices.positions);
    for (const MeshVertexNumber v : welded.first) surface.positions.push_back(mesh.vertices.positions[v.value]);
    for (const Primitive& primitive : mesh.primitives)
        for (const std::uint32_t v : primitive.indices) surface.indices.push_back(welded.id[{v}].value);
    return surface;
}

// Simplifies `indices` to `target` triangles. Returns more triangles if meshoptimizer can't reach the target.
std::vector<std::uint32_t> simplified(const std::vector<glm::vec3>& positions,
                                      const std::vector<std::uint32_t>& indices, std::size_t target) {
    std::vector<std::uint32_t> result(indices.size());
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                   sizeof(glm::vec3), 3 * target, 1e9f));
    return result;
}

// Simplifies a mesh with meshoptimizer, each level from the previous one. Returns the number of triangles in the last
// level.
std::size_t meshoptimizerChain(const JoinedSurface& surface) {
    std::vector<std::uint32_t> indices = surface.indices;
    while (indices.size() / 3 > minTriangles) {
        std::vector<std::uint32_t> next =
            simplified(surface.positions, indices, std::max(minTriangles, indices.size() / 6));
        if (next.size() > indices.size() * 3 / 4) break;
        indices = std::move(next);
    }
    return indices.size() / 3;
}

std::size_t decimaterChain(const JoinedSurface& surface) {
    DecimatedMesh mesh;
    for (const glm::vec3& p : surface.positions) mesh.add_vertex({p.x, p.y, p.z});
    const auto handle = [&](std::size_t i) { return OpenMesh::VertexHandle(static_cast<int>(surface.indices[i])); };
    for (std::size_t i = 0; i + 2 < surface.indices.size(); i += 3)
        mesh.add_face(handle(i), handle(i + 1), handle(i + 2));
    OpenMesh::Decimater::DecimaterT<DecimatedMesh> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<DecimatedMesh>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    for (std::size_t target = mesh.n_faces() / 2; target > minTriangles; target /= 2) {
        if (decimater.decimate_to_faces(0, target) == 0) break;
        mesh.garbage_collection();
    }
    return mesh.n_faces();
}

// Builds the levels of a pyramid, but neither fits attributes nor measures errors. Returns the number of triangles in
// the last level.
std::size_t levelsAlone(const Mesh& mesh) {
    TriangleSet<MeshVertexNumber> triangles;
    for (const Primitive& primitive : mesh.primitives) {
        triangles.primitiveIndexCounts.push_back(static_cast<std::uint32_t>(primitive.indices.size()));
        for (const std::uint32_t v : primitive.indices) triangles.indices.push_back({v});
    }
    const WeldedPositions positions = weldPositions(mesh.vertices.positions);
    const VertexGroups smoothing = smoothingGroups(mesh.vertices.normals, positions);
    std::size_t left = triangles.count();
    Tasks tasks(0);
    simplify(mesh.vertices, positions, smoothing, triangles, {.minTriangles = minTriangles, .anchors = false}, tasks,
             [&](std::uint32_t, const SimplifiedLevel& level) { left = level.mesh.triangles.count(); });
    tasks.wait();
    return left;
}

void timeRow(const std::string& name, const Mesh& mesh) {
    const JoinedSurface surface = joinedSurface(mesh);
    Pyramid pyramid;
    std::size_t meshoptimizerLeft = 0;
    const int runs = mesh.triangleCount() > 500'000 ? 1 : 3;
    const double peak = peakBytesOf([&] { pyramid = buildPyramid(mesh); });
    const double own = secondsOf(runs, [&] { pyramid = buildPyramid(mesh); });
    std::size_t levelsLeft = 0;
    const double levels = secondsOf(runs, [&] { levelsLeft = levelsAlone(mesh); });
    const double meshoptimizer = secondsOf(runs, [&] { meshoptimizerLeft = meshoptimizerChain(surface); });
    const auto triangles = static_cast<double>(mesh.triangleCount());
    fmt::print("{:<20} {:>9} {:>6.0f} {:>8.3f} {:>6} {:>8.3f} {:>6} {:>8.3f} {:>6}", name, mesh.triangleCount(),
               peak / triangles, own, pyramid.levels.back().triangleCount, levels, levelsLeft, meshoptimizer,
               meshoptimizerLeft);
    if (pyramid.repairedFaces > 0) {
        fmt::print("  (DecimaterT cannot hold this mesh)\n");
        return;
    }
    std::size_t decimaterLeft = 0;
    const double decimater = secondsOf(runs, [&] { decimaterLeft = decimaterChain(surface); });
    fmt::print(" {:>8.3f} {:>6} {:>8.1f} {:>8.1f}\n", decimater, decimaterLeft, decimater / levels, decimater / own);
    std::fflush(stdout);
}

// Statistics of a ratio: the distance of a pyramid's level from level 0, divided by the distance of meshoptimizer's
// level from level 0. All levels have equal weight; the mean is geometric.
struct DistanceRatios {
    double sum = 0;
    int levels = 0;
    int within = 0;  // number of levels with a ratio of at most 1.1
    double worst = 0;

    void add(double ratio) {
        sum += std::log(ratio);
        ++levels;
        within += ratio <= 1.1 ? 1 : 0;
        worst = std::max(worst, ratio);
    }
    [[nodiscard]] double mean() const { return levels > 0 ? std::exp(sum / levels) : 0; }
};

std::vector<std::uint32_t> levelIndices(const Pyramid& pyramid, const PyramidLevel& level) {
    std::vector<std::uint32_t> indices;
    for (const IndexRange& range : level.primitives)
        indices.insert(indices.end(), pyramid.indices.begin() + range.first,
                       pyramid.indices.begin() + range.first + range.count);
    return indices;
}

void printRatios(const std::string& name, std::size_t triangles, const DistanceRatios& ratios, int stopped) {
    fmt::print("{:<44} {:>9} {:>6} {:>6.2f} {:>6.2f} {:>6}{}\n", name, triangles, ratios.levels, ratios.mean(),
               ratios.worst, ratios.within,
               stopped > 0 ? fmt::format("  (meshoptimizer stops before {} of ours)", stopped) : "");
    std::fflush(stdout);
}

void distanceRow(const std::string& name, const Mesh& mesh, DistanceRatios& all) {
    const Pyramid pyramid = buildPyramid(mesh);
    if (pyramid.levels.size() < 2) return;
    const JoinedSurface joined = joinedSurface(mesh);
    const Surface reference = prepareSurface(joined.positions, joined.indices);
    DistanceRatios own;
    int stopped = 0;
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const PyramidLevel& level = pyramid.levels[l];
        const std::vector<std::uint32_t> indices = levelIndices(pyramid, level);
        const std::vector<std::uint32_t> peer = simplified(joined.positions, joined.indices, level.triangleCount);
        if (peer.size() > indices.size() * 5 / 4) {
            ++stopped;
            continue;
        }
        const auto meanDistance = [&](std::span<const glm::vec3> positions, std::span<const std::uint32_t> triangles) {
            return surfaceDistance(prepareSurface(positions, triangles), reference, distancePoints).both.mean;
        };
        // Clamp distances to at least the precision of float positions. On flat meshes, both distances are rounding
        // errors.
        const double exact = 1e-7 * glm::length(mesh.bounds().size());
        const double ratio = std::max(exact, meanDistance(level.positions, indices)) /
                             std::max(exact, meanDistance(joined.positions, peer));
        own.add(ratio);
        all.add(ratio);
    }
    printRatios(name, mesh.triangleCount(), own, stopped);
}

// A scene with a single static mesh, in front of a camera that frames the mesh.
struct Stage {
    World world;
    View view;
    double depth = 0;  // depth of the mesh's centre, m
};

void furnish(Stage& stage, const Scene& source, const Mesh& mesh) {
    Scene scene;
    scene.meshes = {mesh};
    scene.materials = source.materials;
    scene.textures = source.textures;
    scene.images = source.images;
    Node node;
    node.mesh = 0;
    scene.nodes = {node};
    scene.roots = {0};
    stage.world.pose = poseAt(scene, 0);
    stage.view.width = 512;
    stage.view.height = 384;
    const PlacedCamera placed = chooseCamera(scene, stage.world.pose, {}, 4.0 / 3.0);
    stage.world.lights = lightsOrDefault(scene, stage.world.pose, placed);
    stage.world.environment = environmentOrDefault(scene);
    stage.view.worldFromCamera = placed.worldFromCamera;
    stage.view.nearPlane = placed.camera.znear;
    stage.depth = glm::distance(glm::dvec3(placed.worldFromCamera[3]), mesh.bounds().centre());
    stage.view.lens.focusDistance = 1e6;
    stage.world.scene = std::make_shared<const Scene>(std::move(scene));
}

double pixelsPerUnit(const Stage& stage) {
    return stage.view.width / (2 * tanHalfHorizontalFov(stage.view.lens) * stage.depth);
}

// Returns the CoC (px) at which the default thresholds select a level.
double cocOf(const Stage& stage, const PyramidLevel& level) {
    return level.meanEdge * pixelsPerUnit(stage) / defaultThresholds(LodMetric::size, 64).blur;
}

// Doubles the camera's distance until level 1 is selected at a CoC of at most 1/16 of the image's width.
void stepBack(Stage& stage) {
    while (cocOf(stage, stage.world.pyramids[0].levels[1]) > stage.view.width / 16.0) {
        stage.view.worldFromCamera[3] += stage.depth * stage.view.worldFromCamera[2];
        stage.depth *= 2;
    }
}

// Sets the f-number for which the mesh's centre has a CoC of `coc` px if the lens is focused at infinity.
void blurBy(Stage& stage, double coc) {
    Lens& lens = stage.view.lens;
    const double aperture = coc * stage.depth * 2 * tanHalfHorizontalFov(lens) / stage.view.width;
    lens.fStop = lens.focalLength / (1000 * aperture);
}

Image drawn(const Stage& stage, std::uint32_t level) {
    // the committed results were made with the Halton sequence
    const RenderSettings settings{.sampleCount = lensSamples, .sequence = Sequence::halton, .lod = LodMode::off};
    FramePlan plan = planFrame(stage.world, stage.view, settings);
    for (ObjectPlan& object : plan.objects) {
        object.fine.level = level;
        object.fine.triangleCount = stage.world.pyramids[0].levels[level].triangleCount;
        plan.levelsUsed[0][level] = true;
    }
    const auto renderer = makeAccumulationRenderer(stage.world, {});
    return imageOf(*renderer, plan);
}

// Returns the mesh simplified by meshoptimizer, primitive by primitive, to the triangle counts of `level`.
Mesh peerLevel(const Mesh& mesh, const PyramidLevel& level) {
    Mesh peer = mesh;
    for (std::size_t p = 0; p < peer.primitives.size(); ++p)
        if (!peer.primitives[p].indices.empty())
            peer.primitives[p].indices =
                simplified(mesh.vertices.positions, mesh.primitives[p].indices, level.primitives[p].count / 3);
    return peer;
}

// Calls visit(level, CoC) for each level that is selected at a CoC from 1 to 60 px (a ninth of the image's width).
// Before each call, sets the f-number of `stage` so that the mesh has this CoC.
void forEachLevelInUse(Stage& stage, const std::function<void(std::uint32_t, double)>& visit) {
    const std::size_t count = stage.world.pyramids[0].levels.size();
    if (count < 2) return;
    stepBack(stage);
    for (std::uint32_t l = 1; l < count; ++l) {
        const double coc = cocOf(stage, stage.world.pyramids[0].levels[l]);
        if (coc < 1 || coc > 60) continue;
        blurBy(stage, coc);
        visit(l, coc);
    }
}

void looksRows(const std::string& name, const Scene& source, const Mesh& mesh) {
    Stage stage;
    furnish(stage, source, mesh);
    stage.world.pyramids = buildPyramids(stage.world.scene->meshes);
    forEachLevelInUse(stage, [&](std::uint32_t l, double coc) {
        const PyramidLevel& level = stage.world.pyramids[0].levels[l];
        const Image reference = drawn(stage, 0);
        const Difference own = compareImages(reference, drawn(stage, l));

        Stage peer;
        const Mesh peerMesh = peerLevel(mesh, level);
        if (peerMesh.triangleCount() > level.triangleCount * 5 / 4) {
            fmt::print("{:<24} {:>5} {:>9} {:>9} {:>7.1f} {:>9.2f} {:>9} {:>9.4f}  (meshoptimizer stops before)\n",
                       name, l, level.triangleCount, peerMesh.triangleCount(), coc, own.psnr, "", own.flip);
            return;
        }
        furnish(peer, source, peerMesh);
        peer.view = stage.view;
        peer.world.lights = stage.world.lights;
        peer.world.pyramids = {fullDetail(peerMesh)};
        const Difference theirs = compareImages(reference, drawn(peer, 0));
        fmt::print("{:<24} {:>5} {:>9} {:>9} {:>7.1f} {:>9.2f} {:>9.2f} {:>9.4f} {:>9.4f}\n", name, l,
                   level.triangleCount, peerMesh.triangleCount(), coc, own.psnr, theirs.psnr, own.flip, theirs.flip);
        std::fflush(stdout);
    });
}

// Returns one normal per vertex: the area-weighted mean over the level's faces at the vertex's position.
std::vector<glm::vec3> averagedNormals(const Pyramid& pyramid, const PyramidLevel& level) {
    const WeldedPositions places = weldPositions(level.positions);
    std::vector<std::uint32_t> indices = levelIndices(pyramid, level);
    for (std::uint32_t& v : indices) v = places.first[places.id[{v}]].value;
    const std::vector<glm::vec3> atPlaces = smoothNormals(level.positions, indices);
    std::vector<glm::vec3> normals;
    normals.reserve(level.positions.size());
    for (const PositionNumber place : places.id) normals.push_back(atPlaces[places.first[place].value]);
    return normals;
}

void normalsRows(const std::string& name, const Scene& source, const Mesh& mesh) {
    Stage stage;
    furnish(stage, source, mesh);
    stage.world.pyramids = buildPyramids(stage.world.scene->meshes);
    forEachLevelInUse(stage, [&](std::uint32_t l, double coc) {
        const Pyramid pyramid = stage.world.pyramids[0];
        const PyramidLevel& level = pyramid.levels[l];
        const Image reference = drawn(stage, 0);
        const auto differenceWith = [&](std::vector<glm::vec3> normals) {
            Pyramid changed = pyramid;
            changed.levels[l].normals = std::move(normals);
            stage.world.pyramids.replace(0, std::move(changed));
            const Difference difference = compareImages(reference, drawn(stage, l));
            stage.world.pyramids.replace(0, pyramid);
            return difference;
        };
        const std::vector<glm::vec3>& own = pyramid.vertices.normals;
        const Difference fitted = compareImages(reference, drawn(stage, l));
        const Difference averaged = differenceWith(averagedNormals(pyramid, level));
        const Difference surviving = differenceWith({own.begin(), own.begin() + level.vertexCount});
        fmt::print("{:<24} {:>5} {:>9} {:>7.1f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.4f} {:>9.4f} {:>9.4f}\n", name, l,
                   level.triangleCount, coc, fitted.psnr, averaged.psnr, surviving.psnr, fitted.flip, averaged.flip,
                   surviving.flip);
        std::fflush(stdout);
    });
}

const Mesh& largestMesh(const Scene& scene) {
    return *std::max_element(scene.meshes.begin(), scene.meshes.end(),
                             [](const Mesh& a, const Mesh& b) { return a.triangleCount() < b.triangleCount(); });
}

// Prints the differences between each level of a mesh and level 0: mean vertex colour, diffuse light from 26
// directions, and area covered as seen from these directions.
void conservedRows(const std::string& name, const Mesh& mesh) {
    constexpr std::size_t points = 60'000;
    constexpr int resolution = 1024;
    const Pyramid pyramid = buildPyramid(mesh);
    const auto measured = [&](std::size_t l) {
        return conservedBy(pyramid, l, vertexColours(pyramid, l), points, resolution);
    };
    const Conserved level0 = measured(0);
    const double diagonal = glm::length(pyramid.bounds.size());
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        const ConservedDifference difference = differenceOf(measured(l), level0);
        fmt::print("{:<24} {:>5} {:>9} {:>8.4f} {:>8.2f} {:>8.2f} {:>9.3f} {:>9.3f}\n", name, l,
                   pyramid.levels[l].triangleCount, pyramid.levels[l].meanEdge / diagonal, 1e3 * difference.colour,
                   1e3 * difference.light, 100 * difference.outline, 100 * difference.meanOutline);
        std::fflush(stdout);
    }
}

// Prints the errors of a complete scene relative to the converged image, averaged over boxes of 32 x 32 px. "CoC px" is
// the CoC at the scene's centre. "full detail" is the error at full detail with the same number of samples as "levels".
void blurredRows(const std::string& name, const Scene& scene) {
    constexpr int box = 32;
    World world;
    world.scene = std::make_shared<const Scene>(scene);
    world.pose = poseAt(scene, 0);
    View view;
    view.width = 384;
    view.height = 288;
    const PlacedCamera placed = chooseCamera(scene, world.pose, {}, 4.0 / 3.0);
    world.lights = lightsOrDefault(scene, world.pose, placed);
    world.environment = environmentOrDefault(scene);
    view.worldFromCamera = placed.worldFromCamera;
    view.nearPlane = placed.camera.znear;
    view.lens.focalLength = focalLengthFromFov(4.0 / 3.0 * std::tan(placed.camera.yfov / 2), 36);
    Bounds bounds;
    const Finishes finishes(scene);
    world.pyramids = buildPyramids(scene.meshes, {.finishes = &finishes});
    for (const Object& object : world.pose.objects) {
        const Bounds& own = world.pyramids[static_cast<std::size_t>(object.mesh)].bounds;
        if (!own.empty()) bounds.extend(glm::dvec3(object.worldFromObject * glm::dvec4(own.centre(), 1)));
    }
    const double depth = glm::distance(glm::dvec3(placed.worldFromCamera[3]), bounds.centre());
    view.lens.focusDistance = 1e6;
    for (const double coc : {8.0, 24.0}) {
        const double aperture = coc * depth * 2 * tanHalfHorizontalFov(view.lens) / view.width;
        view.lens.fStop = view.lens.focalLength / (1000 * aperture);
        const auto image = [&](std::uint32_t samples, LodMode mode) {
            const RenderSettings settings{.sampleCount = samples, .lod = mode};
            const auto renderer = makeAccumulationRenderer(world, {});
            return imageOf(*renderer, planFrame(world, view, settings));
        };
        const Image reference = image(1024, LodMode::off);
        for (const std::uint32_t samples : {64u}) {
            const Image full = image(samples, LodMode::off);
            const Image levels = image(samples, LodMode::continuous);
            const double fullError = boxDifference(reference, full, box);
            const double levelsError = boxDifference(reference, levels, box);
            fmt::print("{:<24} {:>7.1f} {:>7} {:>12.2e} {:>12.2e} {:>6.2f} {:>9.2f} {:>9.2f}\n", name, coc, samples,
                       fullError, levelsError, levelsError / fullError, compareImages(reference, full).psnr,
                       compareImages(reference, levels).psnr);
            std::fflush(stdout);
        }
    }
}

// Returns the mesh with separate vertices for each triangle and its face normal at each corner, as in flat-shaded
// models.
Mesh flatShaded(const Mesh& mesh) {
    Mesh flat;
    Primitive& all = flat.primitives.emplace_back();
    for (const Primitive& primitive : mesh.primitives)
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            glm::vec3 p[3];
            for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices.positions[primitive.indices[i + k]];
            const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
            const float length = glm::length(cross);
            for (const glm::vec3& corner : p) {
                all.indices.push_back(static_cast<std::uint32_t>(flat.vertices.count()));
                flat.vertices.positions.push_back(corner);
                flat.vertices.normals.push_back(length > 0 ? cross / length : glm::vec3(0, 0, 1));
            }
        }
    return flat;
}

int run(int argc, char** argv) {
    bool million = false;
    bool blurred = false;
    bool conserved = false;
    std::vector<std::filesystem::path> files;
    for (int i = 1; i < argc; ++i) {
        if (std::string(argv[i]) == "--million")
            million = true;
        else if (std::string(argv[i]) == "--blurred")
            blurred = true;
        else if (std::string(argv[i]) == "--conserved")
            conserved = true;
        else
            files.emplace_back(argv[i]);
    }
    std::vector<std::pair<std::string, Scene>> scenes;
    scenes.emplace_back("fish", fishSchool({.fishCount = 1}));
    for (const auto& file : files) scenes.emplace_back(file.stem().string(), loadGltf(file));

    if (blurred) {
        const auto context = createHeadlessContext();
        fmt::print("errors after boxes of 32 x 32\n{:<24} {:>7} {:>7} {:>12} {:>12} {:>6} {:>9} {:>9}\n", "scene",
                   "CoC px", "samples", "full detail", "levels", "ratio", "PSNR full", "levels");
        for (const auto& [name, scene] : scenes) blurredRows(name, scene);
        return 0;
    }
    if (conserved) {
        fmt::print("what levels keep of level 0\n{:<24} {:>5} {:>9} {:>8} {:>8} {:>8} {:>9} {:>9}\n", "mesh", "level",
                   "triangles", "edge", "colour", "light", "outline %", "mean %");
        for (const auto& [name, scene] : scenes) conservedRows(name, largestMesh(scene));
        return 0;
    }
    fmt::print("{:<20} {:>9} {:>6} {:>15} {:>15} {:>15} {:>15} {:>17}\n", "seconds, one thread", "", "bytes", "pyramid",
               "levels", "meshoptimizer", "DecimaterT", "times as fast");
    fmt::print("{:<20} {:>9} {:>6} {:>8} {:>6} {:>8} {:>6} {:>8} {:>6} {:>8} {:>6} {:>8} {:>8}\n", "mesh", "triangles",
               "each", "s", "left", "s", "left", "s", "left", "s", "left", "levels", "pyramid");
    for (const auto& [name, scene] : scenes) timeRow(name, largestMesh(scene));
    if (million) {
        const Mesh fish = fishSchool({.fishCount = 1, .trianglesPerFish = 1'000'000}).meshes.front();
        timeRow("fish", fish);
        timeRow("fish, flat-shaded", flatShaded(fish));
    }

    fmt::print(
        "\nmean distance over meshoptimizer's, of each mesh that has levels\n{:<44} {:>9} {:>6} {:>6} {:>6} {:>6}\n",
        "mesh", "triangles", "levels", "mean", "worst", "<= 1.1");
    DistanceRatios all;
    std::vector<std::vector<glm::vec3>> seen;  // positions of the meshes measured so far, to skip duplicate meshes
    for (const auto& [name, scene] : scenes)
        for (const Mesh& mesh : scene.meshes) {
            if (std::find(seen.begin(), seen.end(), mesh.vertices.positions) != seen.end()) continue;
            seen.push_back(mesh.vertices.positions);
            distanceRow(scene.meshes.size() > 1 ? name + '/' + mesh.name : name, mesh, all);
        }
    printRatios("all", 0, all, 0);

    const auto context = createHeadlessContext();
    fmt::print("\nagainst level 0 under the same blur\n{:<24} {:>5} {:>9} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9}\n",
               "mesh", "level", "triangles", "theirs", "CoC px", "PSNR dB", "theirs", "FLIP", "theirs");
    for (const auto& [name, scene] : scenes) looksRows(name, scene, largestMesh(scene));

    fmt::print("\nnormals of the same levels\n{:<24} {:>5} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "mesh",
               "level", "triangles", "CoC px", "PSNR dB", "averaged", "survivors", "FLIP", "averaged", "survivors");
    for (const auto& [name, scene] : scenes) normalsRows(name, scene, largestMesh(scene));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return defocus::engine::runBench("defocus_pyramid_bench", [&] { return run(argc, argv); });
}
