// What collapses cost: Garland and Heckbert 1997 (places), Hoppe 1999 (attributes).

#include <glm/geometric.hpp>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Squared edge length that weighs as much as a squared distance: decides on flat ground, where it favours even
// triangles.
constexpr float edgeWeight = 1e-4f;

AttributeRow change(const Simplifier& s, std::uint32_t from, std::uint32_t to) {
    AttributeRow result;
    for (std::size_t j = 0; j < attributeCount; ++j) result[j] = s.wedges[to].row[j] - s.wedges[from].row[j];
    return result;
}

float placeCost(const Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step) {
    const Quadric& quadric = s.quadrics[from];
    return quadric.at(step) + s.quadrics[to].c + quadric.weight * edgeWeight * glm::dot(step, step);
}

float wedgeCost(const Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step) {
    return s.wedges[from].quadric.at(step, change(s, from, to)) + s.wedges[to].quadric.squares.c;
}

glm::vec3 stepBetween(const Simplifier& s, std::uint32_t from, std::uint32_t to) {
    return glm::vec3(s.points[to] - s.points[from]);
}

}  // namespace

// Quadric errors of both vertices at the survivor, of place and of attributes, plus what edge length weighs. None of
// them is negative.
float collapseCost(const Simplifier& s, HalfedgeHandle edge, float most) {
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const std::uint32_t from = index(s.mesh.to_vertex_handle(opposite));
    const std::uint32_t to = index(s.mesh.to_vertex_handle(edge));
    const glm::vec3 step = stepBetween(s, from, to);
    float cost = placeCost(s, from, to, step);
    std::uint32_t lastFrom = EdgeSide::none;
    std::uint32_t lastTo = EdgeSide::none;
    for (const HalfedgeHandle side : {edge, opposite}) {
        if (!(cost < most)) return cost;
        const FaceHandle face = s.mesh.face_handle(side);
        if (!face.is_valid()) continue;
        const std::uint32_t wedgeFrom = s.corners.wedge[s.corners.at(index(face), from)];
        const std::uint32_t wedgeTo = s.corners.wedge[s.corners.at(index(face), to)];
        if (wedgeFrom == lastFrom && wedgeTo == lastTo) continue;
        lastFrom = wedgeFrom;
        lastTo = wedgeTo;
        cost += wedgeCost(s, wedgeFrom, wedgeTo, step);
    }
    return cost;
}

Candidate cheapestCollapse(Simplifier& s, std::uint32_t v) {
    s.spokes.clear();
    forEachOutgoing(s.mesh, vertexHandle(v), [&](HalfedgeHandle edge) {
        const std::uint32_t to = index(s.mesh.to_vertex_handle(edge));
        prefetch(&s.points[to]);
        prefetch(&s.quadrics[to]);
        s.spokes.push_back(edge);
    });
    Candidate best;
    for (const HalfedgeHandle edge : s.spokes) {
        const float cost = collapseCost(s, edge, best.cost);
        if (!(cost < best.cost)) continue;
        best.edge = edge;
        best.to = index(s.mesh.to_vertex_handle(edge));
        best.cost = cost;
    }
    return best;
}

void addAttributeQuadric(Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step) {
    s.wedges[to].quadric.add(s.wedges[from].quadric, step, change(s, from, to));
}

}  // namespace defocus
