#include "lod/pyramid/file.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/hash.h"
#include "lod/pyramid/finish.h"
#include "scene/vertex_block.h"

namespace defocus::engine {

// Structured bindings in this file name all members of a struct, including unused ones. If a member is added to the
// struct, the bindings no longer compile, as a reminder to include the member in the cache key or in the file. The
// assertions check that the stored structs have no padding.

static_assert(std::has_unique_object_representations_v<IndexRange>);
static_assert(sizeof(PyramidFileHeader) == 208 && sizeof(PyramidFileLevel) == 120 && sizeof(Cluster) == 48,
              "the stored structs must have no padding, because they are written byte by byte");

namespace {

constexpr std::size_t checkedFrom = offsetof(PyramidFileHeader, checksum) + sizeof(PyramidFileHeader::checksum);

// ---- hash the mesh for the cache key -----------------------------------------------------------

template <typename T>
void hashStream(std::uint64_t& hash, const std::vector<T>& stream) {
    hash = hashBytes(std::as_bytes(std::span(stream)), hash);
}

void hashVertices(std::uint64_t& hash, const Vertices& vertices) {
    const auto& [positions, normals, tangents, uv0, uv1, colors, joints, weights, blurs, joints1, weights1] = vertices;
    hashStream(hash, positions);
    hashStream(hash, normals);
    hashStream(hash, tangents);
    hashStream(hash, uv0);
    hashStream(hash, uv1);
    hashStream(hash, colors);
    hashStream(hash, joints);
    hashStream(hash, weights);
    hashStream(hash, blurs);
    hashStream(hash, joints1);
    hashStream(hash, weights1);
}

void hashMorphTarget(std::uint64_t& hash, const MorphTarget& target) {
    const auto& [positions, normals, tangents] = target;
    hashStream(hash, positions);
    hashStream(hash, normals);
    hashStream(hash, tangents);
}

// ---- write a cache file ------------------------------------------------------------------------

template <typename T>
void append(std::vector<std::byte>& bytes, const std::vector<T>& values) {
    const std::span<const std::byte> more = std::as_bytes(std::span(values));
    bytes.insert(bytes.end(), more.begin(), more.end());
}

PyramidFileHeader headerOf(const Pyramid& pyramid, const Mesh& mesh, const PyramidKey& key) {
    const auto& [vertices, source, indices, levels, bounds, jointBounds, morphBounds, smallestPatch, contrast,
                 repairedFaces, end] = pyramid;
    const auto& [minTriangles, maxLevels, levelVertices, finishes, memoryLimit] = key.options;
    PyramidFileHeader header;
    header.mesh = key.mesh;
    header.minTriangles = minTriangles;
    header.maxLevels = maxLevels;
    header.indexCount = indices.size();
    header.levelCount = static_cast<std::uint32_t>(levels.size());
    header.primitiveCount = static_cast<std::uint32_t>(mesh.primitives.size());
    header.vertexCount = static_cast<std::uint32_t>(vertices.count());
    header.triangleCount = levels.front().triangleCount;
    header.repairedFaces = repairedFaces;
    header.end = static_cast<std::uint32_t>(end);
    header.vertices = static_cast<std::uint32_t>(levelVertices);
    header.smallestPatch = smallestPatch;
    header.contrast = contrast;
    for (int axis = 0; axis < 3; ++axis) {
        header.minimum[axis] = bounds.minimum[axis];
        header.maximum[axis] = bounds.maximum[axis];
    }
    return header;
}

std::size_t encodedSize(const Pyramid& pyramid, const Mesh& mesh) {
    std::size_t size = sizeof(PyramidFileHeader) +
                       pyramid.vertices.count() * (sizeof(std::uint32_t) + sizeof(glm::vec3)) +
                       pyramid.indices.size() * sizeof(std::uint32_t);
    for (const PyramidLevel& level : pyramid.levels)
        size += sizeof(PyramidFileLevel) + level.clusters.size() * sizeof(Cluster) +
                mesh.primitives.size() * sizeof(IndexRange) +
                level.vertexCount * (2 * sizeof(glm::vec3) + sizeof(glm::vec4) + 2 * sizeof(glm::vec2));
    return size;
}

// ---- read a cache file -------------------------------------------------------------------------

// Reads consecutive arrays from the bytes of a file. Before memory for an array is allocated, checks that the file has
// enough bytes left.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <typename T>
    [[nodiscard]] bool read(std::vector<T>& values, std::size_t count) {
        if (count > rest_.size() / sizeof(T)) return false;
        values.resize(count);
        if (count > 0) std::memcpy(values.data(), rest_.data(), count * sizeof(T));
        rest_ = rest_.subspan(count * sizeof(T));
        return true;
    }
    [[nodiscard]] bool finished() const { return rest_.empty(); }

private:
    std::span<const std::byte> rest_;
};

bool allBelow(std::span<const std::uint32_t> values, std::size_t limit) {
    std::uint32_t largest = 0;
    for (const std::uint32_t value : values) largest = std::max(largest, value);
    return values.empty() || largest < limit;
}

bool matches(const PyramidFileHeader& header, const Mesh& mesh, const PyramidKey& key) {
    return header.version == PyramidFileHeader::expectedVersion && header.mesh == key.mesh &&
           header.minTriangles == key.options.minTriangles && header.maxLevels == key.options.maxLevels &&
           header.vertices == static_cast<std::uint32_t>(key.options.vertices) &&
           header.primitiveCount == mesh.primitives.size() && header.triangleCount == mesh.triangleCount() &&
           header.levelCount >= 1 && header.end <= static_cast<std::uint32_t>(lastPyramidEnd);
}

bool areBlurTables(const BlurTables& tables) {
    return std::ranges::all_of(tables, [](const BlurTable& table) {
        return std::ranges::all_of(table, [](float value) { return value >= 0; });
    });
}

// Returns whether the clusters' index ranges cover the index range of each primitive without gaps.
bool clustersFit(const PyramidLevel& level) {
    auto cluster = level.clusters.begin();
    for (const IndexRange& primitive : level.primitives) {
        std::uint32_t next = primitive.first;
        const std::uint32_t end = primitive.first + primitive.count;
        for (; next < end; ++cluster) {
            if (cluster == level.clusters.end()) return false;
            const auto [first, count] = cluster->indices;
            if (first != next || count == 0 || count % 3 != 0 || count > end - next) return false;
            next += count;
        }
    }
    return cluster == level.clusters.end();
}

// Reads the level records and index ranges of a file. Checks that the ranges cover all indices without gaps, level by
// level.
bool readLevels(Reader& reader, const PyramidFileHeader& header, std::vector<PyramidLevel>& levels,
                std::vector<IndexRange>& ranges) {
    std::vector<PyramidFileLevel> records;
    if (!reader.read(records, header.levelCount)) return false;
    if (!reader.read(ranges, std::size_t{header.levelCount} * header.primitiveCount)) return false;
    if (records.front().triangleCount != header.triangleCount) return false;

    std::uint64_t next = 0;
    auto range = ranges.begin();
    std::uint32_t maxVertices = header.vertexCount;
    for (const PyramidFileLevel& record : records) {
        PyramidLevel& level = levels.emplace_back();
        level.primitives.assign(range, range + header.primitiveCount);
        range += header.primitiveCount;
        std::uint64_t count = 0;
        for (const IndexRange& primitive : level.primitives) {
            if (primitive.first != next || primitive.count % 3 != 0) return false;
            next += primitive.count;
            count += primitive.count;
        }
        if (count != 3 * std::uint64_t{record.triangleCount} || record.vertexCount > maxVertices) return false;
        if (!(record.meanEdge >= 0) || !(record.longestEdge >= 0) || !(record.error >= 0)) return false;
        maxVertices = record.vertexCount;
        level.vertexCount = record.vertexCount;
        level.triangleCount = record.triangleCount;
        level.meanEdge = record.meanEdge;
        level.longestEdge = record.longestEdge;
        level.error = record.error;
        level.blurredError = record.blurredError;
        if (!areBlurTables(level.blurredError)) return false;
    }
    if (next != header.indexCount) return false;
    for (std::size_t l = 0; l < levels.size(); ++l)
        if (!reader.read(levels[l].clusters, records[l].clusterCount) || !clustersFit(levels[l])) return false;
    return true;
}

// Returns whether level 0 has as many triangles of each primitive as the mesh.
bool keepsEveryTriangle(const PyramidLevel& level, const Mesh& mesh) {
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
        if (level.primitives[p].count != mesh.primitives[p].indices.size() / 3 * 3) return false;
    return true;
}

bool indicesInRange(const Pyramid& pyramid) {
    for (const PyramidLevel& level : pyramid.levels)
        if (!level.primitives.empty() &&
            !allBelow(std::span(pyramid.indices)
                          .subspan(level.primitives.front().first, 3 * std::size_t{level.triangleCount}),
                      level.vertexCount))
            return false;
    return true;
}

template <typename T>
std::vector<T> prefix(const std::vector<T>& values, std::size_t count) {
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(std::min(count, values.size()))};
}

