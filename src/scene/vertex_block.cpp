// Source of perpendicular(): Frisvad, "Building an Orthonormal Basis from a 3D Unit Vector Without Normalization",
// 2012, with the sign handling of Duff et al. 2017.
#include "scene/vertex_block.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace defocus::engine {

namespace {

constexpr std::uint32_t unusedVertex = std::numeric_limits<std::uint32_t>::max();

template <typename T>
std::vector<T> pick(const std::vector<T>& values, std::span<const std::uint32_t> order) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(order.size());
    for (const std::uint32_t index : order) result.push_back(values[index]);
    return result;
}

// Appends `added` (`addedCount` values, or empty) to `values` (`count` values, or empty). If only one of the two is
// empty, the empty one is first filled with `neutral`.
template <typename T>
void join(std::vector<T>& values, std::size_t count, const std::vector<T>& added, std::size_t addedCount,
          const T& neutral) {
    if (values.empty() && added.empty()) return;
    if (values.empty()) values.assign(count, neutral);
    if (added.empty())
        values.resize(count + addedCount, neutral);
    else
        values.insert(values.end(), added.begin(), added.end());
}

// Returns the face normal for each position; every three positions form a triangle. Triangles without area get +y.
std::vector<glm::vec3> faceNormals(const std::vector<glm::vec3>& positions) {
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
        const glm::dvec3 a = positions[i];
        const glm::dvec3 cross = glm::cross(glm::dvec3(positions[i + 1]) - a, glm::dvec3(positions[i + 2]) - a);
        const double length = glm::length(cross);
        const glm::vec3 normal = length > 0 && std::isfinite(length) ? glm::vec3(cross / length) : glm::vec3(0, 1, 0);
        for (std::size_t corner = 0; corner < 3; ++corner) normals[i + corner] = normal;
    }
    return normals;
}

// Sets tangents of vertices [first, first + count) to arbitrary vectors perpendicular to their normals.
void fillTangents(std::vector<glm::vec4>& tangents, const std::vector<glm::vec3>& normals, std::size_t first,
                  std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
        tangents[i] = glm::vec4(perpendicular(normals.empty() ? glm::vec3(0, 1, 0) : normals[i]), 1.0f);
}

}  // namespace

Vertices gathered(const Vertices& vertices, std::span<const std::uint32_t> order) {
    return {pick(vertices.positions, order), pick(vertices.normals, order), pick(vertices.tangents, order),
            pick(vertices.uv0, order),       pick(vertices.uv1, order),     pick(vertices.colors, order),
            pick(vertices.joints, order),    pick(vertices.weights, order), pick(vertices.blurs, order),
            pick(vertices.joints1, order),   pick(vertices.weights1, order)};
}

VertexBlock gathered(const VertexBlock& block, std::span<const std::uint32_t> order) {
    VertexBlock result;
    result.vertices = gathered(block.vertices, order);
    for (const MorphTarget& target : block.morphTargets)
        result.morphTargets.push_back(
            {pick(target.positions, order), pick(target.normals, order), pick(target.tangents, order)});
    return result;
}

VertexBlock compacted(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices) {
    std::vector<std::uint32_t> renumbered(block.vertices.count(), unusedVertex);
    std::vector<std::uint32_t> order;
    for (std::vector<std::uint32_t>* list : indices)
        for (std::uint32_t& index : *list) {
            if (renumbered[index] == unusedVertex) {
                renumbered[index] = static_cast<std::uint32_t>(order.size());
                order.push_back(index);
            }
            index = renumbered[index];
        }
    return gathered(block, order);
}

VertexBlock flatShaded(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices) {
    std::vector<std::uint32_t> order;
    for (std::vector<std::uint32_t>* list : indices) {
        const auto first = static_cast<std::uint32_t>(order.size());
        order.insert(order.end(), list->begin(), list->end());
        std::iota(list->begin(), list->end(), first);
    }
    VertexBlock result = gathered(block, order);
    const std::vector<glm::vec3>& positions = result.vertices.positions;
    result.vertices.normals = faceNormals(positions);
    for (MorphTarget& target : result.morphTargets) {
        if (target.positions.empty()) continue;
        std::vector<glm::vec3> moved(positions.size());
        for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = positions[i] + target.positions[i];
        target.normals = faceNormals(moved);
        for (std::size_t i = 0; i < moved.size(); ++i) target.normals[i] -= result.vertices.normals[i];
    }
    return result;
}

std::uint32_t append(Mesh& mesh, const VertexBlock& block) {
    Vertices& to = mesh.vertices;
    const Vertices& from = block.vertices;
    const std::size_t count = to.count();
    const std::size_t added = from.count();

    const bool tangentsHere = !to.tangents.empty();
    join(to.normals, count, from.normals, added, glm::vec3(0, 1, 0));
    join(to.tangents, count, from.tangents, added, glm::vec4(0));
    if (!to.tangents.empty() && !tangentsHere) fillTangents(to.tangents, to.normals, 0, count);
    if (!to.tangents.empty() && from.tangents.empty()) fillTangents(to.tangents, to.normals, count, added);
    join(to.uv0, count, from.uv0, added, glm::vec2(0));
    join(to.uv1, count, from.uv1, added, glm::vec2(0));
    join(to.colors, count, from.colors, added, glm::vec4(1));
    join(to.joints, count, from.joints, added, glm::u16vec4(0));
    join(to.weights, count, from.weights, added, glm::vec4(1, 0, 0, 0));
    join(to.blurs, count, from.blurs, added, VertexBlur{});
    join(to.joints1, count, from.joints1, added, glm::u16vec4(0));
    join(to.weights1, count, from.weights1, added, glm::vec4(0));

    if (mesh.morphTargets.size() < block.morphTargets.size()) mesh.morphTargets.resize(block.morphTargets.size());
    for (std::size_t i = 0; i < mesh.morphTargets.size(); ++i) {
        const MorphTarget none;
        const MorphTarget& target = i < block.morphTargets.size() ? block.morphTargets[i] : none;
        join(mesh.morphTargets[i].positions, count, target.positions, added, glm::vec3(0));
        join(mesh.morphTargets[i].normals, count, target.normals, added, glm::vec3(0));
        join(mesh.morphTargets[i].tangents, count, target.tangents, added, glm::vec3(0));
    }
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    return static_cast<std::uint32_t>(count);
}

glm::vec3 perpendicular(const glm::vec3& normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    return {1.0f + sign * normal.x * normal.x * a, sign * normal.x * normal.y * a, -sign * normal.x};
}

}  // namespace defocus::engine
