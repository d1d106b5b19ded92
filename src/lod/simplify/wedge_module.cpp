#include "lod/simplify/wedge_module.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace defocus {

namespace {

// Texture space may be this much denser than on the mesh's average before a step through it counts as a jump over a
// seam.
constexpr double longestUvStep = 4;

// One side of the edge that collapses: its face (or none) and the wedges of the vertex that goes and the one that
// stays.
struct EdgeSide {
    FaceHandle face = FaceHandle();
    WedgeNumber from;
    WedgeNumber to;
};

struct Sides {
    const SurfaceMesh& mesh;
    VertexHandle survivor;
    double longestStep = 0;  // in texture space, squared; more is a jump
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

// The wedge of the survivor that is most like `wedge`, among those that `admitted(face, wedge)` lets in; none if there
// is none.
template <typename Admitted>
WedgeNumber nearestWedge(const Sides& sides, WedgeNumber wedge, const Admitted& admitted) {
    WedgeNumber nearest;
    double least = std::numeric_limits<double>::infinity();
    forEachSpoke(sides.mesh, sides.survivor, [&](HalfedgeHandle corner) {
        const FaceHandle face = sides.mesh.face_handle(corner);
        const WedgeNumber candidate = sides.mesh.wedge(corner);
        if (!face.is_valid() || candidate == nearest || !admitted(face, candidate)) return;
        const double distance = sides.mesh.wedges.difference(wedge, candidate);
        if (nearest.isValid() && !(distance < least)) return;
        nearest = candidate;
        least = distance;
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

    // The survivor's wedges across the edge in the corner's chart. `exact` is on the same side of every crease as well.
    WedgeNumber across;
    WedgeNumber exact;
    bool torn = false;     // a seam lies across the edge at the survivor
    bool creased = false;  // a crease does
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

    // A seam ends here (it lies across the edge) or begins (the corner's chart isn't at the edge): take what is most
    // similar, if it is near enough in texture.
    const WedgeNumber nearest = nearestWedge(sides, wedge, inPrimitive);
    if (nearest.isValid()) {
        bool leaves = sides.jumps(wedge, nearest);
        for (const EdgeSide& side : sides.both)
            leaves = leaves || (torn && side.face.is_valid() && sides.jumps(wedge, side.to));
        return {nearest, leaves ? Fit::poor : Fit::good};
    }
    return {nearestWedge(sides, wedge, [](FaceHandle, WedgeNumber) { return true; }), Fit::bad};
}

}  // namespace

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
        surface.wedges.prefetch(side.from);  // the collapse that may follow adds them up
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

}  // namespace defocus
