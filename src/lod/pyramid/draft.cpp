#include "lod/pyramid/draft.h"

#include <meshoptimizer.h>

#include <limits>

#include "scene/vertex_block.h"

namespace defocus::engine {

namespace {

constexpr double enough = 1.5;  // max ratio of the resulting to the requested triangle count

std::vector<std::uint32_t> simplified(const std::vector<glm::vec3>& positions,
                                      const std::vector<std::uint32_t>& indices, double share) {
    if (indices.empty()) return {};
    const auto target = static_cast<std::size_t>(share * static_cast<double>(indices.size() / 3)) * 3;
    constexpr float anyError = std::numeric_limits<float>::max();
    std::vector<std::uint32_t> result(indices.size());
    std::size_t count = meshopt_simplify(result.data(), indices.data(), indices.size(), &positions[0].x,
                                         positions.size(), sizeof(glm::vec3), target, anyError);
    if (static_cast<double>(count) > enough * static_cast<double>(target))
        count = meshopt_simplifySloppy(result.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                       sizeof(glm::vec3), target, anyError);
    result.resize(count);
    return result;
}

}  // namespace

Pyramid draftPyramid(const Mesh& mesh, std::uint32_t triangles) {
    const std::size_t count = mesh.triangleCount();
    if (count <= triangles) return fullDetail(mesh);
    const double share = static_cast<double>(triangles) / static_cast<double>(count);

    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(mesh.vertices.count(), unused);
    std::vector<std::uint32_t> used;
    Mesh draft;
    draft.name = mesh.name;
    for (const Primitive& primitive : mesh.primitives) {
        Primitive& coarse = draft.primitives.emplace_back();
        coarse.material = primitive.material;
        coarse.indices = simplified(mesh.vertices.positions, primitive.indices, share);
        for (std::uint32_t& index : coarse.indices) {
            if (numbers[index] == unused) {
                numbers[index] = static_cast<std::uint32_t>(used.size());
                used.push_back(index);
            }
            index = numbers[index];
        }
    }
    draft.vertices = gathered(mesh.vertices, used);

    Pyramid pyramid = fullDetail(draft);
    for (std::uint32_t& source : pyramid.source) source = used[source];
    measureDeformations(pyramid, mesh);
    return pyramid;
}

}  // namespace defocus::engine
