// Compares the upper bound on a pyramid's memory with the memory that the construction of the pyramid takes.

#include "lod/pyramid/build_memory.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "core/error.h"
#include "core/memory.h"
#include "core/memory_limits.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/cache.h"
#include "lod/shapes.h"
#include "models.h"
#include "scene/gltf/gltf.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

// Returns the highest resident memory of this process since the latest reset, in bytes (proc(5), clear_refs).
std::uint64_t peakMemory() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("VmHWM:")) return 1024 * std::stoull(line.substr(line.find(':') + 1));
    return 0;
}

bool resetPeakMemory() {
    std::ofstream file("/proc/self/clear_refs");
    file << "5" << std::flush;
    return file.good();
}

void expectWithinBound(const std::string& name, const Mesh& mesh, const PyramidOptions& options) {
    giveBackFreedMemory();
    const std::uint64_t before = residentMemory();
    if (!resetPeakMemory()) GTEST_SKIP() << "the peak of the resident memory cannot be reset";
    const Pyramid pyramid = buildPyramid(mesh, options, 1);
    const std::uint64_t taken = peakMemory() - std::min(before, peakMemory());
    EXPECT_LE(taken, bytesToBuild(mesh, options)) << name << ", levels: " << options.maxLevels;
}

PyramidOptions fullDetailOnly() {
    return {.maxLevels = 1};
}

TEST(BuildMemory, boundHolds) {
    for (const PyramidOptions& options : {PyramidOptions(), fullDetailOnly()}) {
        expectWithinBound("sphere", sphere(240, 120), options);
        for (const char* name : {"Fox.glb", "hammer.glb"}) {
            DEFOCUS_MODEL_OR_SKIP(path, name);
            expectWithinBound(name, loadGltf(path).meshes.at(0), options);
        }
    }
}

// The bound on a pyramid's memory is at most a few times the memory of the mesh and its levels, so that no mesh is
// rejected under a plausible memory limit.
TEST(BuildMemory, boundIsProportionalToTheMesh) {
    const Mesh small = sphere(100, 50), large = sphere(200, 100);
    const PyramidOptions full = fullDetailOnly();
    EXPECT_NEAR(double(bytesToBuild(large, full)) / double(bytesToBuild(small, full)), 4, 0.1);
    EXPECT_LT(bytesToBuild(large, {}), 500 * large.triangleCount() + (16u << 20));
}

TEST(BuildMemory, aSmallMeshIsNotBlamedForALimitBelowTheProgramItself) {
    PyramidOptions options = fullDetailOnly();
    options.memoryLimit = 1;
    EXPECT_EQ(buildPyramid(sphere(8, 4), options).levels.size(), 1u);
}

TEST(BuildMemory, tooLowALimitIsRefusedWithTheMinimum) {
    Mesh mesh = sphere(240, 120);
    mesh.name = "Globe";
    PyramidOptions options;
    options.memoryLimit = residentMemory() + bytesToBuild(mesh, options) / 2;
    try {
        static_cast<void>(buildPyramid(mesh, options));
        FAIL() << "accepted";
    } catch (const Error& error) {
        const std::string text = error.what();
        for (const char* part : {"mesh 'Globe'", "57,120 triangles", "allow at least ", "--lod off"})
            EXPECT_NE(text.find(part), std::string::npos) << text;
        const std::size_t begin = text.find("allow at least ") + 15;
        options.memoryLimit = parseBytes(text.substr(begin, text.find(" with --memory") - begin)) + (4u << 20);
        EXPECT_NO_THROW(static_cast<void>(buildPyramid(mesh, options)));
    }
}

// If the memory limit has room for one pyramid but not for two, pyramids are built one after another. They equal
// pyramids that are built on all cores at once.
TEST(BuildMemory, limitBuildsOneAfterAnother) {
    const std::vector<Mesh> meshes = {sphere(60, 30), sphere(120, 60), sphere(90, 45)};
    PyramidOptions limited;
    limited.memoryLimit = residentMemory() + bytesToBuild(meshes[1], limited) + (8u << 20);
    std::atomic<int> running = 0;
    std::vector<std::size_t> order;
    const auto obtain = [&](std::size_t mesh, const std::function<Pyramid()>& build) {
        EXPECT_EQ(++running, 1);
        order.push_back(mesh);
        Pyramid pyramid = build();
        --running;
        return pyramid;
    };
    const std::vector<Pyramid> serial = obtainPyramids(meshes, limited, {}, obtain);
    EXPECT_EQ(order, (std::vector<std::size_t>{1, 2, 0}));
    const std::vector<Pyramid> parallel = buildPyramids(meshes);
    for (std::size_t i = 0; i < meshes.size(); ++i) EXPECT_EQ(serial[i].indices, parallel[i].indices);
}

// A pyramid in the cache needs no memory for its construction.
TEST(BuildMemory, cachedPyramidsAreNotRefused) {
    const ScratchFolder folder;
    const std::vector<Mesh> meshes = {sphere(60, 30)};
    static_cast<void>(cachedPyramids(meshes, folder.path()));
    const PyramidOptions limited{.memoryLimit = 1};
    EXPECT_EQ(cachedPyramids(meshes, folder.path(), limited).loaded, 1u);
    EXPECT_THROW(static_cast<void>(cachedPyramids(meshes, {}, limited)), Error);
}

}  // namespace
}  // namespace defocus::engine
