// What collapses are allowed: Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction (link
// condition).

#include <algorithm>
#include <glm/geometric.hpp>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

constexpr double leastTurnCosine = 0.2588;  // 75°
constexpr double sliverQuality = 0.02;      // twice the area / sum of squared edges; 0.29 for an equilateral triangle

// All of what the collapse adds up.
void prefetchWedge(const Simplifier& s, std::uint32_t wedge) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&s.wedges[wedge]);
    for (std::size_t i = 0; i < sizeof(WedgeQuadric); i += 64) prefetch(bytes + i);
}

EdgeSide edgeSide(const Simplifier& s, FaceHandle face, std::uint32_t from, std::uint32_t to) {
    if (!face.is_valid()) return {};
    const std::uint32_t f = index(face);
    const EdgeSide side{f, s.corners.wedge[s.corners.at(f, from)], s.corners.wedge[s.corners.at(f, to)]};
    prefetchWedge(s, side.from);
    prefetchWedge(s, side.to);
    return side;
}

// How face `face` takes its corner at `from` moving to `target`.
Fit judgeMovedFace(const Simplifier& s, std::uint32_t face, std::uint32_t from, const glm::dvec3& target) {
    const std::uint32_t moving = s.corners.at(face, from) - 3 * face;
    const glm::dvec3& b = s.points[s.corners.vertex[3 * face + (moving + 1) % 3]];
    const glm::dvec3& c = s.points[s.corners.vertex[3 * face + (moving + 2) % 3]];
    const glm::dvec3& a = s.points[from];
    const glm::dvec3 before = glm::cross(b - a, c - a);
    const glm::dvec3 after = glm::cross(b - target, c - target);
    const double squareBefore = glm::dot(before, before);
    const double squareAfter = glm::dot(after, after);
    const double along = glm::dot(before, after);
    if (!(squareAfter > 0) || along < 0) return Fit::bad;
    if (along * along < leastTurnCosine * leastTurnCosine * squareBefore * squareAfter) return Fit::bad;
    const auto edges = [&](const glm::dvec3& p) {
        return glm::dot(b - p, b - p) + glm::dot(c - p, c - p) + glm::dot(c - b, c - b);
    };
    // Quality is an area over squared edges; all sides squared, as roots are dear.
    const double edgesAfter = edges(target);
    if (!(squareAfter < sliverQuality * sliverQuality * edgesAfter * edgesAfter)) return Fit::good;
    const double edgesBefore = edges(a);
    return squareAfter * edgesBefore * edgesBefore < squareBefore * edgesAfter * edgesAfter ? Fit::poor : Fit::good;
}

bool isOnBorder(const Simplifier& s, VertexHandle v) {
    return !s.mesh.face_handle(s.mesh.halfedge_handle(v)).is_valid();
}

// The third vertex of the face along `edge`, invalid if there is none.
VertexHandle apex(const Simplifier& s, HalfedgeHandle edge) {
    if (!s.mesh.face_handle(edge).is_valid()) return VertexHandle();
    return s.mesh.to_vertex_handle(s.mesh.next_halfedge_handle(edge));
}

// The face along `edge` hangs on by this edge alone.
bool isFlap(const Simplifier& s, HalfedgeHandle edge) {
    if (!s.mesh.face_handle(edge).is_valid()) return false;
    const auto ends = [&](HalfedgeHandle h) {
        return !s.mesh.face_handle(s.mesh.opposite_halfedge_handle(h)).is_valid();
    };
    return ends(s.mesh.next_halfedge_handle(edge)) && ends(s.mesh.prev_halfedge_handle(edge));
}

// The link condition: the edge's vertices have no neighbours in common but those of its faces (and no second edge), a
// border is left by no edge but its own, and what would become two faces back to back stays. Leaves the faces around
// both in `s.facesFrom` and `s.facesTo`.
bool keepsTopology(Simplifier& s, HalfedgeHandle edge) {
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const VertexHandle from = s.mesh.to_vertex_handle(opposite);
    const VertexHandle to = s.mesh.to_vertex_handle(edge);
    const VertexHandle left = apex(s, edge);
    const VertexHandle right = apex(s, opposite);
    const bool inside = !isOnBorder(s, from) && !isOnBorder(s, to);
    if (left == right || isFlap(s, edge) || isFlap(s, opposite)) return false;
    if (left.is_valid() && right.is_valid() && isOnBorder(s, from) && isOnBorder(s, to)) return false;

    s.marks.resize(s.points.size(), 0);
    ++s.markNumber;
    s.facesFrom.clear();
    s.facesTo.clear();
    std::size_t edgesBetween = 0;
    std::size_t valenceFrom = 0;
    std::size_t valenceTo = 0;
    forEachOutgoing(s.mesh, from, [&](HalfedgeHandle out) {
        const VertexHandle neighbour = s.mesh.to_vertex_handle(out);
        if (neighbour == to) ++edgesBetween;
        prefetch(&s.candidates[index(neighbour)]);
        if (neighbour != left && neighbour != right) s.marks[index(neighbour)] = s.markNumber;
        if (const FaceHandle face = s.mesh.face_handle(out); face.is_valid()) s.facesFrom.push_back(index(face));
        ++valenceFrom;
    });
    bool shared = false;
    forEachOutgoing(s.mesh, to, [&](HalfedgeHandle out) {
        const std::uint32_t neighbour = index(s.mesh.to_vertex_handle(out));
        prefetch(&s.candidates[neighbour]);
        shared = shared || s.marks[neighbour] == s.markNumber;
        if (const FaceHandle face = s.mesh.face_handle(out); face.is_valid()) s.facesTo.push_back(index(face));
        ++valenceTo;
    });
    return edgesBetween == 1 && !shared && !(inside && valenceFrom == 3 && valenceTo == 3);
}

}  // namespace

void facesAround(const Simplifier& s, VertexHandle v, std::vector<std::uint32_t>& faces) {
    faces.clear();
    forEachOutgoing(s.mesh, v, [&](HalfedgeHandle edge) {
        if (const FaceHandle face = s.mesh.face_handle(edge); face.is_valid()) faces.push_back(index(face));
    });
}

// Leaves the wedges to hand over in `s.retargets`.
Fit judgeCollapse(Simplifier& s, HalfedgeHandle edge) {
    if (!keepsTopology(s, edge)) return Fit::impossible;
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const VertexHandle from = s.mesh.to_vertex_handle(opposite);
    const VertexHandle to = s.mesh.to_vertex_handle(edge);

    WedgeQuestion question{index(from), index(to), {}, s.facesFrom, s.facesTo, 0};
    question.sides[0] = edgeSide(s, s.mesh.face_handle(edge), question.from, question.to);
    question.sides[1] = edgeSide(s, s.mesh.face_handle(opposite), question.from, question.to);
    question.edgeLength = glm::distance(s.points[question.from], s.points[question.to]);
    Fit worst = retargetWedges(s.corners, question, s.retargets);

    const bool alongBorder = !s.mesh.face_handle(edge).is_valid() || !s.mesh.face_handle(opposite).is_valid();
    if (isOnBorder(s, from) && !alongBorder) worst = std::max(worst, Fit::poor);
    for (const std::uint32_t face : s.facesFrom)
        if (face != question.sides[0].face && face != question.sides[1].face)
            worst = std::max(worst, judgeMovedFace(s, face, question.from, s.points[question.to]));
    return worst;
}

}  // namespace defocus
