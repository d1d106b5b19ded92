// Garland and Heckbert 1997 (cost); Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction
// (link condition).

#include <algorithm>
#include <glm/geometric.hpp>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Squared edge length that weighs as much as a squared distance: decides on flat ground, where it favours even
// triangles.
constexpr double edgeWeight = 1e-4;
constexpr double leastTurnCosine = 0.2588;  // 75°
constexpr double sliverQuality = 0.02;      // twice the area / sum of squared edges; 0.29 for an equilateral triangle

EdgeSide edgeSide(const Simplifier& s, FaceHandle face, std::uint32_t from, std::uint32_t to) {
    if (!face.is_valid()) return {};
    const std::uint32_t f = index(face);
    return {f, s.corners.wedge[s.corners.at(f, from)], s.corners.wedge[s.corners.at(f, to)]};
}

// How face `face` takes its corner at `from` moving to `target`.
Fit judgeMovedFace(const Simplifier& s, std::uint32_t face, std::uint32_t from, const glm::dvec3& target) {
    const std::uint32_t moving = s.corners.at(face, from) - 3 * face;
    const glm::dvec3& b = s.points[s.corners.vertex[3 * face + (moving + 1) % 3]];
    const glm::dvec3& c = s.points[s.corners.vertex[3 * face + (moving + 2) % 3]];
    const glm::dvec3& a = s.points[from];
    const glm::dvec3 before = glm::cross(b - a, c - a);
    const glm::dvec3 after = glm::cross(b - target, c - target);
    const double lengthBefore = glm::length(before);
    const double lengthAfter = glm::length(after);
    if (glm::dot(before, after) < leastTurnCosine * lengthBefore * lengthAfter || !(lengthAfter > 0)) return Fit::bad;
    const auto edges = [&](const glm::dvec3& p) {
        return glm::dot(b - p, b - p) + glm::dot(c - p, c - p) + glm::dot(c - b, c - b);
    };
    const double quality = lengthAfter / edges(target);
    return quality < sliverQuality && quality * edges(a) < lengthBefore ? Fit::poor : Fit::good;
}

// The link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999), and what OpenMesh's test of it leaves open: a second
// edge between the two vertices, and a tetrahedron, which would become two faces back to back.
bool keepsTopology(Simplifier& s, HalfedgeHandle edge) {
    if (!s.mesh.is_collapse_ok(edge)) return false;
    const VertexHandle to = s.mesh.to_vertex_handle(edge);
    const HalfedgeHandle onward = s.mesh.next_halfedge_handle(s.mesh.opposite_halfedge_handle(edge));
    int valence = 1;
    for (HalfedgeHandle h = onward; h != edge; ++valence) {
        if (s.mesh.to_vertex_handle(h) == to) return false;
        h = s.mesh.next_halfedge_handle(s.mesh.opposite_halfedge_handle(h));
    }
    const bool inside = !s.mesh.is_boundary(s.mesh.from_vertex_handle(edge)) && !s.mesh.is_boundary(to);
    return !(inside && valence == 3 && s.mesh.valence(to) == 3);
}

}  // namespace

void facesAround(const Simplifier& s, VertexHandle v, std::vector<std::uint32_t>& faces) {
    faces.clear();
    forEachOutgoing(s.mesh, v, [&](HalfedgeHandle edge) {
        if (const FaceHandle face = s.mesh.face_handle(edge); face.is_valid()) faces.push_back(index(face));
    });
}

// Quadric errors of both vertices at the survivor, of place and of attributes, plus what edge length weighs.
double collapseCost(const Simplifier& s, HalfedgeHandle edge) {
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const std::uint32_t from = index(s.mesh.to_vertex_handle(opposite));
    const std::uint32_t to = index(s.mesh.to_vertex_handle(edge));
    const glm::dvec3 step = s.points[to] - s.points[from];
    double cost = s.quadrics[from].at(s.points[to]) + s.quadrics[to].at(s.points[to]) +
                  s.quadrics[from].weight * edgeWeight * glm::dot(step, step);
    EdgeSide last;
    for (const HalfedgeHandle side : {edge, opposite}) {
        const EdgeSide wedges = edgeSide(s, s.mesh.face_handle(side), from, to);
        if (wedges.face == EdgeSide::none || (wedges.from == last.from && wedges.to == last.to)) continue;
        last = wedges;
        const AttributeRow& row = s.rows[wedges.to];
        cost += s.attributeQuadrics[wedges.from].at(s.points[to], row);
        cost += s.attributeQuadrics[wedges.to].at(s.points[to], row);
    }
    return cost;
}

// Leaves the wedges to hand over in `s.retargets`.
Fit judgeCollapse(Simplifier& s, HalfedgeHandle edge) {
    if (!keepsTopology(s, edge)) return Fit::impossible;
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const VertexHandle from = s.mesh.to_vertex_handle(opposite);
    const VertexHandle to = s.mesh.to_vertex_handle(edge);
    facesAround(s, from, s.facesFrom);
    facesAround(s, to, s.facesTo);

    WedgeQuestion question{index(from), index(to), {}, s.facesFrom, s.facesTo, 0};
    question.sides[0] = edgeSide(s, s.mesh.face_handle(edge), question.from, question.to);
    question.sides[1] = edgeSide(s, s.mesh.face_handle(opposite), question.from, question.to);
    question.edgeLength = glm::distance(s.points[question.from], s.points[question.to]);
    Fit worst = retargetWedges(s.corners, question, s.retargets);

    const bool isBorder = s.mesh.is_boundary(edge) || s.mesh.is_boundary(opposite);
    if (s.mesh.is_boundary(from) && !isBorder) worst = std::max(worst, Fit::poor);
    for (const std::uint32_t face : s.facesFrom)
        if (face != question.sides[0].face && face != question.sides[1].face)
            worst = std::max(worst, judgeMovedFace(s, face, question.from, s.points[question.to]));
    return worst;
}

}  // namespace defocus
