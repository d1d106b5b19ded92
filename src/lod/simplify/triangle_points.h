#pragma once
// Points of a triangle, to integrate over it.

#include <glm/vec3.hpp>
#include <initializer_list>
#include <utility>

namespace defocus {

// Calls visit(weights, share) for points of a triangle that is split into parts² alike: the middles of their edges,
// which integrate quadratic functions exactly. `weights` are those of the corners, and the shares sum to 1.
template <typename Visit>
void forEachTrianglePoint(int parts, const Visit& visit) {
    const double step = 1.0 / parts;
    const auto middles = [&](double x, double y, double size) {
        for (const auto& [dx, dy] : {std::pair{0.5, 0.0}, std::pair{0.0, 0.5}, std::pair{0.5, 0.5}}) {
            const double s = x + dx * size;
            const double t = y + dy * size;
            visit(glm::dvec3(1 - s - t, s, t), step * step / 3);
        }
    };
    for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j) {
            middles(i * step, j * step, step);
            if (i + j + 1 < parts) middles((i + 1) * step, (j + 1) * step, -step);
        }
}

}  // namespace defocus
