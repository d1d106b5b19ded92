// Evaluates the effects of collapses on faces, wedges (vertices at face corners) and quadrics; performs collapses and
// removes deleted elements.

#include "lod/simplify/collapse.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/memory.h"
#include "lod/simplify/state.h"

namespace defocus::engine {

namespace {

constexpr double minTurnCosine = 0.2588;  // cosine of 75°, the max rotation of a face's normal
// Max quality of a sliver: twice its area / sum of its squared edge lengths. An equilateral triangle has 0.29.
constexpr double sliverQuality = 0.02;

// Returns the class (good, poor or bad) of a collapse that moves corner a of the face with corners a, b and c to
// `target`.
Fit judgeMovedFace(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& target) {
    const glm::dvec3 before = glm::cross(b - a, c - a);
    const glm::dvec3 after = glm::cross(b - target, c - target);
    const double squareBefore = glm::dot(before, before);
    const double squareAfter = glm::dot(after, after);
    const double along = glm::dot(before, after);
    if (!(squareAfter > 0) || along < 0) return Fit::bad;
    if (along * along < minTurnCosine * minTurnCosine * squareBefore * squareAfter) return Fit::bad;
    const auto edges = [&](const glm::dvec3& p) {
        return glm::dot(b - p, b - p) + glm::dot(c - p, c - p) + glm::dot(c - b, c - b);
    };
    // The quality of a triangle is twice its area divided by the sum of its squared edge lengths. Compare squares of
    // qualities to avoid square roots.
    const double edgesAfter = edges(target);
    if (!(squareAfter < sliverQuality * sliverQuality * edgesAfter * edgesAfter)) return Fit::good;
    const double edgesBefore = edges(a);
    return squareAfter * edgesBefore * edgesBefore < squareBefore * edgesAfter * edgesAfter ? Fit::poor : Fit::good;
}

// An edge is assumed to cross a texture seam if its texture coordinates change by more than this multiple of the
// expected change. The expected change follows from the edge's length and the mesh's average texture scale.
constexpr double longestUvStep = 4;

// One side of the collapsing edge: its face (if any), and the wedges (attributes) of the removed and of the surviving
// vertex in this face.
struct EdgeSide {
    FaceHandle face = FaceHandle();
    WedgeNumber from;
    WedgeNumber to;
};

struct Sides {
    const SurfaceMesh& mesh;
    VertexHandle survivor;
    double longestStep = 0;  // max squared change of texture coordinates within a chart; a larger change crosses a seam
    EdgeSide both[2];

