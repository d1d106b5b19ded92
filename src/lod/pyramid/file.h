#pragma once
// Encodes a pyramid (a mesh with its levels of detail) as a cache file, and decodes it. The file contains only data
// that cannot be derived from the mesh: the mesh vertex of each pyramid vertex, the indices, and the positions,
// normals, colours and texture coordinates of each level.
//
//   header | level records | index ranges, levels × primitives | clusters, level by level
//          | mesh vertex of each pyramid vertex | indices | normals, if the mesh has none
//          | for each level from 1: positions, normals, colours, uv0, uv1
//
// Values are stored in the machine's byte order. A file with the other byte order has a different magic number.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

// Returns a hash of all vertex attributes, the indices of every primitive, and the morph targets.
std::uint64_t meshHash(const Mesh& mesh);

// Key of a cache file: all inputs on which a pyramid depends.
struct PyramidKey {
    // Hash of the mesh (meshHash), of its simplified materials (finish.h), and of the source files in src/lod.
    std::uint64_t mesh = 0;
    PyramidOptions options;
};

PyramidKey pyramidKey(const Mesh& mesh, const PyramidOptions& options);

struct PyramidFileHeader {
    static constexpr std::uint64_t expectedMagic = 0x3150445053554644ull;  // "DFUSPDP1"
    // Version of the file format. Changes to buildPyramid need no new version, because the cache key (PyramidKey)
    // contains a hash of the C++ sources in src/lod.
    static constexpr std::uint32_t expectedVersion = 7;

    std::uint64_t magic = expectedMagic;
    std::uint64_t checksum = 0;  // hashBytes of all bytes after this field
    std::uint32_t version = expectedVersion;
    std::uint32_t levelCount = 0;
    std::uint64_t mesh = 0;  // value of PyramidKey::mesh
    std::uint32_t minTriangles = 0;
    std::int32_t maxLevels = 0;
    std::uint64_t indexCount = 0;
    std::uint32_t primitiveCount = 0;
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;  // triangle count of level 0
    std::uint32_t repairedFaces = 0;
    std::uint32_t end = 0;       // Pyramid::end, reason why no further level exists
    std::uint32_t vertices = 0;  // PyramidOptions::vertices as integer
    double minimum[3] = {};      // lower corner of Pyramid::bounds
    double maximum[3] = {};
    double smallestPatch = 0;
    BlurTables contrast{};
};

struct PyramidFileLevel {
    std::uint32_t vertexCount = 0;
    std::uint32_t triangleCount = 0;
    std::uint32_t clusterCount = 0;
    std::uint32_t unused = 0;
    double meanEdge = 0;
    double longestEdge = 0;
    double error = 0;
    BlurTables blurredError{};
};

// Encodes a pyramid as the bytes of a cache file. `pyramid` must be the result of buildPyramid for `mesh`.
std::vector<std::byte> encodePyramid(const Pyramid& pyramid, const Mesh& mesh, const PyramidKey& key);

// Decodes a pyramid from the bytes of a cache file; it is bit-identical to the encoded pyramid. Returns nullopt if
// `bytes` are not a complete, valid file for this mesh and key. Safe for arbitrary bytes: all indices are checked, and
// at most about 40 times the size of `bytes` is allocated.
std::optional<Pyramid> decodePyramid(std::span<const std::byte> bytes, const Mesh& mesh, const PyramidKey& key);

// Reads only the header of a cache file with any key and version. Returns nullopt if `bytes` are too short or have
// another format.
std::optional<PyramidFileHeader> pyramidHeader(std::span<const std::byte> bytes);

}  // namespace defocus::engine
