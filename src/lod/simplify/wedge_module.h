#pragma once
// How a half-edge collapse hands wedges over (Hoppe 1998, Efficient Implementation of Progressive Meshes): each corner
// of the vertex that goes takes over a wedge of the survivor. A decimater module that lets through what isn't bad.

#include <span>
#include <string>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus {

// A corner of a face that stays, and the wedge of the survivor that it takes over.
struct Handover {
    HalfedgeHandle corner;
    WedgeNumber wedge;
};

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

}  // namespace defocus
