#pragma once
// Judges one collapse along a half-edge: whether the surface allows it, what becomes of its wedges, and what it costs.
// Each of the three is a module of OpenMesh's decimater.

#include <span>
#include <string>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus::engine {

// Says which collapses the surface allows, and what they do to the faces around. The link condition is that of Dey,
// Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction (OpenMesh's is_collapse_ok). As a
// decimater module, it lets collapses through that are neither impossible nor bad.
class ShapeModule final : public CollapseModule {
public:
    explicit ShapeModule(SurfaceMesh& surface);

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;

    // Returns whether the collapse keeps the topology: OpenMesh's conditions hold, no second edge joins the two
    // vertices, and no two faces are left back to back.
    [[nodiscard]] bool keepsTopology(HalfedgeHandle along);
    // Judges what the collapse does to the faces that stay, and doesn't look at the topology. Poor: it makes a sliver,
    // or draws the surface away from its border. Bad: it turns a face's normal by more than 75°, or leaves a face no
    // area. Impossible: one of the vertices around the edge has more than 8,192 spokes.
    [[nodiscard]] Fit judge(HalfedgeHandle along);

private:
    [[nodiscard]] bool besideHub(HalfedgeHandle along);

    std::vector<VertexHandle> hubs_;  // with so many spokes that no edge of their faces collapses
};

// A corner of a face that stays, and the wedge of the survivor that it takes over.
struct Handover {
    HalfedgeHandle corner;
    WedgeNumber wedge;
};

// How a half-edge collapse hands wedges over (Hoppe 1998, Efficient Implementation of Progressive Meshes): each corner
// of the vertex that goes takes over a wedge of the survivor. As a decimater module, it lets collapses through that
// aren't bad.
class WedgeModule final : public CollapseModule {
public:
    explicit WedgeModule(SurfaceMesh& surface) : CollapseModule(surface, true) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Gives each corner its new wedge, and the new wedges what the quadrics of the old ones hold.
    void preprocess_collapse(const CollapseInfo& collapse) override;
    // In the face beyond an edge that went, a half-edge of the removed face takes the place of the one that went. It
    // gets that one's wedge.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // Picks a wedge of the survivor for every corner of the vertex that goes whose face stays: the one across the edge
    // on the same side of any seam, else the most similar of its primitive.
    //   poor: its texture would be stretched (a seam would be left); bad: it belongs to another primitive.
    Fit judge(HalfedgeHandle along);
    // Returns the wedges picked by the last judge(); empty once they have been handed over.
    [[nodiscard]] std::span<const Handover> handovers() const { return handovers_; }

private:
    std::vector<Handover> handovers_;
    HalfedgeHandle judged_;  // the half-edge that `handovers_` belong to
};

// Computes what a collapse costs: the quadric errors that both vertices have at the survivor, of places (Garland and
// Heckbert 1997) and of attributes (Hoppe 1999), plus a little for the length of the edge. As a decimater module, it
// has the cost as priority.
class QuadricModule final : public CollapseModule {
public:
    explicit QuadricModule(SurfaceMesh& surface) : CollapseModule(surface, false) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Adds the place quadric of the vertex that is gone to the survivor's. The wedges' go with WedgeModule.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // Returns the cost of collapsing along a half-edge, ≥ 0. If the cost is `most` or more, the result may be any value
    // from `most` to the cost.
    [[nodiscard]] float cost(HalfedgeHandle along, float max);
    // Returns the vertex's cheapest collapse, whether it is allowed or not; of equally cheap ones, the first.
    [[nodiscard]] Candidate cheapest(VertexHandle v);

private:
    std::vector<HalfedgeHandle> spokes_;  // scratch of cheapest()
};

// The modules that judge and price each collapse of a surface, and update its wedges and quadrics.
struct CollapseModules {
    explicit CollapseModules(SurfaceMesh& mesh) : shape(mesh), wedges(mesh), quadrics(mesh) {}

    ShapeModule shape;
    WedgeModule wedges;
    QuadricModule quadrics;
};

}  // namespace defocus::engine
