// Tests that a pyramid loaded from the cache equals a built pyramid bit for bit, even after damage to a file.

#include "lod/pyramid/cache.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>

#include "core/error.h"
#include "core/file.h"
#include "core/hash.h"
#include "likeness.h"
#include "lod/pyramid/build_all.h"
#include "lod/pyramid/file.h"
#include "lod/shapes.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

bool sameVertices(const Vertices& a, const Vertices& b) {
    return sameBits(a.positions, b.positions) && sameBits(a.normals, b.normals) && sameBits(a.tangents, b.tangents) &&
           sameBits(a.uv0, b.uv0) && sameBits(a.uv1, b.uv1) && sameBits(a.colors, b.colors) &&
           sameBits(a.joints, b.joints) && sameBits(a.weights, b.weights) && sameBits(a.joints1, b.joints1) &&
           sameBits(a.weights1, b.weights1);
}

void expectEqual(const Pyramid& a, const Pyramid& b) {
    EXPECT_TRUE(sameVertices(a.vertices, b.vertices));
    EXPECT_TRUE(sameBits(a.source, b.source));
    EXPECT_TRUE(sameBits(a.indices, b.indices));
    EXPECT_EQ(std::memcmp(&a.bounds, &b.bounds, sizeof a.bounds), 0);
    EXPECT_TRUE(sameBits(a.jointBounds, b.jointBounds));
    EXPECT_TRUE(sameBits(a.morphBounds, b.morphBounds));
    EXPECT_EQ(a.repairedFaces, b.repairedFaces);
    EXPECT_EQ(a.end, b.end);
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t l = 0; l < a.levels.size(); ++l) {
        SCOPED_TRACE(l);
        const PyramidLevel& x = a.levels[l];
        const PyramidLevel& y = b.levels[l];
        EXPECT_TRUE(sameBits(x.primitives, y.primitives));
        EXPECT_EQ(x.vertexCount, y.vertexCount);
        EXPECT_EQ(x.triangleCount, y.triangleCount);
        EXPECT_TRUE(sameBits(x.clusters, y.clusters));
        EXPECT_TRUE(sameBits(x.positions, y.positions));
        EXPECT_TRUE(sameBits(x.normals, y.normals));
        EXPECT_TRUE(sameBits(x.colors, y.colors));
        EXPECT_TRUE(sameBits(x.uv0, y.uv0));
        EXPECT_TRUE(sameBits(x.uv1, y.uv1));
        EXPECT_EQ(std::memcmp(&x.meanEdge, &y.meanEdge, sizeof x.meanEdge), 0);
        EXPECT_EQ(std::memcmp(&x.error, &y.error, sizeof x.error), 0);
    }
}

// Returns a torus with every vertex attribute, two primitives, a morph target, and colours that differ between vertices
// at the same position.
Mesh decoratedTorus(std::uint32_t columns = 24, std::uint32_t rows = 16) {
    Mesh mesh = decorated(torus(columns, rows));
    MorphTarget target;
    for (std::size_t v = 0; v < mesh.vertices.count(); ++v) {
        mesh.vertices.joints1.push_back({v % 5, 0, 0, 0});
        mesh.vertices.weights1.push_back({0, 0, 0, 0});
        target.positions.push_back(0.1f * mesh.vertices.positions[v]);
        target.normals.push_back({0, 0, 1});
        target.tangents.push_back({0, 1, 0});
    }
    mesh.morphTargets.push_back(target);
    mesh.primitives.push_back({0, {}});
    std::vector<std::uint32_t>& all = mesh.primitives[0].indices;
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 6 * 3);
    mesh.primitives[1].indices.assign(half, all.end());
    all.erase(half, all.end());
    return mesh;
}

struct Encoded {
    explicit Encoded(Mesh what) : mesh(std::move(what)) {}
    [[nodiscard]] std::optional<Pyramid> decode(std::span<const std::byte> from) const {
        return decodePyramid(from, mesh, key);
    }

    Mesh mesh;
    PyramidKey key = pyramidKey(mesh, {});
    Pyramid pyramid = buildPyramid(mesh);
    Bytes bytes = encodePyramid(pyramid, mesh, key);
};

