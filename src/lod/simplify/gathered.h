#pragma once
// Picks values by number, in the order of the numbers, which must be below values.size(). An attribute that the
// vertices don't have stays empty.

#include <cstdint>
#include <vector>

#include "scene/mesh.h"

namespace defocus {

template <typename T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(order.size());
    for (const std::uint32_t i : order) result.push_back(values[i]);
    return result;
}

inline Vertices gathered(const Vertices& vertices, const std::vector<std::uint32_t>& order) {
    Vertices result;
    result.positions = gathered(vertices.positions, order);
    result.normals = gathered(vertices.normals, order);
    result.tangents = gathered(vertices.tangents, order);
    result.uv0 = gathered(vertices.uv0, order);
    result.uv1 = gathered(vertices.uv1, order);
    result.colors = gathered(vertices.colors, order);
    result.joints = gathered(vertices.joints, order);
    result.weights = gathered(vertices.weights, order);
    result.cocScales = gathered(vertices.cocScales, order);
    result.joints1 = gathered(vertices.joints1, order);
    result.weights1 = gathered(vertices.weights1, order);
    return result;
}

}  // namespace defocus
