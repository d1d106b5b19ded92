#pragma once
// Evaluates a half-edge collapse: its effect on the faces, its effect on the wedges (vertices at face corners,
// wedges.h), and its cost. Each of the three is computed by a module of OpenMesh's decimater.

#include <string>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus::engine {

// Decides whether the topology allows a collapse, and classifies the effect on surrounding faces. The topology test is
// the link condition, OpenMesh's is_collapse_ok (Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge
// Contraction). As a decimater module, it accepts the collapses that simplify.h defines as good or poor.
class ShapeModule final : public CollapseModule {
public:
    explicit ShapeModule(SurfaceMesh& surface);

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;

    // Returns whether the collapse preserves the topology: OpenMesh's conditions hold, only one edge joins the two
    // vertices, and no two faces end up back to back.
    [[nodiscard]] bool keepsTopology(HalfedgeHandle along);
    // Returns the class of the collapse by its effect on the remaining faces, ignoring the topology. Poor: the collapse
    // makes a sliver, or pulls the surface away from its border. Bad: the collapse rotates a face's normal by more than
    // 75° or makes a face degenerate. Impossible: a vertex of the faces beside the edge has more than 8,192 outgoing
    // half-edges.
    [[nodiscard]] Fit judge(HalfedgeHandle along);

private:
    [[nodiscard]] bool besideHub(HalfedgeHandle along);

    std::vector<VertexHandle> hubs_;  // vertices with more than 8,192 half-edges; no edge of their faces may collapse
};

// A corner of a remaining face, and the surviving vertex's wedge (attributes) that this corner receives.
struct Handover {
    HalfedgeHandle corner;
    WedgeNumber wedge;
};

// Transfers wedges (vertices at face corners) in a half-edge collapse, as in Hoppe 1998, Efficient Implementation of
// Progressive Meshes. Each remaining corner of the removed vertex receives a wedge of the surviving vertex. As a
// decimater module, it accepts the collapses that simplify.h defines as good or poor.
class WedgeModule final : public CollapseModule {
public:
    explicit WedgeModule(SurfaceMesh& surface) : CollapseModule(surface, true) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Assigns each corner of the removed vertex its new wedge, and adds the quadrics of the old wedges to the quadrics
    // of the new wedges.
    void preprocess_collapse(const CollapseInfo& collapse) override;
    // Copies wedges after the collapse. Where OpenMesh removes a face, one half-edge of this face takes the place of
    // the neighbouring face's half-edge. It gets the wedge of the half-edge that it replaces.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // Selects a wedge of the surviving vertex for each remaining corner of the removed vertex, and returns the class of
    // the collapse. The first choice is the wedge at the other end of the collapsed edge, on the same side of a seam.
    // The second choice is the most similar wedge of the same primitive. Poor: the texture would be stretched across a
    // seam. Bad: the wedge belongs to another primitive.
    Fit judge(HalfedgeHandle along);

private:
    std::vector<Handover> handovers_;  // the wedge that judge() selected for each corner; empty after the collapse
    HalfedgeHandle judged_;            // half-edge whose collapse judge() evaluated last
};

// Computes the cost of a collapse: the quadric errors of both vertices at the surviving vertex, plus a small term for
// edge length. The quadric errors are position errors (Garland and Heckbert 1997) and attribute errors (Hoppe 1999).
// collapse_priority() returns this cost to OpenMesh's decimater.
class QuadricModule final : public CollapseModule {
public:
    explicit QuadricModule(SurfaceMesh& surface) : CollapseModule(surface, false) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Adds the position quadric of the removed vertex to the quadric of the surviving vertex. WedgeModule does the same
    // for attribute quadrics.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // Returns the cost of collapsing a half-edge, ≥ 0. If the cost is at least `max`, the returned value may be
    // anything between `max` and the cost.
    [[nodiscard]] float cost(HalfedgeHandle along, float max);
    // Returns the vertex's cheapest collapse, whether it is allowed or not; the first collapse in case of a tie.
    [[nodiscard]] Candidate cheapest(VertexHandle v);

private:
    std::vector<HalfedgeHandle> spokes_;  // temporary data of cheapest(): the vertex's half-edges
};

// The modules that evaluate each collapse and its cost, and that update wedges and quadrics after the collapse.
struct CollapseModules {
    explicit CollapseModules(SurfaceMesh& mesh) : shape(mesh), wedges(mesh), quadrics(mesh) {}

    ShapeModule shape;
    WedgeModule wedges;
    QuadricModule quadrics;
};

}  // namespace defocus::engine