// Writes the checksum of the file's bytes into the file.
void seal(Bytes& bytes) {
    const std::size_t checked = offsetof(PyramidFileHeader, checksum) + sizeof(std::uint64_t);
    const std::uint64_t checksum = hashBytes(std::span(bytes).subspan(checked));
    std::memcpy(bytes.data() + offsetof(PyramidFileHeader, checksum), &checksum, sizeof checksum);
}

// Returns the offset of the first byte of each section of the file format, and the size of the file.
std::vector<std::size_t> sectionBorders(const Encoded& file) {
    const Pyramid& pyramid = file.pyramid;
    std::vector<std::size_t> borders = {0};
    const auto add = [&](std::size_t bytes) { borders.push_back(borders.back() + bytes); };
    add(sizeof(PyramidFileHeader));
    add(pyramid.levels.size() * sizeof(PyramidFileLevel));
    add(pyramid.levels.size() * file.mesh.primitives.size() * sizeof(IndexRange));
    std::size_t clusters = 0;
    for (const PyramidLevel& level : pyramid.levels) clusters += level.clusters.size();
    add(clusters * sizeof(Cluster));
    add(pyramid.source.size() * 4);
    add(pyramid.indices.size() * 4);
    if (file.mesh.vertices.normals.empty()) add(pyramid.vertices.count() * 12);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        add(pyramid.levels[l].positions.size() * 12);
        add(pyramid.levels[l].normals.size() * 12);
        add(pyramid.levels[l].colors.size() * 16);
        add(pyramid.levels[l].uv0.size() * 8);
        add(pyramid.levels[l].uv1.size() * 8);
    }
    return borders;
}

// Expects the pyramid to be safe to draw: all indices are within the arrays of the pyramid and of the mesh.
void expectSound(const Pyramid& pyramid, const Mesh& mesh) {
    ASSERT_FALSE(pyramid.levels.empty());
    ASSERT_EQ(pyramid.source.size(), pyramid.vertices.count());
    for (const std::uint32_t v : pyramid.source) ASSERT_LT(v, mesh.vertices.count());
    std::uint32_t max = static_cast<std::uint32_t>(pyramid.vertices.count());
    for (const PyramidLevel& level : pyramid.levels) {
        ASSERT_LE(level.vertexCount, max);
        max = level.vertexCount;
        ASSERT_EQ(level.primitives.size(), mesh.primitives.size());
        ASSERT_EQ(level.positions.size(), level.vertexCount);
        ASSERT_EQ(level.normals.size(), level.vertexCount);
        ASSERT_EQ(level.colors.size(), mesh.vertices.colors.empty() ? 0 : level.vertexCount);
        ASSERT_EQ(level.uv0.size(), mesh.vertices.uv0.empty() ? 0 : level.vertexCount);
        ASSERT_EQ(level.uv1.size(), mesh.vertices.uv1.empty() ? 0 : level.vertexCount);
        std::size_t count = 0;
        for (const IndexRange& range : level.primitives) {
            ASSERT_LE(std::size_t{range.first} + range.count, pyramid.indices.size());
            for (std::size_t i = 0; i < range.count; ++i)
                ASSERT_LT(pyramid.indices[range.first + i], level.vertexCount);
            count += range.count;
        }
        ASSERT_EQ(count, 3 * std::size_t{level.triangleCount});
        for (const Cluster& cluster : level.clusters)
            ASSERT_LE(std::size_t{cluster.indices.first} + cluster.indices.count, pyramid.indices.size());
    }
}

TEST(PyramidFile, comesBackBitForBit) {
    std::map<std::string, Mesh> meshes = {{"decorated", decoratedTorus(40, 30)}, {"plain", sphere(32, 16, 0.2)}};
    meshes["smoothed"] = meshes["plain"];
    meshes["smoothed"].vertices.normals.clear();
    meshes["one level"] = flatGrid(2);
    meshes["empty"] = {};
    meshes["odd index"] = flatGrid(8);
    meshes["odd index"].primitives[0].indices.push_back(0);
    meshes["negative zero"] = flatGrid(16);
    for (glm::vec3& p : meshes["negative zero"].vertices.positions) p.z = -0.0f;
    for (const auto& [name, mesh] : meshes) {
        SCOPED_TRACE(name);
        const Encoded file(mesh);
        const auto decoded = file.decode(file.bytes);
        ASSERT_TRUE(decoded);
        expectEqual(*decoded, file.pyramid);
    }
}

