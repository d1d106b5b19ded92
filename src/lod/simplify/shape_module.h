#pragma once
// Which collapses the surface allows: Dey, Edelsbrunner, Guha and Nekhayev 1999, Topology Preserving Edge Contraction
// (the link condition, which is OpenMesh's is_collapse_ok), and what they do to the faces around. A decimater module
// that lets through what is neither impossible nor bad.

#include <string>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus {

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

}  // namespace defocus
