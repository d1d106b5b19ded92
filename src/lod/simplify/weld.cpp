#include "lod/simplify/weld.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>
#include <span>

#include "core/hash.h"

namespace defocus::engine {

namespace {

constexpr float agreeingCosine = 0.99985f;  // cosine of 1°

// Gives equal vertices the same id. Uses a hash table with open addressing and linear probing, at most half full.
// equal(a, b) compares two vertices whose hashes are equal.
template <typename Vertex, typename Id, typename Equal>
Welded<Vertex, Id> weld(const std::vector<std::uint64_t>& hashes, const Equal& equal) {
    const std::size_t size = std::bit_ceil(2 * hashes.size() + 1);
    std::vector<Id> table(size);
    Welded<Vertex, Id> result;
    result.id.resize(hashes.size());
    for (std::uint32_t v = 0; v < hashes.size(); ++v) {
        std::uint64_t slot = (hashes[v] ^ (hashes[v] >> 32)) & (size - 1);
        while (table[slot].isValid()) {
            const Vertex other = result.first[table[slot]];
            if (hashes[other.value] == hashes[v] && equal(other.value, v)) break;
            slot = (slot + 1) & (size - 1);
        }
        if (!table[slot].isValid()) {
            table[slot] = result.first.next();
            result.first.push_back({v});
        }
        result.id[{v}] = table[slot];
    }
    return result;
}

// The values of one vertex attribute, as bytes, with one entry per vertex.
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
    addStream(streams, mesh.vertices.blurs);
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

WeldedPositions weldPositions(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint64_t> hashes(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const glm::vec3 unsignedZero = positions[v] + 0.0f;
        hashes[v] = hashBytes(std::as_bytes(std::span(&unsignedZero, 1)));
    }
    return weld<MeshVertexNumber, PositionNumber>(
        hashes, [&](std::uint32_t a, std::uint32_t b) { return positions[a] == positions[b]; });
}

WeldedVertices weldVertices(const Mesh& mesh) {
    const std::vector<Stream> streams = attributeStreams(mesh);
    std::vector<std::uint64_t> hashes(mesh.vertices.count(), hashSeed);
    for (const Stream& stream : streams)
        for (std::size_t v = 0; v < hashes.size(); ++v) hashes[v] = hashBytes({stream.at(v), stream.stride}, hashes[v]);
    return weld<FileVertexNumber, MeshVertexNumber>(hashes, [&](std::uint32_t a, std::uint32_t b) {
        for (const Stream& stream : streams)
            if (std::memcmp(stream.at(a), stream.at(b), stream.stride) != 0) return false;
        return true;
    });
}

VertexGroups smoothingGroups(const std::vector<glm::vec3>& normals, const WeldedPositions& positions) {
    // Compare only vertices that share their position with others; every other vertex is the only member of its group.
    const Numbered<MeshVertexNumber, PositionNumber>& at = positions.id;
    VertexGroups groups(normals.size());
    for (const MeshVertexNumber v : groups.numbers()) groups[v] = v;
    Numbered<PositionNumber, std::uint8_t> met(positions.first.size(), 0);  // vertex count per position, clamped to 2
    for (const PositionNumber position : at) met[position] = met[position] == 0 ? 1 : 2;
    std::vector<MeshVertexNumber> order;
    for (const MeshVertexNumber v : groups)
        if (met[at[v]] == 2) order.push_back(v);
    std::stable_sort(order.begin(), order.end(), [&](MeshVertexNumber a, MeshVertexNumber b) { return at[a] < at[b]; });

    std::vector<MeshVertexNumber> leaders;  // first vertex of each group of similar normals at this position
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || at[order[i]] != at[order[i - 1]]) leaders.clear();
        const glm::vec3& normal = normals[order[i].value];
        const auto leader = std::find_if(leaders.begin(), leaders.end(), [&](MeshVertexNumber v) {
            return glm::dot(normals[v.value], normal) > agreeingCosine;
        });
        groups[order[i]] = leader != leaders.end() ? *leader : order[i];
        if (leader == leaders.end()) leaders.push_back(order[i]);
    }
    return groups;
}

}  // namespace defocus::engine
