// What collapses are allowed: Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction (link
// condition).

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

#include "lod/simplify/state.h"

namespace defocus {

namespace {

constexpr double leastTurnCosine = 0.2588;  // 75°
constexpr double sliverQuality = 0.02;      // twice the area / sum of squared edges; 0.29 for an equilateral triangle

// All of what the collapse adds up.
void prefetchWedges(const Simplifier& s, std::uint32_t halfEdge) {
    if (halfEdge == Corner::none) return;
    for (const std::uint32_t corner : {halfEdge, nextCorner(halfEdge)}) {
        const std::uint32_t wedge = s.faces.corners[corner].wedge;
        prefetch(&s.faces.wedges[wedge]);
        const auto* const bytes = reinterpret_cast<const std::byte*>(&s.attributeQuadrics[wedge]);
        for (std::size_t i = 0; i < sizeof(AttributeQuadric); i += 64) prefetch(bytes + i);
    }
}

// How the face at `corner` takes that corner moving to `target`.
Fit judgeMovedFace(const Simplifier& s, std::uint32_t corner, const glm::dvec3& target) {
    const glm::dvec3 a = s.point(s.faces.corners[corner].vertex);
    const glm::dvec3 b = s.point(s.faces.corners[nextCorner(corner)].vertex);
    const glm::dvec3 c = s.point(s.faces.corners[previousCorner(corner)].vertex);
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

bool isOnBorder(const Simplifier& s, std::uint32_t v) {
    return s.faces.corners[s.vertices[v].corner].twin == Corner::none;
}

// The third vertex of the half-edge's face, none if there is none.
std::uint32_t apex(const Simplifier& s, std::uint32_t halfEdge) {
    return halfEdge == Corner::none ? Corner::none : s.faces.corners[previousCorner(halfEdge)].vertex;
}

// The half-edge's face hangs on by this edge alone.
bool isFlap(const Simplifier& s, std::uint32_t halfEdge) {
    if (halfEdge == Corner::none) return false;
    return s.faces.corners[nextCorner(halfEdge)].twin == Corner::none &&
           s.faces.corners[previousCorner(halfEdge)].twin == Corner::none;
}

// The link condition: the edge's vertices have no neighbours in common but those of its faces (and no second edge), a
// border is left by no edge but its own, and what would become two faces back to back stays. Sets `s.edge`; leaves the
// corners at both in `s.cornersFrom` and `s.cornersTo`.
bool keepsTopology(Simplifier& s, std::uint32_t from, std::uint32_t to) {
    s.spokes.clear();
    s.cornersFrom.clear();
    s.cornersTo.clear();
    std::size_t edgesBetween = 0;
    forEachEdgeAround(s, from, [&](const Edge& edge, std::uint32_t neighbour) {
        prefetch(&s.candidates[neighbour]);
        if (edge.along != Corner::none) s.cornersFrom.push_back(edge.along);
        s.spokes.push_back({edge, neighbour});
        if (neighbour != to) return;
        s.edge = edge;
        ++edgesBetween;
    });
    if (edgesBetween != 1) return false;
    prefetchWedges(s, s.edge.along);
    prefetchWedges(s, s.edge.back);
    const std::uint32_t left = apex(s, s.edge.along);
    const std::uint32_t right = apex(s, s.edge.back);
    const bool fromBorder = isOnBorder(s, from);
    const bool toBorder = isOnBorder(s, to);
    if (left == right || isFlap(s, s.edge.along) || isFlap(s, s.edge.back)) return false;
    if (left != Corner::none && right != Corner::none && fromBorder && toBorder) return false;

    ++s.markNumber;
    for (const Spoke& spoke : s.spokes)
        if (spoke.to != left && spoke.to != right) s.vertices[spoke.to].mark = s.markNumber;
    bool shared = false;
    std::size_t valenceTo = 0;
    forEachEdgeAround(s, to, [&](const Edge& edge, std::uint32_t neighbour) {
        prefetch(&s.candidates[neighbour]);
        shared = shared || s.vertices[neighbour].mark == s.markNumber;
        if (edge.along != Corner::none) s.cornersTo.push_back(edge.along);
        ++valenceTo;
    });
    const bool inside = !fromBorder && !toBorder;
    return !shared && !(inside && s.spokes.size() == 3 && valenceTo == 3);
}

}  // namespace

Fit judgeCollapse(Simplifier& s, std::uint32_t from, std::uint32_t to) {
    if (!keepsTopology(s, from, to)) return Fit::impossible;
    const WedgeQuestion question{s.edge, s.cornersFrom, s.cornersTo, glm::length(s.step(from, to))};
    Fit worst = retargetWedges(s.faces, question, s.retargets);

    const bool alongBorder = s.edge.along == Corner::none || s.edge.back == Corner::none;
    if (isOnBorder(s, from) && !alongBorder) worst = std::max(worst, Fit::poor);
    const glm::dvec3 target = s.point(to);
    for (const Retarget& retarget : s.retargets) worst = std::max(worst, judgeMovedFace(s, retarget.corner, target));
    return worst;
}

}  // namespace defocus
