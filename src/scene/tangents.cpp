#include "scene/tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace defocus::engine {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Direction in which texture coordinate u grows on a triangle, and whether its texture appears mirrored.
struct TextureFrame {
    glm::dvec3 tangent{0.0};  // any length; zero if the triangle has no area in texture coordinates
    bool mirrored = false;
};

TextureFrame textureFrame(const Vertices& vertices, const std::vector<glm::vec2>& uv, const std::uint32_t* triangle) {
    const glm::dvec3 edge1 = glm::dvec3(vertices.positions[triangle[1]]) - glm::dvec3(vertices.positions[triangle[0]]);
    const glm::dvec3 edge2 = glm::dvec3(vertices.positions[triangle[2]]) - glm::dvec3(vertices.positions[triangle[0]]);
    const glm::dvec2 uv1 = glm::dvec2(uv[triangle[1]]) - glm::dvec2(uv[triangle[0]]);
    const glm::dvec2 uv2 = glm::dvec2(uv[triangle[2]]) - glm::dvec2(uv[triangle[0]]);
    const double area = uv1.x * uv2.y - uv2.x * uv1.y;
    if (area == 0 || !std::isfinite(area)) return {};
    // In glTF, v grows downwards, so a texture that is not mirrored has a negative area in (u, v) on a
    // counter-clockwise triangle.
    return {(edge1 * uv2.y - edge2 * uv1.y) * (area < 0 ? -1.0 : 1.0), area > 0};
}

double cornerAngle(const Vertices& vertices, const std::uint32_t* triangle, std::size_t corner) {
    const glm::dvec3 here = vertices.positions[triangle[corner]];
    const glm::dvec3 a = glm::dvec3(vertices.positions[triangle[(corner + 1) % 3]]) - here;
    const glm::dvec3 b = glm::dvec3(vertices.positions[triangle[(corner + 2) % 3]]) - here;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Assigns new indices to vertices in order of first use. A vertex that triangles with mirrored and unmirrored textures
// share gets two indices.
class MirrorSplit {
public:
    explicit MirrorSplit(std::size_t count) : plain_(count, none), mirrored_(count, none) {}
    std::uint32_t index(std::uint32_t vertex, bool mirrored) {
        std::uint32_t& slot = (mirrored ? mirrored_ : plain_)[vertex];
        if (slot == none) {
            slot = static_cast<std::uint32_t>(order_.size());
            order_.push_back(vertex);
            signs_.push_back(mirrored ? -1.0f : 1.0f);
        }
        return slot;
    }
    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }
    [[nodiscard]] const std::vector<float>& signs() const { return signs_; }

private:
    std::vector<std::uint32_t> plain_;
    std::vector<std::uint32_t> mirrored_;
    std::vector<std::uint32_t> order_;
    std::vector<float> signs_;
};

glm::dvec3 unitOrZero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : glm::dvec3(0);
}

}  // namespace

VertexBlock withTangents(const VertexBlock& block, std::span<std::vector<std::uint32_t>* const> indices, int uvSet) {
    const Vertices& vertices = block.vertices;
    const std::vector<glm::vec2>& chosen = uvSet == 1 ? vertices.uv1 : vertices.uv0;
    const std::vector<glm::vec2> zero(chosen.empty() ? vertices.count() : 0);
    const std::vector<glm::vec2>& uv = chosen.empty() ? zero : chosen;

    // Add each triangle's tangent, projected and weighted by the corner angle, to its vertices. Replace the triangle's
    // indices with those of `split`.
    MirrorSplit split(vertices.count());
    std::vector<glm::dvec3> sums;
    for (std::vector<std::uint32_t>* list : indices)
        for (std::size_t i = 0; i + 2 < list->size(); i += 3) {
            const std::uint32_t triangle[3] = {(*list)[i], (*list)[i + 1], (*list)[i + 2]};
            const TextureFrame frame = textureFrame(vertices, uv, triangle);
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t index = split.index(triangle[corner], frame.mirrored);
                (*list)[i + corner] = index;
                sums.resize(split.order().size(), glm::dvec3(0));
                const glm::dvec3 normal = vertices.normals[triangle[corner]];
                const glm::dvec3 projected = frame.tangent - normal * glm::dot(normal, frame.tangent);
                sums[index] += unitOrZero(projected) * cornerAngle(vertices, triangle, corner);
            }
        }

    // Copy the split vertices and set their unit tangents.
    VertexBlock result = gathered(block, split.order());
    result.vertices.tangents.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 unit = unitOrZero(sums[i]);
        const glm::vec3 tangent = unit == glm::dvec3(0) ? perpendicular(result.vertices.normals[i]) : glm::vec3(unit);
        result.vertices.tangents[i] = glm::vec4(tangent, split.signs()[i]);
    }
    return result;
}

}  // namespace defocus::engine
