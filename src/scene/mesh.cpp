#include "scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace defocus::engine {

namespace {

bool lessByCoordinates(const glm::vec3& a, const glm::vec3& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

// Returns, for each position, the smallest index of an equal position (−0 equals 0).
std::vector<std::uint32_t> weldedIndices(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (lessByCoordinates(positions[a], positions[b])) return true;
        return !lessByCoordinates(positions[b], positions[a]) && a < b;
    });
    std::vector<std::uint32_t> welded(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool repeats = i > 0 && positions[order[i]] == positions[order[i - 1]];
        welded[order[i]] = repeats ? welded[order[i - 1]] : order[i];
    }
    return welded;
}

}  // namespace

VertexBlurBounds boundsOf(const std::vector<VertexBlur>& blurs) {
    VertexBlurBounds bounds;
    if (blurs.empty()) return bounds;
    bounds.factorMin = bounds.factorMax = blurs.front().factor;
    bounds.addedMin = bounds.addedMax = blurs.front().opening;
    for (const VertexBlur& blur : blurs) {
        bounds.factorMin = std::min(bounds.factorMin, blur.factor);
        bounds.factorMax = std::max(bounds.factorMax, blur.factor);
        bounds.addedMin = std::min({bounds.addedMin, blur.opening, blur.closing});
        bounds.addedMax = std::max({bounds.addedMax, blur.opening, blur.closing});
        bounds.moves |= blur.opening != blur.closing;
    }
    return bounds;
}

std::size_t Mesh::triangleCount() const {
    std::size_t count = 0;
    for (const Primitive& primitive : primitives) count += primitive.indices.size() / 3;
    return count;
}

Bounds Mesh::bounds() const {
    // Single precision is exact, because min and max only select coordinates.
    glm::vec3 minimum(std::numeric_limits<float>::infinity());
    glm::vec3 maximum(-std::numeric_limits<float>::infinity());
    const auto extend = [&](const std::vector<std::uint32_t>& indices, const std::vector<glm::vec3>& positions) {
        for (const std::uint32_t index : indices) {
            minimum = glm::min(minimum, positions[index]);
            maximum = glm::max(maximum, positions[index]);
        }
    };
    for (const Primitive& primitive : primitives) extend(primitive.indices, vertices.positions);
    for (const Strokes& stroke : strokes) extend(stroke.indices, stroke.vertices.positions);
    Bounds result;
    result.minimum = minimum;
    result.maximum = maximum;
    return result;
}

Bounds boundsOf(const std::vector<glm::vec3>& positions) {
    Bounds bounds;
    for (const glm::vec3& p : positions)
        if (isFinite(p)) bounds.extend(glm::dvec3(p));
    return bounds;
}

std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& indices) {
    const std::vector<std::uint32_t> welded = weldedIndices(positions);

    // The cross product of two edges is the face normal times twice the face's area, so the sum is weighted by area.
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a = positions[indices[i]];
        const glm::dvec3 cross =
            glm::cross(glm::dvec3(positions[indices[i + 1]]) - a, glm::dvec3(positions[indices[i + 2]]) - a);
        for (std::size_t corner = 0; corner < 3; ++corner) sums[welded[indices[i + corner]]] += cross;
    }

    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::dvec3& sum = sums[welded[i]];
        const double length = glm::length(sum);
        normals[i] = length > 0 && std::isfinite(length) ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
    }
    return normals;
}

}  // namespace defocus::engine