TEST(PyramidFile, leavesOutWhatTheMeshHas) {
    const Encoded file(decoratedTorus());
    EXPECT_EQ(sectionBorders(file).back(), file.bytes.size());
}

TEST(PyramidKey, everyInputCounts) {
    const Mesh mesh = decoratedTorus();
    std::vector<std::function<void(Mesh&)>> changes = {
        [](Mesh& m) { m.vertices.positions[7].y += 1e-6f; },
        [](Mesh& m) { m.vertices.normals[7] *= -1.0f; },
        [](Mesh& m) { m.vertices.tangents[7].w *= -1.0f; },
        [](Mesh& m) { m.vertices.uv0[7].x += 0.1f; },
        [](Mesh& m) { m.vertices.uv1[7].x += 0.1f; },
        [](Mesh& m) { m.vertices.colors[7].r += 1e-4f; },
        [](Mesh& m) { m.vertices.joints[7].w ^= 1; },
        [](Mesh& m) { m.vertices.weights[7].w += 0.1f; },
        [](Mesh& m) { m.vertices.joints1[7].w ^= 1; },
        [](Mesh& m) { m.vertices.weights1[7].w += 0.1f; },
        [](Mesh& m) { m.morphTargets[0].positions[7].x += 0.1f; },
        [](Mesh& m) { m.morphTargets[0].normals[7].x += 0.1f; },
        [](Mesh& m) { m.morphTargets[0].tangents[7].x += 0.1f; },
        [](Mesh& m) { m.morphTargets.push_back({}); },
        [](Mesh& m) { m.vertices.uv1.clear(); },
        [](Mesh& m) { std::swap(m.vertices.uv0, m.vertices.uv1); },
        [](Mesh& m) { std::swap(m.primitives[0].indices, m.primitives[1].indices); },
        [](Mesh& m) { m.primitives.push_back({}); },
        [](Mesh& m) {  // moves a triangle to the second primitive
            auto& from = m.primitives[0].indices;
            auto& to = m.primitives[1].indices;
            to.insert(to.begin(), from.end() - 3, from.end());
            from.resize(from.size() - 3);
        },
    };
    const std::uint64_t own = pyramidKey(mesh, {}).mesh;
    EXPECT_EQ(pyramidKey(decoratedTorus(), {}).mesh, own);
    std::map<std::uint64_t, std::size_t> seen = {{own, changes.size()}};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Mesh changed = mesh;
        changes[i](changed);
        const auto [other, isNew] = seen.emplace(pyramidKey(changed, {}).mesh, i);
        EXPECT_TRUE(isNew) << "changes " << i << " and " << other->second;
    }
}

TEST(PyramidKey, nameAndMaterialsDontCount) {
    Mesh mesh = decoratedTorus();
    const std::uint64_t own = pyramidKey(mesh, {}).mesh;
    mesh.name = "other";
    mesh.primitives[0].material = 5;
    mesh.morphWeights = {0.5f};
    EXPECT_EQ(pyramidKey(mesh, {}).mesh, own);
}

TEST(PyramidFile, anotherKeyIsAMiss) {
    const Encoded file(decoratedTorus());
    const auto decodedWith = [&](PyramidKey key) { return decodePyramid(file.bytes, file.mesh, key).has_value(); };
    EXPECT_TRUE(decodedWith(file.key));
    EXPECT_FALSE(decodedWith({file.key.mesh + 1, {}}));
    EXPECT_FALSE(decodedWith({file.key.mesh, {.minTriangles = 65}}));
    EXPECT_FALSE(decodedWith({file.key.mesh, {.maxLevels = 23}}));
    // Simulates a hash collision: the file is decoded for another mesh with the same key.
    EXPECT_FALSE(decodePyramid(file.bytes, torus(24, 16), file.key));
    EXPECT_FALSE(decodePyramid(file.bytes, Mesh{}, file.key));
}

TEST(PyramidFile, aFlippedBitAnywhereInTheHeaderIsAMiss) {
    Encoded file(decoratedTorus());
    for (std::size_t bit = 0; bit < 8 * sizeof(PyramidFileHeader); ++bit) {
        file.bytes[bit / 8] ^= std::byte{1} << bit % 8;
        ASSERT_FALSE(file.decode(file.bytes)) << "bit " << bit;
        file.bytes[bit / 8] ^= std::byte{1} << bit % 8;
    }
    EXPECT_TRUE(file.decode(file.bytes));
}

