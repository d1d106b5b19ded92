// What collapses cost: Garland and Heckbert 1997 (places), Hoppe 1999 (attributes).

#include <glm/geometric.hpp>

#include "lod/simplify/state.h"

namespace defocus {

namespace {

// Squared edge length that weighs as much as a squared distance: decides on flat ground, where it favours even
// triangles.
constexpr float edgeWeight = 1e-4f;

AttributeRow change(const Wedge& from, const Wedge& to) {
    AttributeRow result;
    for (std::size_t j = 0; j < attributeCount; ++j) result[j] = to.row[j] - from.row[j];
    return result;
}

float placeCost(const SurfaceVertex& from, const SurfaceVertex& to, const glm::vec3& step) {
    return from.quadric.at(step) + to.quadric.c + from.quadric.weight * edgeWeight * glm::dot(step, step);
}

float wedgeCost(const Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step) {
    return s.attributeQuadrics[from].at(step, change(s.faces.wedges[from], s.faces.wedges[to])) +
           s.attributeQuadrics[to].squares.c;
}

}  // namespace

// Quadric errors of both vertices at the survivor, of place and of attributes, plus what edge length weighs. None of
// them is negative.
float collapseCost(const Simplifier& s, const Edge& edge, std::uint32_t from, std::uint32_t to, float most) {
    const glm::vec3 step(s.step(from, to));
    float cost = placeCost(s.vertices[from], s.vertices[to], step);
    if (!(cost < most)) return cost;
    const auto wedge = [&](std::uint32_t corner) { return s.faces.corners[corner].wedge; };
    std::uint32_t lastFrom = Corner::none;
    std::uint32_t lastTo = Corner::none;
    if (edge.along != Corner::none) {
        lastFrom = wedge(edge.along);
        lastTo = wedge(nextCorner(edge.along));
        cost += wedgeCost(s, lastFrom, lastTo, step);
    }
    if (edge.back == Corner::none || !(cost < most)) return cost;
    const std::uint32_t wedgeFrom = wedge(nextCorner(edge.back));
    const std::uint32_t wedgeTo = wedge(edge.back);
    if (wedgeFrom == lastFrom && wedgeTo == lastTo) return cost;
    return cost + wedgeCost(s, wedgeFrom, wedgeTo, step);
}

Candidate cheapestCollapse(Simplifier& s, std::uint32_t v) {
    s.spokes.clear();
    forEachEdgeAround(s, v, [&](const Edge& edge, std::uint32_t to) {
        prefetch(&s.vertices[to]);
        const std::uint32_t wedge =
            s.faces.corners[edge.along != Corner::none ? nextCorner(edge.along) : edge.back].wedge;
        prefetch(&s.faces.wedges[wedge]);
        prefetch(&s.attributeQuadrics[wedge]);
        s.spokes.push_back({edge, to});
    });
    Candidate best;
    for (const Spoke& spoke : s.spokes) {
        const float cost = collapseCost(s, spoke.edge, v, spoke.to, best.cost);
        if (!(cost < best.cost)) continue;
        best.to = spoke.to;
        best.cost = cost;
    }
    return best;
}

void addAttributeQuadric(Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step) {
    s.attributeQuadrics[to].add(s.attributeQuadrics[from], step, change(s.faces.wedges[from], s.faces.wedges[to]));
}

}  // namespace defocus
