#pragma once
// Typed reading of accessors: every component type, normalised integers, interleaving, matrices, sparse substitution,
// and accessors without data (zeros). Internal to the loader.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Throws Error unless every accessor has a known type and stays inside its buffer view; nothing is read.
void checkAccessors(const Source& source);

std::size_t elementCount(const Source& source, int accessor);
int componentCount(const Source& source, int accessor);  // 1 (SCALAR), 2 … 4 (vectors), 16 (MAT4) …

// What the accessor's integers are divided by: 1 unless it is normalised.
double normalisationScale(const Source& source, int accessor);

// All elements as floats, componentCount each; normalised integers become [0, 1] or [−1, 1]. Throws Error naming `what`
// unless an element has `components` of them.
std::vector<float> readFloats(Source& source, int accessor, int components, const std::string& what);

// The same for integers (indices, joints), unscaled. Throws Error for floats and negative values.
std::vector<std::uint32_t> readIntegers(Source& source, int accessor, int components, const std::string& what);

// Floats grouped into vectors.
template <typename Vector>
std::vector<Vector> readVectors(Source& source, int accessor, const std::string& what) {
    constexpr int components = Vector::length();
    const std::vector<float> floats = readFloats(source, accessor, components, what);
    std::vector<Vector> result(floats.size() / static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < result.size(); ++i)
        for (int c = 0; c < components; ++c)
            result[i][c] = floats[i * static_cast<std::size_t>(components) + static_cast<std::size_t>(c)];
    return result;
}

}  // namespace defocus::engine::gltf