    [[nodiscard]] bool jumps(WedgeNumber from, WedgeNumber to) const {
        return mesh.wedges.uvDifference(from, to) > longestStep;
    }
};

Sides sidesOf(const SurfaceMesh& mesh, HalfedgeHandle along) {
    const HalfedgeHandle back = mesh.opposite_halfedge_handle(along);
    const VertexHandle survivor = mesh.to_vertex_handle(along);
    const glm::dvec3 step = mesh.step(mesh.to_vertex_handle(back), survivor);
    Sides sides{mesh, survivor, longestUvStep * longestUvStep * glm::dot(step, step), {}};
    if (!mesh.is_boundary(along))
        sides.both[0] = {mesh.face_handle(along), mesh.wedge(along), mesh.wedge(mesh.next_halfedge_handle(along))};
    if (!mesh.is_boundary(back))
        sides.both[1] = {mesh.face_handle(back), mesh.wedge(mesh.next_halfedge_handle(back)), mesh.wedge(back)};
    return sides;
}

// Returns the surviving vertex's wedge that is most similar to `wedge`, among those for which admitted(face, wedge) is
// true. Returns an invalid number if there is none.
template <typename Admitted>
WedgeNumber nearestWedge(const Sides& sides, WedgeNumber wedge, const Admitted& admitted) {
    WedgeNumber nearest;
    double min = std::numeric_limits<double>::infinity();
    forEachSpoke(sides.mesh, sides.survivor, [&](HalfedgeHandle corner) {
        const FaceHandle face = sides.mesh.face_handle(corner);
        const WedgeNumber candidate = sides.mesh.wedge(corner);
        if (!face.is_valid() || candidate == nearest || !admitted(face, candidate)) return;
        const double distance = sides.mesh.wedges.difference(wedge, candidate);
        if (nearest.isValid() && !(distance < min)) return;
        nearest = candidate;
        min = distance;
    });
    return nearest;
}

struct Choice {
    WedgeNumber wedge;
    Fit fit = Fit::good;
};

Choice chooseWedge(const Sides& sides, WedgeNumber wedge, PrimitiveNumber primitive) {
    const WedgeTable& wedges = sides.mesh.wedges;
    const auto inPrimitive = [&](FaceHandle face, WedgeNumber) { return sides.mesh.primitive(face) == primitive; };

    // The surviving vertex's wedge (attributes) in a face at the collapsing edge. The removed vertex's wedge in this
    // face differs from `wedge` at most in its normal, so that no seam separates them.
    WedgeNumber across;
    // Like `across`, but the removed vertex's wedge in the face equals `wedge`, so that not even a crease separates
    // them.
    WedgeNumber exact;
    bool torn = false;     // at the surviving vertex, a seam separates the two faces
    bool creased = false;  // at the surviving vertex, a crease separates the two faces
    for (const EdgeSide& side : sides.both) {
        if (!side.face.is_valid() || sides.mesh.primitive(side.face) != primitive) continue;
        if (!wedges.sameChart(side.from, wedge)) continue;
        torn = torn || (across.isValid() && !wedges.sameChart(across, side.to));
        across = side.to;
        if (side.from != wedge) continue;
        creased = creased || (exact.isValid() && exact != side.to);
        exact = side.to;
    }
    if (across.isValid() && !torn) {
        if (exact.isValid() && !creased) return {exact, Fit::good};
        const auto inChart = [&](FaceHandle face, WedgeNumber candidate) {
            return inPrimitive(face, candidate) && wedges.sameChart(candidate, across);
        };
        return {nearestWedge(sides, wedge, inChart), Fit::good};
    }

    // Either a seam ends at the surviving vertex, or seams and material borders separate the corner from both faces at
    // the collapsing edge. Use the most similar wedge of the same primitive. The collapse is poor if this wedge is far
    // from the corner's wedge in texture space. If a seam ends here, the collapse is also poor if the surviving
    // vertex's wedge in either face is far from the corner's wedge.
    const WedgeNumber nearest = nearestWedge(sides, wedge, inPrimitive);
    if (nearest.isValid()) {
        bool leaves = sides.jumps(wedge, nearest);
        for (const EdgeSide& side : sides.both)
            leaves = leaves || (torn && side.face.is_valid() && sides.jumps(wedge, side.to));
        return {nearest, leaves ? Fit::poor : Fit::good};
    }
    return {nearestWedge(sides, wedge, [](FaceHandle, WedgeNumber) { return true; }), Fit::bad};
}

// Weight of the squared edge length relative to squared distances to planes. In flat regions, collapses differ only in
// this term, which favours well-shaped triangles.
constexpr float edgeWeight = 1e-4f;

// Max number of half-edges at any vertex of the faces beside a collapsing edge. OpenMesh's collapse searches for
// borders around all four vertices of these faces. For the hub of a fan of triangles, this would take time quadratic in
// the number of faces.
constexpr std::size_t maxSpokes = 8192;

// Returns whether the half-edge borders a triangular hole. If a second edge joins two corners of such a hole, OpenMesh
// allows the collapse. It would close the hole and leave a face with two corners, or a half-edge without attributes
// (wedge).
bool isAtHoleOfThree(const SurfaceMesh& surface, HalfedgeHandle e) {
    const HalfedgeHandle second = surface.next_halfedge_handle(e);
    return surface.is_boundary(e) && surface.next_halfedge_handle(surface.next_halfedge_handle(second)) == e;
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

ShapeModule::ShapeModule(SurfaceMesh& surface) : CollapseModule(surface, true) {
    for (const VertexHandle v : surface.vertices()) {
        if (!surface.halfedge_handle(v).is_valid()) continue;
        std::size_t spokes = 0;
        forEachSpoke(surface, v, [&](HalfedgeHandle) { ++spokes; });
        if (spokes > maxSpokes) hubs_.push_back(v);
    }
}

bool ShapeModule::besideHub(HalfedgeHandle along) {
    const SurfaceMesh& surface = mesh();
    const HalfedgeHandle back = surface.opposite_halfedge_handle(along);
    return std::ranges::any_of(hubs_, [&](VertexHandle hub) {
        return hub == surface.to_vertex_handle(along) || hub == surface.to_vertex_handle(back) ||
               hub == surface.to_vertex_handle(surface.next_halfedge_handle(along)) ||
               hub == surface.to_vertex_handle(surface.next_halfedge_handle(back));
    });
}

bool ShapeModule::keepsTopology(HalfedgeHandle along) {
    SurfaceMesh& surface = mesh();
    if (!surface.is_collapse_ok(along)) return false;
    if (isAtHoleOfThree(surface, along) || isAtHoleOfThree(surface, surface.opposite_halfedge_handle(along)))
        return false;
    const VertexHandle from = surface.from_vertex_handle(along);
    const VertexHandle to = surface.to_vertex_handle(along);
    std::size_t edgesBetween = 0;
    std::size_t valence = 0;
    forEachSpoke(surface, from, [&](HalfedgeHandle spoke) {
        ++valence;
        if (surface.to_vertex_handle(spoke) == to) ++edgesBetween;
    });
    if (edgesBetween != 1) return false;
    // Reject a collapse between two interior vertices with three faces each, which would leave two faces back to back.
    const bool inside = !surface.is_boundary(from) && !surface.is_boundary(to);
    return !(inside && valence == 3 && surface.valence(to) == 3);
}

Fit ShapeModule::judge(HalfedgeHandle along) {
    if (besideHub(along)) return Fit::impossible;
    const SurfaceMesh& surface = mesh();
    const HalfedgeHandle back = surface.opposite_halfedge_handle(along);
    const VertexHandle from = surface.to_vertex_handle(back);
    const bool leavesBorder = surface.is_boundary(from) && !surface.is_boundary(along) && !surface.is_boundary(back);
    Fit worst = leavesBorder ? Fit::poor : Fit::good;
    const glm::dvec3 a = surface.place(from);
    const glm::dvec3 target = surface.place(surface.to_vertex_handle(along));
    forEachSpoke(surface, from, [&](HalfedgeHandle spoke) {
        const FaceHandle face = surface.face_handle(spoke);
        __builtin_prefetch(&surface.data(surface.to_vertex_handle(spoke)));  // this vertex's collapse is updated next
        if (worst == Fit::bad || !face.is_valid()) return;
        if (face == surface.face_handle(along) || face == surface.face_handle(back)) return;
        const glm::dvec3 b = surface.place(surface.to_vertex_handle(spoke));
        const glm::dvec3 c = surface.place(surface.to_vertex_handle(surface.next_halfedge_handle(spoke)));
        worst = std::max(worst, judgeMovedFace(a, b, c, target));
    });
    return worst;
}

const std::string& WedgeModule::name() const {
    static const std::string text = "wedges";
    return text;
}

float WedgeModule::collapse_priority(const CollapseInfo& collapse) {
    return static_cast<float>(judge(collapse.v0v1) < Fit::bad ? LEGAL_COLLAPSE : ILLEGAL_COLLAPSE);
}

void WedgeModule::preprocess_collapse(const CollapseInfo& collapse) {
    if (judged_ != collapse.v0v1) judge(collapse.v0v1);
    SurfaceMesh& surface = mesh();
    const glm::vec3 step(surface.step(collapse.v0, collapse.v1));
    for (const Handover& handover : handovers_) {
        WedgeNumber& wedge = surface.data(handover.corner).wedge;
        if (wedge != handover.wedge) surface.wedges.moveQuadric(wedge, handover.wedge, step);
        wedge = handover.wedge;
    }
    handovers_.clear();
    judged_.reset();
}

void WedgeModule::postprocess_collapse(const CollapseInfo& collapse) {
    SurfaceMesh& surface = mesh();
    const auto replace = [&](HalfedgeHandle gone, HalfedgeHandle beside) {
        surface.data(surface.opposite_halfedge_handle(beside)).wedge = surface.wedge(gone);
    };
    if (collapse.fl.is_valid()) replace(collapse.v0vl, collapse.vlv1);
    if (collapse.fr.is_valid()) replace(collapse.vrv0, collapse.v1vr);
}

Fit WedgeModule::judge(HalfedgeHandle along) {
    const SurfaceMesh& surface = mesh();
    handovers_.clear();
    judged_ = along;
    const Sides sides = sidesOf(surface, along);
    for (const EdgeSide& side : sides.both) {
        if (!side.face.is_valid()) continue;
        surface.wedges.prefetch(side.from);  // moveQuadric() needs this wedge if the collapse is performed
        surface.wedges.prefetch(side.to);
    }
    Fit worst = Fit::good;
    Choice choice;
    WedgeNumber lastWedge;
    PrimitiveNumber lastPrimitive;
    forEachSpoke(surface, surface.from_vertex_handle(along), [&](HalfedgeHandle corner) {
        const FaceHandle face = surface.face_handle(corner);
        if (!face.is_valid() || face == sides.both[0].face || face == sides.both[1].face) return;
        const WedgeNumber wedge = surface.wedge(corner);
        const PrimitiveNumber primitive = surface.primitive(face);
        if (wedge != lastWedge || primitive != lastPrimitive) choice = chooseWedge(sides, wedge, primitive);
        lastWedge = wedge;
        lastPrimitive = primitive;
        worst = std::max(worst, choice.fit);
        handovers_.push_back({corner, choice.wedge});
    });
    return worst;
}

const std::string& QuadricModule::name() const {
    static const std::string text = "places and attributes";
    return text;
}

float QuadricModule::collapse_priority(const CollapseInfo& collapse) {
    return cost(collapse.v0v1, std::numeric_limits<float>::infinity());
}

void QuadricModule::postprocess_collapse(const CollapseInfo& collapse) {
    const glm::vec3 step(mesh().step(collapse.v0, collapse.v1));
    mesh().data(collapse.v1).quadric.add(mesh().data(collapse.v0).quadric, step);
}

float QuadricModule::cost(HalfedgeHandle along, float max) {
    const SurfaceMesh& surface = mesh();
    const HalfedgeHandle back = surface.opposite_halfedge_handle(along);
    const VertexHandle from = surface.to_vertex_handle(back);
    const VertexHandle to = surface.to_vertex_handle(along);
    const glm::vec3 step(surface.step(from, to));
    const Quadric& own = surface.data(from).quadric;
    float sum = own.at(step) + surface.data(to).quadric.c + own.weight * edgeWeight * glm::dot(step, step);
    if (!(sum < max)) return sum;

    // Add the attribute costs of both sides of the edge. Without a seam or crease, both sides have the same two wedges,
    // whose cost counts once.
    WedgeNumber leftFrom, leftTo;
    if (!surface.is_boundary(along)) {
        leftFrom = surface.wedge(along);
        leftTo = surface.wedge(surface.next_halfedge_handle(along));
        sum += surface.wedges.cost(leftFrom, leftTo, step);
    }
    if (surface.is_boundary(back) || !(sum < max)) return sum;
    const WedgeNumber rightFrom = surface.wedge(surface.next_halfedge_handle(back));
    const WedgeNumber rightTo = surface.wedge(back);
    if (rightFrom == leftFrom && rightTo == leftTo) return sum;
    return sum + surface.wedges.cost(rightFrom, rightTo, step);
}

Candidate QuadricModule::cheapest(VertexHandle v) {
    // Prefetch the data of all neighbours first. Successive collapses are far apart in the mesh, so their data is
    // rarely cached.
    const SurfaceMesh& surface = mesh();
    spokes_.clear();
    forEachSpoke(surface, v, [&](HalfedgeHandle spoke) {
        const VertexHandle to = surface.to_vertex_handle(spoke);
        __builtin_prefetch(&surface.data(to));
        const HalfedgeHandle atTo =
            surface.is_boundary(spoke) ? surface.opposite_halfedge_handle(spoke) : surface.next_halfedge_handle(spoke);
        surface.wedges.prefetchStart(surface.wedge(atTo));
        spokes_.push_back(spoke);
    });
    Candidate best;
    for (const HalfedgeHandle spoke : spokes_) {
        const float price = cost(spoke, best.cost);
        if (!(price < best.cost)) continue;
        best.along = spoke;
        best.cost = price;
    }
    return best;
}

Fit judgeFaces(Simplifier& s, HalfedgeHandle along) {
    const Fit shape = s.modules->shape.judge(along);
    return shape >= Fit::bad ? shape : std::max(shape, s.modules->wedges.judge(along));
}

Fit judgeCollapse(Simplifier& s, HalfedgeHandle along, Fit worst) {
    const Fit fit = judgeFaces(s, along);
    return fit <= worst && !s.modules->shape.keepsTopology(along) ? Fit::impossible : fit;
}

void collapseEdge(Simplifier& s, HalfedgeHandle along) {
    const CollapseInfo collapse(*s.mesh, along);
    s.modules->wedges.preprocess_collapse(collapse);
    s.mesh->collapse(along);
    s.modules->wedges.postprocess_collapse(collapse);
    s.modules->quadrics.postprocess_collapse(collapse);
    s.survivor(collapse.v0) = collapse.v1;
}

VertexHandle survivorOf(Simplifier& s, VertexHandle v) {
    while (v.is_valid() && s.survivor(v) != v) {
        const VertexHandle next = s.survivor(v);
        if (next.is_valid()) s.survivor(v) = s.survivor(next);
        v = next;
    }
    return v;
}

void compact(Simplifier& s) {
    Numbered<VertexHandle, VertexHandle> numbers;
    std::unique_ptr<SurfaceMesh> living = livingCopy(*s.mesh, numbers);
    for (VertexHandle& v : s.current)
        if (v = survivorOf(s, v); v.is_valid()) v = numbers[v];
    s.modules.reset();
    s.mesh = std::move(living);
    s.modules.emplace(*s.mesh);
    if (numbers.size() >= fewestToGiveBack) giveBackFreedMemory();
    s.survivors.resize(s.mesh->n_vertices());
    s.survivors.shrink_to_fit();
    for (const VertexHandle v : s.survivors.numbers()) s.survivors[v] = v;
}

}  // namespace defocus::engine
