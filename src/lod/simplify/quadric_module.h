#pragma once
// What collapses cost: quadric errors of places (Garland and Heckbert 1997) and of attributes (Hoppe 1999) of both
// vertices at the survivor, plus what edge length weighs. A decimater module, whose priority is the cost.

#include <string>

#include "lod/simplify/surface_mesh.h"

namespace defocus {

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

}  // namespace defocus
