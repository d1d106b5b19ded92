// Tests levels of meshes that are difficult to simplify: flat, huge, tiny, sliver and degenerate grids.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "lod/pyramid/pyramid.h"
#include "stability/stability.h"

namespace defocus::engine {

namespace {

// Returns a flat grid of `cells` × `cells` quads that covers [0, width] × [0, height].
Mesh gridMesh(int cells, float width, float height) {
    Mesh mesh;
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x)
            mesh.vertices.positions.emplace_back(width * static_cast<float>(x) / static_cast<float>(cells),
                                                 height * static_cast<float>(y) / static_cast<float>(cells), 0);
    Primitive primitive;
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
            primitive.indices.insert(primitive.indices.end(), {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y),
                                                               at(x + 1, y + 1), at(x, y + 1)});
    mesh.vertices.normals.assign(mesh.vertices.positions.size(), {0, 0, 1});
    mesh.primitives.push_back(std::move(primitive));
    return mesh;
}

// Returns the max error over all levels of a flat mesh: the relative error of its area, or the distance of a vertex
// from the plane divided by `side`.
double flatError(const Mesh& mesh, double area, double side) {
    const Pyramid pyramid = buildPyramid(mesh);
    double largest = 0;
    for (const PyramidLevel& level : pyramid.levels) {
        double sum = 0;
        const std::vector<std::uint32_t>& indices = pyramid.indices;
        for (const IndexRange& range : level.primitives)
            for (std::uint32_t i = range.first; i + 2 < range.first + range.count; i += 3) {
                const glm::dvec3 a(level.positions.at(indices[i]));
                const glm::dvec3 b(level.positions.at(indices[i + 1]));
                const glm::dvec3 c(level.positions.at(indices[i + 2]));
                sum += 0.5 * glm::length(glm::cross(b - a, c - a));
                for (const glm::dvec3& p : {a, b, c}) {
                    if (!std::isfinite(p.x + p.y + p.z)) return infinite;
                    largest = std::max(largest, std::abs(p.z) / side);
                }
            }
        largest = std::max(largest, std::abs(sum / area - 1));
    }
    return largest;
}

// Returns a grid with additional degenerate triangles: some repeat an index, others have collinear corners.
Mesh besetGrid() {
    Mesh mesh = gridMesh(24, 1, 1);
    auto& indices = mesh.primitives[0].indices;
    for (std::uint32_t i = 0; i < 100; ++i) indices.insert(indices.end(), {i, i, i + 1});     // repeated index
    for (std::uint32_t i = 0; i < 20; ++i) indices.insert(indices.end(), {i, i + 1, i + 2});  // collinear corners
    return mesh;
}

}  // namespace

void addLevelCases(std::vector<StabilityCase>& cases) {
    const auto add = [&](std::string name, std::string measured, std::string reference, double limit,
                         std::function<double()> error) {
        cases.push_back(
            {"levels", std::move(name), std::move(measured), std::move(reference), limit, std::move(error)});
    };
    add("flat grid", "area or height, relative", "the plane", 1e-5, [] { return flatError(gridMesh(64, 1, 1), 1, 1); });
    add("flat grid of 1e6 m", "area or height, relative", "the plane", 1e-5,
        [] { return flatError(gridMesh(64, 1e6f, 1e6f), 1e12, 1e6); });
    add("flat grid of 1e-6 m", "area or height, relative", "the plane", 1e-5,
        [] { return flatError(gridMesh(64, 1e-6f, 1e-6f), 1e-12, 1e-6); });
    for (const float side : {0.1f, 0.7f})  // side lengths that floats cannot represent exactly
        add(fmt::format("flat grid of {:g} m", side), "area or height, relative", "the plane", 1e-5, [side] {
            const double exact = static_cast<double>(side);
            return flatError(gridMesh(64, side, side), exact * exact, exact);
        });
    add("slivers: flat cells 1,000 times as long as wide", "area or height, relative", "the plane", 1e-5,
        [] { return flatError(gridMesh(48, 1, 1e-3f), 1e-3, 1); });
    add("a grid beset with triangles without area", "area or height, relative", "the plane", 1e-5,
        [] { return flatError(besetGrid(), 1, 1); });
}

}  // namespace defocus::engine
