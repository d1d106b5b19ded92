#include "lod/simplify/shape_module.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace defocus {

namespace {

constexpr double leastTurnCosine = 0.2588;  // 75°
constexpr double sliverQuality = 0.02;      // twice the area / sum of squared edges; 0.29 for an equilateral triangle

// How the face with the corners a, b and c takes a moving to `target`.
Fit judgeMovedFace(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& target) {
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

}  // namespace

const std::string& ShapeModule::name() const {
    static const std::string text = "shape";
    return text;
}

float ShapeModule::collapse_priority(const CollapseInfo& collapse) {
    const bool allowed = keepsTopology(collapse.v0v1) && judge(collapse.v0v1) < Fit::bad;
    return static_cast<float>(allowed ? LEGAL_COLLAPSE : ILLEGAL_COLLAPSE);
}

bool ShapeModule::keepsTopology(HalfedgeHandle along) {
    SurfaceMesh& surface = mesh();
    if (!surface.is_collapse_ok(along)) return false;
    const VertexHandle from = surface.from_vertex_handle(along);
    const VertexHandle to = surface.to_vertex_handle(along);
    std::size_t edgesBetween = 0;
    std::size_t valence = 0;
    forEachSpoke(surface, from, [&](HalfedgeHandle spoke) {
        ++valence;
        if (surface.to_vertex_handle(spoke) == to) ++edgesBetween;
    });
    if (edgesBetween != 1) return false;
    // A tetrahedron, or a tip like one's.
    const bool inside = !surface.is_boundary(from) && !surface.is_boundary(to);
    return !(inside && valence == 3 && surface.valence(to) == 3);
}

Fit ShapeModule::judge(HalfedgeHandle along) {
    const SurfaceMesh& surface = mesh();
    const HalfedgeHandle back = surface.opposite_halfedge_handle(along);
    const VertexHandle from = surface.to_vertex_handle(back);
    const bool leavesBorder = surface.is_boundary(from) && !surface.is_boundary(along) && !surface.is_boundary(back);
    Fit worst = leavesBorder ? Fit::poor : Fit::good;
    const glm::dvec3 a = surface.place(from);
    const glm::dvec3 target = surface.place(surface.to_vertex_handle(along));
    forEachSpoke(surface, from, [&](HalfedgeHandle spoke) {
        const FaceHandle face = surface.face_handle(spoke);
        __builtin_prefetch(&surface.data(surface.to_vertex_handle(spoke)));  // it is priced anew after a collapse
        if (worst == Fit::bad || !face.is_valid()) return;
        if (face == surface.face_handle(along) || face == surface.face_handle(back)) return;
        const glm::dvec3 b = surface.place(surface.to_vertex_handle(spoke));
        const glm::dvec3 c = surface.place(surface.to_vertex_handle(surface.next_halfedge_handle(spoke)));
        worst = std::max(worst, judgeMovedFace(a, b, c, target));
    });
    return worst;
}

}  // namespace defocus