bool readStreams(Reader& reader, Pyramid& pyramid) {
    PyramidLevel& own = pyramid.levels.front();
    own.positions = prefix(pyramid.vertices.positions, own.vertexCount);
    own.normals = prefix(pyramid.vertices.normals, own.vertexCount);
    own.colors = prefix(pyramid.vertices.colors, own.vertexCount);
    own.uv0 = prefix(pyramid.vertices.uv0, own.vertexCount);
    own.uv1 = prefix(pyramid.vertices.uv1, own.vertexCount);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        PyramidLevel& level = pyramid.levels[l];
        const auto readLike = [&](auto& values, const auto& mesh) {
            return reader.read(values, mesh.empty() ? 0 : level.vertexCount);
        };
        if (!reader.read(level.positions, level.vertexCount) || !reader.read(level.normals, level.vertexCount) ||
            !readLike(level.colors, pyramid.vertices.colors) || !readLike(level.uv0, pyramid.vertices.uv0) ||
            !readLike(level.uv1, pyramid.vertices.uv1))
            return false;
    }
    return true;
}

}  // namespace

std::uint64_t meshHash(const Mesh& mesh) {
    const std::uint64_t parts[2] = {mesh.primitives.size(), mesh.morphTargets.size()};
    std::uint64_t hash = hashBytes(std::as_bytes(std::span(parts)));
    hashVertices(hash, mesh.vertices);
    for (const Primitive& primitive : mesh.primitives) hashStream(hash, primitive.indices);
    for (const MorphTarget& target : mesh.morphTargets) hashMorphTarget(hash, target);
    return hash;
}

