#include "lod/simplify/quadric_module.h"

#include <glm/geometric.hpp>

namespace defocus {

namespace {

// Squared edge length that weighs as much as a squared distance: decides on flat ground, where it favours even
// triangles.
constexpr float edgeWeight = 1e-4f;

}  // namespace

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

float QuadricModule::cost(HalfedgeHandle along, float most) {
    const SurfaceMesh& surface = mesh();
    const HalfedgeHandle back = surface.opposite_halfedge_handle(along);
    const VertexHandle from = surface.to_vertex_handle(back);
    const VertexHandle to = surface.to_vertex_handle(along);
    const glm::vec3 step(surface.step(from, to));
    const Quadric& own = surface.data(from).quadric;
    float sum = own.at(step) + surface.data(to).quadric.c + own.weight * edgeWeight * glm::dot(step, step);
    if (!(sum < most)) return sum;

    // Attributes on either side of the edge, once where they are the same.
    WedgeNumber leftFrom, leftTo;
    if (!surface.is_boundary(along)) {
        leftFrom = surface.wedge(along);
        leftTo = surface.wedge(surface.next_halfedge_handle(along));
        sum += surface.wedges.cost(leftFrom, leftTo, step);
    }
    if (surface.is_boundary(back) || !(sum < most)) return sum;
    const WedgeNumber rightFrom = surface.wedge(surface.next_halfedge_handle(back));
    const WedgeNumber rightTo = surface.wedge(back);
    if (rightFrom == leftFrom && rightTo == leftTo) return sum;
    return sum + surface.wedges.cost(rightFrom, rightTo, step);
}

Candidate QuadricModule::cheapest(VertexHandle v) {
    // Ask for everything before the first is needed: collapses come from all over the mesh.
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

}  // namespace defocus