TEST(PyramidFile, aChangedByteInAnySectionIsAMiss) {
    Encoded file(decoratedTorus());
    const std::vector<std::size_t> borders = sectionBorders(file);
    for (std::size_t s = 0; s + 1 < borders.size(); ++s)
        for (std::size_t sample = 0; sample <= 32; ++sample) {
            if (borders[s] == borders[s + 1]) continue;
            const std::size_t at = borders[s] + (borders[s + 1] - borders[s] - 1) * sample / 32;
            for (const std::byte change : {std::byte{0x01}, std::byte{0x80}, std::byte{0xff}}) {
                file.bytes[at] ^= change;
                ASSERT_FALSE(file.decode(file.bytes)) << "section " << s << ", byte " << at;
                file.bytes[at] ^= change;
            }
        }
}

TEST(PyramidFile, aShorterOrLongerFileIsAMiss) {
    const Encoded file(decoratedTorus());
    const std::vector<std::size_t> borders = sectionBorders(file);
    std::vector<std::size_t> lengths;
    for (std::size_t s = 0; s + 1 < borders.size(); ++s)
        for (const std::size_t length : {borders[s], borders[s] + 1, (borders[s] + borders[s + 1]) / 2,
                                         borders[s + 1] - std::min<std::size_t>(1, borders[s + 1])})
            if (length < file.bytes.size()) lengths.push_back(length);
    for (std::size_t length = 0; length <= sizeof(PyramidFileHeader); ++length) lengths.push_back(length);
    for (const std::size_t length : lengths) {
        Bytes part(file.bytes.begin(), file.bytes.begin() + static_cast<std::ptrdiff_t>(length));
        ASSERT_FALSE(file.decode(part)) << length;
        if (length < sizeof(PyramidFileHeader)) continue;
        seal(part);
        ASSERT_FALSE(file.decode(part)) << "sealed, " << length;
    }
    Bytes longer = file.bytes;
    longer.resize(longer.size() + 4);
    EXPECT_FALSE(file.decode(longer));
    seal(longer);
    EXPECT_FALSE(file.decode(longer));
}

// Decodes the file after storing a wrong value at `offset` and a matching checksum, as a faulty writer would.
template <typename T>
std::optional<Pyramid> decodeWith(const Encoded& file, std::size_t offset, T value) {
    Bytes bytes = file.bytes;
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    seal(bytes);
    return file.decode(bytes);
}

TEST(PyramidFile, wrongCountsUnderARightChecksumAreMisses) {
    const Encoded file(decoratedTorus());
    const auto at = [&](std::size_t offset) {
        std::uint32_t value = 0;
        std::memcpy(&value, file.bytes.data() + offset, sizeof value);
        return value;
    };
    using Header = PyramidFileHeader;
    const std::size_t records = sizeof(Header);
    const std::size_t ranges = sectionBorders(file)[2];
    std::vector<std::size_t> counts = {
        offsetof(Header, magic),         offsetof(Header, version),        offsetof(Header, levelCount),
        offsetof(Header, mesh),          offsetof(Header, minTriangles),   offsetof(Header, maxLevels),
        offsetof(Header, indexCount),    offsetof(Header, indexCount) + 4, offsetof(Header, primitiveCount),
        offsetof(Header, triangleCount), offsetof(Header, vertexCount)};
    for (std::size_t l = 0; l < file.pyramid.levels.size(); ++l) {
        counts.push_back(records + l * sizeof(PyramidFileLevel) + offsetof(PyramidFileLevel, vertexCount));
        counts.push_back(records + l * sizeof(PyramidFileLevel) + offsetof(PyramidFileLevel, triangleCount));
        counts.push_back(records + l * sizeof(PyramidFileLevel) + offsetof(PyramidFileLevel, clusterCount));
        for (std::size_t p = 0; p < file.mesh.primitives.size(); ++p) {
            const std::size_t range = ranges + (l * file.mesh.primitives.size() + p) * sizeof(IndexRange);
            counts.push_back(range + offsetof(IndexRange, first));
            counts.push_back(range + offsetof(IndexRange, count));
        }
    }
    const std::size_t clusters = sectionBorders(file)[3];
    for (std::size_t c = 0; c < file.pyramid.levels[0].clusters.size(); ++c) {
        counts.push_back(clusters + c * sizeof(Cluster) + offsetof(IndexRange, first));
        counts.push_back(clusters + c * sizeof(Cluster) + offsetof(IndexRange, count));
    }
    for (const std::size_t offset : counts)
        for (const std::uint32_t value : {0u, at(offset) + 1, at(offset) - 1, at(offset) + 3, at(offset) - 3,
                                          0x7fffffffu, 0x80000000u, 0xfffffffcu, 0xffffffffu})
            if (value != at(offset)) {
                ASSERT_FALSE(decodeWith(file, offset, value)) << "offset " << offset << " = " << value;
            }
}

