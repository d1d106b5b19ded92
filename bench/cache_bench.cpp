// Measures the time that the disk cache of pyramids saves on the built-in school of fish. Compares the times to build,
// store and load the pyramids.
//
// Held constant: meshes, options, process and number of threads (all cores). The cache is a new temporary folder, and
// its files are in the page cache when they are loaded. Loading includes hashing the meshes, as in the program. Loading
// is repeated, and the fastest time counts. The loaded pyramids are compared with the built ones.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/parallel.h"
#include "lod/pyramid/cache.h"
#include "lod/pyramid/file.h"
#include "school/fish_school.h"

namespace {

using namespace defocus;
using namespace defocus::engine;
namespace fs = std::filesystem;

constexpr int loads = 10;

template <typename Body>
double milliseconds(const Body& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool equal(const std::vector<Mesh>& meshes, const std::vector<Pyramid>& a, const std::vector<Pyramid>& b) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const PyramidKey key = pyramidKey(meshes[i], {});
        if (encodePyramid(a[i], meshes[i], key) != encodePyramid(b[i], meshes[i], key)) return false;
    }
    return true;
}

int run(const fs::path& folder) {
    const std::vector<Mesh> meshes = fishSchool({}).meshes;
    std::size_t triangles = 0;
    for (const Mesh& mesh : meshes) triangles += mesh.triangleCount();

    // Measure the times to build and to store the pyramids.
    std::vector<Pyramid> built;
    const double building = milliseconds([&] { built = buildPyramids(meshes); });
    const double storing = milliseconds(
        [&] { parallelFor(meshes.size(), [&](std::size_t i) { storePyramid(built[i], meshes[i], folder); }); });
    double megabytes = 0;
    for (const CacheFile& file : cacheFiles(folder)) megabytes += static_cast<double>(file.bytes) * 1e-6;

    // Measure the times to hash the meshes and to load the pyramids.
    double loading = std::numeric_limits<double>::infinity();
    double hashing = std::numeric_limits<double>::infinity();
    CachedPyramids cached;
    for (int i = 0; i < loads; ++i) {
        hashing = std::min(hashing, milliseconds([&] {
                               parallelFor(meshes.size(), [&](std::size_t m) { (void)pyramidKey(meshes[m], {}); });
                           }));
        cached = {};
        loading = std::min(loading, milliseconds([&] { cached = cachedPyramids(meshes, folder); }));
    }
    fmt::print("{:>10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "triangles", "file MB", "build ms", "store ms", "hash ms",
               "load ms");
    fmt::print("{:>10} {:>9.1f} {:>9.0f} {:>9.0f} {:>9.1f} {:>9.1f}\n", triangles, megabytes, building, storing,
               hashing, loading);
    if (cached.loaded == meshes.size() && equal(meshes, built, cached.pyramids)) return 0;
    fmt::print(stderr, "what was built didn't come back\n");
    return 1;
}

}  // namespace

int main() {
    const fs::path folder = fs::temp_directory_path() / fmt::format("defocus-cache-bench-{}", ::getpid());
    const int code = run(folder);
    fs::remove_all(folder);
    return code;
}
