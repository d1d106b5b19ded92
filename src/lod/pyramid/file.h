#pragma once
// A pyramid as the bytes of a cache file, and back. The file holds what the mesh can't give: which of the mesh's
// vertices the pyramid has in which order, the indices, and each level's own positions, normals, colours and texture
// coordinates.
//
//   header | level records | index ranges, levels × primitives | clusters, level after level | source | indices
//          | normals, where the mesh has none | of each level from 1 on: positions, normals, colours, uv0, uv1
//
// Bytes are as this machine has them in memory; a file of another byte order has another magic.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// A hash of every vertex stream, every primitive's indices and the morph targets.
std::uint64_t meshHash(const Mesh& mesh);

// What a pyramid depends on.
struct PyramidKey {
    std::uint64_t mesh = 0;  // meshHash, and the hashes of its finishes and of the sources of src/lod
    PyramidOptions options;
};

PyramidKey pyramidKey(const Mesh& mesh, const PyramidOptions& options);

struct PyramidFileHeader {
    static constexpr std::uint64_t expectedMagic = 0x3150445053554644ull;  // "DFUSPDP1"
    // It changes with the format alone. What buildPyramid makes of a mesh is in the key: see pyramidKey.
    static constexpr std::uint32_t expectedVersion = 6;

    std::uint64_t magic = expectedMagic;
    std::uint64_t checksum = 0;  // hashBytes of all that follows this field
    std::uint32_t version = expectedVersion;
    std::uint32_t levelCount = 0;
    std::uint64_t mesh = 0;  // the key
    std::uint32_t minTriangles = 0;
    std::int32_t maxLevels = 0;
    std::uint64_t indexCount = 0;
    std::uint32_t primitiveCount = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;  // of level 0
    std::uint32_t repairedFaces = 0;
    std::uint32_t end = 0;       // PyramidEnd
    std::uint32_t vertices = 0;  // LevelVertices
    double minimum[3] = {};      // bounds
    double maximum[3] = {};
    double smallestPatch = 0;
    BlurTable contrast{};
};

struct PyramidFileLevel {
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t clusterCount = 0;
    std::uint32_t unused = 0;
    double meanEdge = 0;
    double longestEdge = 0;
    double error = 0;
    BlurTable blurredError{};
};

// `pyramid` is what buildPyramid made of `mesh`.
std::vector<std::byte> encodePyramid(const Pyramid& pyramid, const Mesh& mesh, const PyramidKey& key);

// Returns what was encoded, bit for bit; nothing where `bytes` aren't a whole and sound file for this mesh and key.
// Whatever the bytes are: no index of the result is out of range, and no more memory is asked for than some 40 times
// theirs.
std::optional<Pyramid> decodePyramid(std::span<const std::byte> bytes, const Mesh& mesh, const PyramidKey& key);

// Reads the header alone, of any key and version; nothing where `bytes` are too short or of another kind.
std::optional<PyramidFileHeader> pyramidHeader(std::span<const std::byte> bytes);

}  // namespace defocus::engine