PyramidKey pyramidKey(const Mesh& mesh, const PyramidOptions& options) {
    // Hash of the source files in src/lod, set by the build system. A changed algorithm thus invalidates all cache
    // files.
    constexpr std::uint64_t sources[1] = {DEFOCUS_PYRAMID_SOURCES};
    const std::uint64_t own = meshHash(mesh) ^ (options.finishes == nullptr ? 0 : options.finishes->hash(mesh));
    return {hashBytes(std::as_bytes(std::span(sources)), own), options};
}

std::vector<std::byte> encodePyramid(const Pyramid& pyramid, const Mesh& mesh, const PyramidKey& key) {
    std::vector<std::byte> bytes(sizeof(PyramidFileHeader));
    bytes.reserve(encodedSize(pyramid, mesh));

    // Write the table of levels, then the arrays.
    std::vector<PyramidFileLevel> records;
    std::vector<IndexRange> ranges;
    std::vector<Cluster> allClusters;
    for (const auto& [primitives, vertexCount, triangleCount, clusters, positions, normals, colors, uv0, uv1, meanEdge,
                      longestEdge, error, blurredError] : pyramid.levels) {
        records.push_back({vertexCount, triangleCount, static_cast<std::uint32_t>(clusters.size()), 0, meanEdge,
                           longestEdge, error, blurredError});
        allClusters.insert(allClusters.end(), clusters.begin(), clusters.end());
        ranges.insert(ranges.end(), primitives.begin(), primitives.end());
    }
    append(bytes, records);
    append(bytes, ranges);
    append(bytes, allClusters);
    append(bytes, pyramid.source);
    append(bytes, pyramid.indices);
    if (mesh.vertices.normals.empty()) append(bytes, pyramid.vertices.normals);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        append(bytes, pyramid.levels[l].positions);
        append(bytes, pyramid.levels[l].normals);
        append(bytes, pyramid.levels[l].colors);
        append(bytes, pyramid.levels[l].uv0);
        append(bytes, pyramid.levels[l].uv1);
    }

    // Write the header, which contains the checksum of all bytes after the checksum.
    PyramidFileHeader header = headerOf(pyramid, mesh, key);
    std::memcpy(bytes.data(), &header, sizeof header);
    header.checksum = hashBytes(std::span(bytes).subspan(checkedFrom));
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

std::optional<PyramidFileHeader> pyramidHeader(std::span<const std::byte> bytes) {
    PyramidFileHeader header;
    if (bytes.size() < sizeof header) return {};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.magic != PyramidFileHeader::expectedMagic) return {};
    return header;
}

std::optional<Pyramid> decodePyramid(std::span<const std::byte> bytes, const Mesh& mesh, const PyramidKey& key) {
    const std::optional<PyramidFileHeader> header = pyramidHeader(bytes);
    if (!header || !matches(*header, mesh, key)) return {};
    if (hashBytes(bytes.subspan(checkedFrom)) != header->checksum) return {};

    Reader reader(bytes.subspan(sizeof *header));
    Pyramid pyramid;
    std::vector<IndexRange> ranges;
    if (!readLevels(reader, *header, pyramid.levels, ranges)) return {};
    if (!keepsEveryTriangle(pyramid.levels.front(), mesh)) return {};
    if (!reader.read(pyramid.source, header->vertexCount) || !allBelow(pyramid.source, mesh.vertices.count()))
        return {};
    if (!reader.read(pyramid.indices, header->indexCount) || !indicesInRange(pyramid)) return {};

    // Gather vertices from the mesh, then read the attributes stored for each level.
    pyramid.vertices = gathered(mesh.vertices, pyramid.source);
    if (mesh.vertices.normals.empty() && !reader.read(pyramid.vertices.normals, header->vertexCount)) return {};
    if (!readStreams(reader, pyramid) || !reader.finished()) return {};

    for (int axis = 0; axis < 3; ++axis) {
        pyramid.bounds.minimum[axis] = header->minimum[axis];
        pyramid.bounds.maximum[axis] = header->maximum[axis];
    }
    if (!(header->smallestPatch >= 0) || !areBlurTables(header->contrast)) return {};
    pyramid.smallestPatch = header->smallestPatch;
    pyramid.contrast = header->contrast;
    pyramid.repairedFaces = header->repairedFaces;
    pyramid.end = static_cast<PyramidEnd>(header->end);
    measureDeformations(pyramid, mesh);
    return pyramid;
}

}  // namespace defocus::engine
