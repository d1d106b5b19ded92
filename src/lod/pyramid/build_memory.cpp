#include "lod/pyramid/build_memory.h"

#include <algorithm>
#include <thread>

#include "core/error.h"
#include "core/memory.h"
#include "core/memory_limits.h"
#include "core/number_text.h"
#include "core/parallel.h"

namespace defocus::engine {

namespace {

// Memory to build a pyramid is at most the sum of these amounts: a constant for the images from which errors after
// blurring are measured (blurred_error.h), bytes per triangle with or without coarser levels, and bytes per vertex.
// Fitting and comparing the levels take most of the bytes per triangle.
constexpr std::uint64_t imageBytes = 16u << 20;
constexpr std::uint64_t levelTriangleBytes = 300, fullTriangleBytes = 70;
constexpr std::uint64_t vertexBytes = 60;

// Pyramids that take at most this many bytes are built without a check of the memory limit. If the limit is too small
// even for these pyramids, the check of the frame's memory budget fails later and reports a sufficient limit.
constexpr std::uint64_t smallBytes = 1u << 20;

std::uint64_t attributeBytes(const Vertices& vertices) {
    const auto bytesOf = [](const auto&... arrays) { return (... + (arrays.empty() ? 0 : sizeof(arrays.front()))); };
    return bytesOf(vertices.positions, vertices.normals, vertices.tangents, vertices.uv0, vertices.uv1, vertices.colors,
                   vertices.joints, vertices.weights, vertices.blurs, vertices.joints1, vertices.weights1);
}

// Returns an upper bound on the bytes needed to build a pyramid that has only level 0.
std::uint64_t fullDetailBytes(const Mesh& mesh) {
    return mesh.triangleCount() * fullTriangleBytes +
           mesh.vertices.count() * (vertexBytes + 2 * attributeBytes(mesh.vertices));
}

// Returns an upper bound on the bytes of a finished pyramid.
std::uint64_t keptBytes(const Mesh& mesh) {
    return 2 * fullDetailBytes(mesh);
}

}  // namespace

std::uint64_t bytesToBuild(const Mesh& mesh, const PyramidOptions& options) {
    const std::uint64_t full = fullDetailBytes(mesh);
    if (options.maxLevels <= 1 || mesh.triangleCount() <= options.minTriangles) return full;
    return imageBytes + full + mesh.triangleCount() * (levelTriangleBytes - fullTriangleBytes);
}

void requireRoomToBuild(const Mesh& mesh, const PyramidOptions& options) {
    if (options.memoryLimit == 0) return;
    const std::uint64_t needed = bytesToBuild(mesh, options);
    if (needed <= smallBytes || residentMemory() + needed <= options.memoryLimit) return;
    giveBackFreedMemory();
    const std::uint64_t held = residentMemory();
    if (held + needed <= options.memoryLimit) return;
    fail(
        "{} of memory is too little for mesh '{}': its {} triangles need up to {}, and the program already uses {}; "
        "allow at least {} with --memory{}",
        bytesText(options.memoryLimit), mesh.name, grouped(mesh.triangleCount()), bytesText(needed), bytesText(held),
        bytesText(held + needed), options.maxLevels > 1 ? ", or use --lod off, which needs less" : "");
}

bool fitsInParallel(const std::vector<Mesh>& meshes, const std::vector<std::size_t>& order,
                    const PyramidOptions& options) {
    if (options.memoryLimit == 0) return true;
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    std::uint64_t bytes = residentMemory();
    for (std::size_t i = 0; i < order.size(); ++i)
        bytes += i < cores ? bytesToBuild(meshes[order[i]], options) : keptBytes(meshes[order[i]]);
    return bytes <= options.memoryLimit;
}

}  // namespace defocus::engine