// In the tested file, all ranges are valid, but a triangle would be drawn with the material of the wrong primitive.
TEST(PyramidFile, aTriangleThatChangedPrimitivesIsAMiss) {
    const Encoded file(decoratedTorus());
    const std::size_t ranges = sectionBorders(file)[2];
    Bytes bytes = file.bytes;
    IndexRange first = file.pyramid.levels[0].primitives[0];
    IndexRange second = file.pyramid.levels[0].primitives[1];
    first.count -= 3;
    second = {second.first - 3, second.count + 3};
    std::memcpy(bytes.data() + ranges, &first, sizeof first);
    std::memcpy(bytes.data() + ranges + sizeof first, &second, sizeof second);
    seal(bytes);
    EXPECT_FALSE(file.decode(bytes));
}

TEST(PyramidFile, indicesOutOfRangeUnderARightChecksumAreMisses) {
    const Encoded file(decoratedTorus());
    const std::vector<std::size_t> borders = sectionBorders(file);
    const std::size_t sources = borders[4];
    const std::size_t indices = borders[5];
    const auto vertexCount = static_cast<std::uint32_t>(file.mesh.vertices.count());
    for (std::size_t v = 0; v < file.pyramid.source.size(); v += 37) {
        EXPECT_FALSE(decodeWith(file, sources + 4 * v, vertexCount));
        EXPECT_FALSE(decodeWith(file, sources + 4 * v, 0xffffffffu));
        EXPECT_TRUE(decodeWith(file, sources + 4 * v, vertexCount - 1));
    }
    for (const PyramidLevel& level : file.pyramid.levels)
        for (const IndexRange& range : level.primitives)
            for (const std::size_t i : {std::size_t{0}, std::size_t{range.count} / 2, std::size_t{range.count} - 1}) {
                const std::size_t offset = indices + 4 * (range.first + i);
                EXPECT_FALSE(decodeWith(file, offset, level.vertexCount));
                EXPECT_FALSE(decodeWith(file, offset, 0xffffffffu));
                EXPECT_TRUE(decodeWith(file, offset, level.vertexCount - 1));
            }
    const auto lastEnd = static_cast<std::uint32_t>(lastPyramidEnd);
    EXPECT_TRUE(decodeWith(file, offsetof(PyramidFileHeader, end), lastEnd));
    EXPECT_FALSE(decodeWith(file, offsetof(PyramidFileHeader, end), lastEnd + 1));
    for (const double value : {-1.0, std::nan("")}) {
        const std::size_t record = sizeof(PyramidFileHeader) + sizeof(PyramidFileLevel);
        EXPECT_FALSE(decodeWith(file, record + offsetof(PyramidFileLevel, meanEdge), value));
        EXPECT_FALSE(decodeWith(file, record + offsetof(PyramidFileLevel, error), value));
    }
}

TEST(PyramidFile, randomWordsUnderARightChecksumGiveNothingOrSomethingSound) {
    const Encoded file(decoratedTorus());
    const std::size_t words = file.bytes.size() / 4;
    const std::size_t tableWords = sectionBorders(file)[3] / 4;
    std::uint64_t state = 1;
    const auto random = [&](std::uint64_t below) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return (state >> 33) % below;
    };
    std::size_t sound = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Bytes bytes = file.bytes;
        for (std::uint64_t change = 0; change <= random(3); ++change) {
            const std::size_t word = trial % 2 == 0 ? random(tableWords) : random(words);
            const auto value = static_cast<std::uint32_t>(random(2) == 0 ? random(1ull << 31) * 2 : random(2000));
            std::memcpy(bytes.data() + 4 * word, &value, sizeof value);
        }
        seal(bytes);
        const auto decoded = file.decode(bytes);
        if (!decoded) continue;
        ++sound;
        expectSound(*decoded, file.mesh);
    }
    EXPECT_GT(sound, 100u);  // most words of the file are coordinates, for which any value is valid
}

