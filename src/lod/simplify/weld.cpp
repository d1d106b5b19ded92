#include "lod/simplify/weld.h"

#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <span>

#include "core/hash.h"

namespace defocus {

namespace {

constexpr std::uint32_t emptySlot = 0xffffffffu;

// Open addressing with linear probing over a table of at most half load. `equal` compares vertices of equal hash.
template <typename Equal>
Welded weld(const std::vector<std::uint64_t>& hashes, const Equal& equal) {
    const std::size_t size = std::bit_ceil(2 * hashes.size() + 1);
    std::vector<std::uint32_t> table(size, emptySlot);
    Welded result;
    result.id.resize(hashes.size());
    for (std::uint32_t v = 0; v < hashes.size(); ++v) {
        std::uint64_t slot = (hashes[v] ^ (hashes[v] >> 32)) & (size - 1);
        while (table[slot] != emptySlot) {
            const std::uint32_t other = result.first[table[slot]];
            if (hashes[other] == hashes[v] && equal(other, v)) break;
            slot = (slot + 1) & (size - 1);
        }
        if (table[slot] == emptySlot) {
            table[slot] = static_cast<std::uint32_t>(result.first.size());
            result.first.push_back(v);
        }
        result.id[v] = table[slot];
    }
    return result;
}

// The bytes of one attribute, vertex after vertex.
struct Stream {
    const std::byte* data = nullptr;
    std::size_t stride = 0;
    [[nodiscard]] const std::byte* at(std::size_t v) const { return data + v * stride; }
};

template <typename T>
void addStream(std::vector<Stream>& streams, const std::vector<T>& attribute) {
    if (!attribute.empty()) streams.push_back({reinterpret_cast<const std::byte*>(attribute.data()), sizeof(T)});
}

std::vector<Stream> attributeStreams(const Mesh& mesh) {
    std::vector<Stream> streams;
    addStream(streams, mesh.vertices.positions);
    addStream(streams, mesh.vertices.normals);
    addStream(streams, mesh.vertices.tangents);
    addStream(streams, mesh.vertices.uv0);
    addStream(streams, mesh.vertices.uv1);
    addStream(streams, mesh.vertices.colors);
    addStream(streams, mesh.vertices.joints);
    addStream(streams, mesh.vertices.weights);
    addStream(streams, mesh.vertices.cocScales);
    addStream(streams, mesh.vertices.joints1);
    addStream(streams, mesh.vertices.weights1);
    for (const MorphTarget& target : mesh.morphTargets) {
        addStream(streams, target.positions);
        addStream(streams, target.normals);
        addStream(streams, target.tangents);
    }
    return streams;
}

}  // namespace

Welded weldPositions(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint64_t> hashes(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const glm::vec3 unsignedZero = positions[v] + 0.0f;
        hashes[v] = hashBytes(std::as_bytes(std::span(&unsignedZero, 1)));
    }
    return weld(hashes, [&](std::uint32_t a, std::uint32_t b) { return positions[a] == positions[b]; });
}

Welded weldVertices(const Mesh& mesh) {
    const std::vector<Stream> streams = attributeStreams(mesh);
    std::vector<std::uint64_t> hashes(mesh.vertices.count(), hashSeed);
    for (const Stream& stream : streams)
        for (std::size_t v = 0; v < hashes.size(); ++v) hashes[v] = hashBytes({stream.at(v), stream.stride}, hashes[v]);
    return weld(hashes, [&](std::uint32_t a, std::uint32_t b) {
        for (const Stream& stream : streams)
            if (std::memcmp(stream.at(a), stream.at(b), stream.stride) != 0) return false;
        return true;
    });
}

}  // namespace defocus
