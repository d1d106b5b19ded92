#pragma once
// Reads accessors as floats or integers: all component types, normalised integers, interleaved data, matrices and
// sparse elements. Accessors without data read as zeros. Internal to the glTF loader.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "scene/gltf/source.h"

namespace defocus::engine::gltf {

// Throws Error unless every accessor has a known type and lies inside its buffer view.
void checkAccessors(const Source& source);

std::size_t elementCount(const Source& source, int accessor);
int componentCount(const Source& source, int accessor);  // per element: 1 (SCALAR), 2 to 4 (VEC2 to VEC4), 16 (MAT4) …

// Returns the divisor that maps the accessor's normalised integers to [0, 1] or [−1, 1]; 1 for an accessor that is not
// normalised.
double normalisationScale(const Source& source, int accessor);

// Returns all elements as floats; normalised integers become [0, 1] or [−1, 1]. Throws Error, with `what` in its
// message, unless each element has `components` components.
std::vector<float> readFloats(Source& source, int accessor, int components, const std::string& what);

// Returns all elements as integers, e.g. indices and joints. Throws Error, with `what` in its message, for a wrong
// number of components, and for accessors of float or signed type.
std::vector<std::uint32_t> readIntegers(Source& source, int accessor, int components, const std::string& what);

// Same as readFloats, with one glm vector per element.
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