std::vector<Mesh> someMeshes() {
    return {decoratedTorus(), Mesh{}, sphere(24, 16), flatGrid(2), torus(16, 12)};
}

std::size_t fileCount(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void expectBuilt(const CachedPyramids& cached, const std::vector<Mesh>& meshes) {
    const std::vector<Pyramid> built = buildPyramids(meshes);
    ASSERT_EQ(cached.pyramids.size(), built.size());
    for (std::size_t i = 0; i < built.size(); ++i) {
        SCOPED_TRACE(i);
        expectEqual(cached.pyramids[i], built[i]);
    }
}

TEST(PyramidCache, storesAtFirstAndLoadsAfterwards) {
    const ScratchFolder scratch;
    const fs::path folder = scratch / "new" / "cache ❤";
    const std::vector<Mesh> meshes = someMeshes();
    const CachedPyramids first = cachedPyramids(meshes, folder);
    expectBuilt(first, meshes);
    EXPECT_EQ(first.loaded, 0u);
    EXPECT_EQ(first.failure, "");
    EXPECT_EQ(fileCount(folder), 3u);  // the empty mesh and the mesh of 8 triangles have no file

    std::uint64_t left = 1;
    const CachedPyramids second = cachedPyramids(
        meshes, folder, {}, [&](std::string_view, std::uint64_t done, std::uint64_t total) { left = total - done; });
    expectBuilt(second, meshes);
    EXPECT_EQ(second.loaded, 3u);
    EXPECT_EQ(left, 0u);
}

TEST(PyramidCache, otherOptionsHaveTheirOwnFiles) {
    const ScratchFolder scratch;
    const std::vector<Mesh> meshes = {sphere(24, 16)};
    const std::vector<PyramidOptions> others = {
        {.minTriangles = 200}, {.vertices = LevelVertices::surviving}, {.vertices = LevelVertices::quarters}};
    EXPECT_EQ(cachedPyramids(meshes, scratch.path()).loaded, 0u);
    for (const PyramidOptions& other : others) EXPECT_EQ(cachedPyramids(meshes, scratch.path(), other).loaded, 0u);
    EXPECT_EQ(cachedPyramids(meshes, scratch.path()).loaded, 1u);
    for (const PyramidOptions& other : others) {
        const CachedPyramids again = cachedPyramids(meshes, scratch.path(), other);
        EXPECT_EQ(again.loaded, 1u);
        expectEqual(again.pyramids[0], buildPyramid(meshes[0], other));
    }
}

// A cache file is valid only for the value of LevelVertices with which it was built. It is rejected for other values,
// even if the file is renamed.
TEST(PyramidCache, aFileIsOfItsOwnVertices) {
    const Mesh mesh = sphere(24, 16);
    const PyramidOptions surviving{.vertices = LevelVertices::surviving};
    const Bytes bytes = encodePyramid(buildPyramid(mesh, surviving), mesh, pyramidKey(mesh, surviving));
    EXPECT_TRUE(decodePyramid(bytes, mesh, pyramidKey(mesh, surviving)));
    EXPECT_FALSE(decodePyramid(bytes, mesh, pyramidKey(mesh, {})));
}

TEST(PyramidCache, damageIsReplaced) {
    const ScratchFolder scratch;
    const std::vector<Mesh> meshes = {sphere(24, 16)};
    (void)cachedPyramids(meshes, scratch.path());
    const fs::path path = fs::directory_iterator(scratch.path())->path();
    const Bytes good = readFile(path);
    Bytes bad = good;
    bad[bad.size() / 2] ^= std::byte{4};
    for (const Bytes& damaged : {bad, Bytes(good.begin(), good.begin() + 200), Bytes{}}) {
        writeFile(path, damaged);
        EXPECT_FALSE(loadPyramid(meshes[0], scratch.path()));
        const CachedPyramids cached = cachedPyramids(meshes, scratch.path());
        expectBuilt(cached, meshes);
        EXPECT_EQ(cached.failure, "");
        EXPECT_EQ(readFile(path), good);
    }
    EXPECT_TRUE(loadPyramid(meshes[0], scratch.path()));
}

// A cache entry that is a link or a pipe is a miss and is replaced; the file behind a link keeps its bytes. A cache
// folder may be a link.
TEST(PyramidCache, entriesAreNeverLinksOrPipes) {
    const ScratchFolder scratch, elsewhere;
    fs::create_directory_symlink(scratch.path(), elsewhere / "cache");
    const fs::path folder = elsewhere / "cache";
    const std::vector<Mesh> meshes = {sphere(24, 16)};
    (void)cachedPyramids(meshes, folder);
    const fs::path entry = fs::directory_iterator(scratch.path())->path();
    const fs::path victim = elsewhere / "victim";
    fs::rename(entry, victim);
    const Bytes before = readFile(victim);
    for (const bool linked : {true, false}) {
        if (linked)
            fs::create_symlink(victim, entry);
        else
            ASSERT_EQ(::mkfifo(entry.c_str(), 0600), 0);
        const CachedPyramids cached = cachedPyramids(meshes, folder);
        expectBuilt(cached, meshes);
        EXPECT_EQ(cached.loaded, 0u) << linked;
        EXPECT_EQ(cached.failure, "");
        EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(entry)));
        EXPECT_EQ(readFile(victim), before);
        EXPECT_EQ(cachedPyramids(meshes, folder).loaded, 1u);
        fs::remove(entry);
    }
}

