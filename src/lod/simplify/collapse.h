#pragma once
// One collapse along a half-edge: whether the surface allows it, what becomes of its wedges, and what it costs. Each is
// a module of OpenMesh's decimater.

#include <span>
#include <string>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus {

// Which collapses the surface allows: Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction
// (the link condition, which is OpenMesh's is_collapse_ok), and what they do to the faces around. A decimater module
// that lets through what is neither impossible nor bad.
class ShapeModule final : public CollapseModule {
public:
    explicit ShapeModule(SurfaceMesh& surface) : CollapseModule(surface, true) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;

    // Whether the collapse leaves the surface as it is but for its faces: OpenMesh's conditions, no second edge between
    // the two vertices, and no two faces left back to back.
    [[nodiscard]] bool keepsTopology(HalfedgeHandle along);
    // How the faces that stay take a collapse that keeps the topology. Poor: it makes a sliver, or draws the surface
    // away from its border. Bad: it turns a face's normal by more than 75°, or leaves a face no area.
    [[nodiscard]] Fit judge(HalfedgeHandle along);
};

// A corner of a face that stays, and the wedge of the survivor that it takes over.
struct Handover {
    HalfedgeHandle corner;
    WedgeNumber wedge;
};

// How a half-edge collapse hands wedges over (Hoppe 1998, Efficient Implementation of Progressive Meshes): each corner
// of the vertex that goes takes over a wedge of the survivor. A decimater module that lets through what isn't bad.
class WedgeModule final : public CollapseModule {
public:
    explicit WedgeModule(SurfaceMesh& surface) : CollapseModule(surface, true) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Gives each corner its new wedge, and the new wedges what the quadrics of the old ones hold.
    void preprocess_collapse(const CollapseInfo& collapse) override;
    // Half-edges of the faces that went take the place of those whose edges went: their corners get the same wedges.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // Picks a wedge of the survivor for every corner of the vertex that goes whose face stays: the one across the edge
    // on the same side of any seam, else the most similar of its primitive.
    //   poor: its texture would be stretched (a seam would be left); bad: it belongs to another primitive.
    Fit judge(HalfedgeHandle along);
    // What was picked last; empty once it has been handed over.
    [[nodiscard]] std::span<const Handover> handovers() const { return handovers_; }

private:
    std::vector<Handover> handovers_;
    HalfedgeHandle judged_;  // what `handovers_` are for
};

// What collapses cost: quadric errors of places (Garland and Heckbert 1997) and of attributes (Hoppe 1999) of both
// vertices at the survivor, plus what edge length weighs. A decimater module, whose priority is the cost.
class QuadricModule final : public CollapseModule {
public:
    explicit QuadricModule(SurfaceMesh& surface) : CollapseModule(surface, false) {}

    [[nodiscard]] const std::string& name() const override;
    float collapse_priority(const CollapseInfo& collapse) override;
    // Adds the place quadric of the vertex that is gone to the survivor's. The wedges' go with WedgeModule.
    void postprocess_collapse(const CollapseInfo& collapse) override;

    // The cost of collapsing along a half-edge, ≥ 0; somewhere between `most` and the cost where that is larger.
    [[nodiscard]] float cost(HalfedgeHandle along, float most);
    // The vertex's cheapest collapse, whether it is allowed or not; the first of equals.
    [[nodiscard]] Candidate cheapest(VertexHandle v);

private:
    std::vector<HalfedgeHandle> spokes_;  // scratch of cheapest()
};

// What judges, prices and follows each collapse of a surface.
struct CollapseModules {
    explicit CollapseModules(SurfaceMesh& mesh) : shape(mesh), wedges(mesh), quadrics(mesh) {}

    ShapeModule shape;
    WedgeModule wedges;
    QuadricModule quadrics;
};

}  // namespace defocus