TEST(PyramidCache, withoutAFolderEverythingIsBuilt) {
    const std::vector<Mesh> meshes = {sphere(24, 16)};
    const CachedPyramids cached = cachedPyramids(meshes, {});
    expectBuilt(cached, meshes);
    EXPECT_EQ(cached.loaded, 0u);
    EXPECT_EQ(cached.failure, "");
}

TEST(PyramidCache, aFolderThatCannotBeMadeIsOneFailureAndNoFault) {
    const ScratchFolder scratch;
    writeFile(scratch / "file", std::string_view("not a folder"));
    const std::vector<Mesh> meshes = someMeshes();
    const CachedPyramids cached = cachedPyramids(meshes, scratch / "file" / "cache");
    expectBuilt(cached, meshes);
    EXPECT_NE(cached.failure.find((scratch / "file").string()), std::string::npos) << cached.failure;
    EXPECT_EQ(cached.failure.find('\n'), std::string::npos);
}

// A full disk, simulated by a limit on the file size, leaves no incomplete file in the cache.
TEST(PyramidCache, aFullDiskLeavesNoFile) {
    const ScratchFolder scratch;
    const std::vector<Mesh> meshes = {sphere(48, 32)};
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
    const rlimit small{5000, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const CachedPyramids cached = cachedPyramids(meshes, scratch.path());
    ::setrlimit(RLIMIT_FSIZE, &limit);
    (void)std::signal(SIGXFSZ, previous);
    expectBuilt(cached, meshes);
    EXPECT_NE(cached.failure.find("cannot write "), std::string::npos) << cached.failure;
    EXPECT_TRUE(fs::is_empty(scratch.path()));
}

// Processes that fill, read and damage the same folder at the same time all get the pyramids that they would build.
TEST(PyramidCache, processesMayShareAFolder) {
    const ScratchFolder scratch;
    const std::vector<Mesh> meshes = {sphere(24, 16), torus(16, 12)};
    const std::vector<Pyramid> built = buildPyramids(meshes);
    std::vector<pid_t> children;
    for (int child = 0; child < 4; ++child) {
        const pid_t id = ::fork();
        ASSERT_GE(id, 0);
        if (id > 0) {
            children.push_back(id);
            continue;
        }
        bool good = true;
        for (int round = 0; round < 20 && good; ++round)
            for (std::size_t i = 0; i < meshes.size() && good; ++i) {
                const auto loaded = loadPyramid(meshes[i], scratch.path());
                good = !loaded || sameBits(loaded->indices, built[i].indices);
                storePyramid(built[i], meshes[i], scratch.path());
                // After the first store, the cache always holds a complete file.
                good = good && loadPyramid(meshes[i], scratch.path()).has_value();
            }
        ::_exit(good ? 0 : 1);
    }
    for (const pid_t id : children) {
        int status = 0;
        ::waitpid(id, &status, 0);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    EXPECT_EQ(fileCount(scratch.path()), 2u);
}

TEST(PyramidCache, listsAndClearsItsOwnFilesOnly) {
    const ScratchFolder scratch;
    EXPECT_TRUE(cacheFiles(scratch / "missing").empty());
    EXPECT_TRUE(clearCache(scratch / "missing").empty());
    const Mesh mesh = sphere(24, 16);
    (void)cachedPyramids({mesh}, scratch.path());
    const fs::path own = fs::directory_iterator(scratch.path())->path();
    const Bytes bytes = readFile(own);
    const std::string stem = own.stem().string();

    // A temporary file that a killed process left behind counts as a file of the cache. Files with foreign names or
    // foreign content do not.
    writeFile(scratch / ("." + stem + ".123-0.pyramid"), bytes);
    std::vector<std::string> foreign = {"notes.txt", "0123456789abcdef.pyramid", ".0123456789abcdef.1-0.pyramid"};
    for (const std::string& name : foreign) writeFile(scratch / name, std::string_view("somebody's"));
    for (const std::string& name : {"copy of " + stem + ".pyramid", stem + ".pyramid.bak", stem + "0.pyramid",
                                    stem.substr(1) + ".pyramid", "X" + stem.substr(1) + ".pyramid",
                                    "." + stem + ".pyramid", "." + stem + "..pyramid", "." + stem + ".123.pyramid",
                                    "." + stem + ".-0.pyramid", "." + stem + ".1-.pyramid", std::string(".pyramid")}) {
        writeFile(scratch / name, bytes);
        foreign.push_back(name);
    }
    fs::create_directory(scratch / "00000000000000aa.pyramid");
    fs::create_symlink(own, scratch / "00000000000000bb.pyramid");

    const std::vector<CacheFile> files = cacheFiles(scratch.path());
    ASSERT_EQ(files.size(), 2u);
    const CacheFile& complete = files[files[0].pending ? 1 : 0];
    EXPECT_EQ(complete.path, own);
    EXPECT_EQ(complete.bytes, bytes.size());
    EXPECT_EQ(complete.triangles, mesh.triangleCount());
    EXPECT_FALSE(complete.pending);

    EXPECT_EQ(clearCache(scratch.path()).size(), 2u);
    EXPECT_FALSE(fs::exists(own));
    EXPECT_EQ(fileCount(scratch.path()), foreign.size() + 2);
    EXPECT_TRUE(cacheFiles(scratch.path()).empty());
    writeFile(scratch / "plain file", std::string_view("x"));
    EXPECT_THROW((void)cacheFiles(scratch / "plain file"), Error);
}

class CacheEnvironment : public testing::Test {
protected:
    void TearDown() override {
        restore("XDG_CACHE_HOME", caches_);
        restore("HOME", home_);
    }
    static void set(const char* caches, const char* home) {
        caches == nullptr ? ::unsetenv("XDG_CACHE_HOME") : ::setenv("XDG_CACHE_HOME", caches, 1);
        home == nullptr ? ::unsetenv("HOME") : ::setenv("HOME", home, 1);
    }

private:
    static std::optional<std::string> valueOf(const char* name) {
        const char* value = std::getenv(name);
        return value == nullptr ? std::nullopt : std::optional<std::string>(value);
    }
    static void restore(const char* name, const std::optional<std::string>& value) {
        value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
    }
    std::optional<std::string> caches_ = valueOf("XDG_CACHE_HOME");
    std::optional<std::string> home_ = valueOf("HOME");
};

// The default folder follows the XDG Base Directory Specification: an empty variable counts as unset, and relative
// paths are ignored.
TEST_F(CacheEnvironment, tellsTheDefaultFolder) {
    set("/caches", "/home/me");
    EXPECT_EQ(defaultCacheFolder(), "/caches/defocus");
    set(nullptr, "/home/me");
    EXPECT_EQ(defaultCacheFolder(), "/home/me/.cache/defocus");
    set("", "/home/me");
    EXPECT_EQ(defaultCacheFolder(), "/home/me/.cache/defocus");
    set("relative", "/home/me");
    EXPECT_EQ(defaultCacheFolder(), "/home/me/.cache/defocus");
    set(nullptr, nullptr);
    EXPECT_TRUE(defaultCacheFolder().empty());
    set("", "");
    EXPECT_TRUE(defaultCacheFolder().empty());
}

}  // namespace
}  // namespace defocus::engine
