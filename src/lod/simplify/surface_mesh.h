#pragma once
// Defines the surface during simplification: OpenMesh's half-edge structure with the simplifier's data per vertex,
// half-edge and face. Only this header includes OpenMesh; other files use the names defined here.
//
// Faces are oriented consistently with their neighbours. A half-edge also represents the corner of its face at the
// vertex where the half-edge starts. At a border, the half-edges on the outside have no face. The halfedge_handle of a
// border vertex is its outgoing half-edge without a face. Collapses only mark elements as deleted; livingCopy() removes
// them.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/CollapseInfoT.hh>
#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "lod/simplify/manifold.h"
#include "lod/simplify/number.h"
#include "lod/simplify/quadric.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/wedges.h"

namespace defocus::engine {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Maps the mesh to unit size, so that weights are independent of its scale.
struct Frame {
    glm::dvec3 centre{0};  // centre of the mesh's bounding box, object units
    double inverse = 0;    // 1 / longest side of the mesh's bounding box; 0: the mesh has no extent

    // Converts a position from object space to the mesh scaled to unit size.
    [[nodiscard]] glm::dvec3 point(const glm::vec3& position) const {
        return (glm::dvec3(position) - centre) * inverse;
    }
    // Returns the vector from one position to another, in units of the mesh's longest side.
    [[nodiscard]] glm::dvec3 step(const glm::vec3& from, const glm::vec3& to) const {
        return (glm::dvec3(to) - glm::dvec3(from)) * inverse;
    }
};

// Class of a collapse, defined in simplify.h. A bad collapse waits until no good or poor collapse is left.
enum class Fit : std::uint8_t { good, poor, bad, impossible };

// The planned collapse that would remove a vertex.
struct Candidate {
    HalfedgeHandle along;  // leads to the surviving vertex; invalid: no collapse is possible
    float cost = std::numeric_limits<float>::infinity();
    Fit fit = Fit::good;    // class of the collapse by the tests made so far; good before any test
    bool outdated = false;  // the cost has changed, or another collapse may be cheaper

    [[nodiscard]] bool possible() const { return along.is_valid(); }
    [[nodiscard]] bool harmless() const { return possible() && fit < Fit::bad; }
};

struct SurfaceTraits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);

    template <class Base, class Refs>
    struct alignas(64) VertexT : Base {  // alignment to a cache line
        Quadric quadric;
        Candidate candidate;
        ComponentNumber component;  // component (connected part) of the vertex; valid once findComponents() has run
    };
    template <class Base, class Refs>
    struct HalfedgeT : Base {
        WedgeNumber wedge;  // attributes of the corner; invalid for half-edges without a face
    };
    template <class Base, class Refs>
    struct FaceT : Base {
        std::uint32_t primitiveAndTurn = 0;  // 2 · primitive number, plus 1 if the face is reversed

        [[nodiscard]] PrimitiveNumber primitive() const { return {primitiveAndTurn >> 1}; }
        // Returns whether the face's last two corners are swapped compared with the input triangle.
        [[nodiscard]] bool isTurned() const { return (primitiveAndTurn & 1) != 0; }
    };
};

class SurfaceMesh : public OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits> {
public:
    Frame frame;
    WedgeTable wedges;

    SurfaceMesh() = default;
    SurfaceMesh(const SurfaceMesh&) = delete;
    SurfaceMesh& operator=(const SurfaceMesh&) = delete;

    // Creates the given numbers of elements (at least one of each kind). This is the only way to create elements.
    void resize(std::size_t vertexCount, std::size_t edgeCount, std::size_t faceCount) {
        using Kernel = OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits>;
        Kernel::resize(vertexCount, edgeCount, faceCount);
        vertexData_ = &Kernel::data(VertexHandle(0));
        halfedgeData_ = &Kernel::data(HalfedgeHandle(0));
        faceData_ = &Kernel::data(FaceHandle(0));
        positions_ = points();
    }

    // These accessors return the simplifier's data. They are faster than OpenMesh's own accessors, which look up the
    // property array at each access.
    [[nodiscard]] VertexData& data(VertexHandle v) { return vertexData_[v.idx()]; }
    [[nodiscard]] const VertexData& data(VertexHandle v) const { return vertexData_[v.idx()]; }
    [[nodiscard]] HalfedgeData& data(HalfedgeHandle h) { return halfedgeData_[h.idx()]; }
    [[nodiscard]] const HalfedgeData& data(HalfedgeHandle h) const { return halfedgeData_[h.idx()]; }
    [[nodiscard]] FaceData& data(FaceHandle f) { return faceData_[f.idx()]; }
    [[nodiscard]] const FaceData& data(FaceHandle f) const { return faceData_[f.idx()]; }

    [[nodiscard]] glm::vec3 position(VertexHandle v) const {
        const Point& p = positions_[v.idx()];
        return {p[0], p[1], p[2]};
    }
    [[nodiscard]] glm::dvec3 place(VertexHandle v) const { return frame.point(position(v)); }
    [[nodiscard]] glm::dvec3 step(VertexHandle from, VertexHandle to) const {
        return frame.step(position(from), position(to));
    }
    [[nodiscard]] WedgeNumber wedge(HalfedgeHandle corner) const { return data(corner).wedge; }
    [[nodiscard]] PrimitiveNumber primitive(FaceHandle face) const { return data(face).primitive(); }
    template <typename Handle>
    [[nodiscard]] bool isAlive(Handle item) const {
        return !status(item).deleted();
    }

private:
    VertexData* vertexData_ = nullptr;
    HalfedgeData* halfedgeData_ = nullptr;
    FaceData* faceData_ = nullptr;
    const Point* positions_ = nullptr;
};

// OpenMesh's types for a collapse and for a module of its decimater.
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<SurfaceMesh>;
using CollapseModule = OpenMesh::Decimater::ModBaseT<SurfaceMesh>;

// Calls visit(half-edge) for every half-edge that starts at `v`, counter-clockwise. At a border, the half-edge without
// a face is visited last.
template <typename Visit>
void forEachSpoke(const SurfaceMesh& mesh, VertexHandle v, const Visit& visit) {
    const HalfedgeHandle last = mesh.halfedge_handle(v);
    HalfedgeHandle spoke = last;
    do {
        spoke = mesh.ccw_rotated_halfedge_handle(spoke);
        visit(spoke);
    } while (spoke != last);
}

// Call visit(handle) for each face or each vertex that is not deleted, in ascending order.
template <typename Visit>
void forEachFace(const SurfaceMesh& mesh, const Visit& visit) {
    for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f)
        if (mesh.isAlive(FaceHandle(f))) visit(FaceHandle(f));
}
template <typename Visit>
void forEachVertex(const SurfaceMesh& mesh, const Visit& visit) {
    for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v)
        if (mesh.isAlive(VertexHandle(v))) visit(VertexHandle(v));
}

// The three half-edges of a face, in the order of the face's corners.
struct FaceCorners {
    HalfedgeHandle at[3];

    [[nodiscard]] const HalfedgeHandle* begin() const { return at; }
    [[nodiscard]] const HalfedgeHandle* end() const { return at + 3; }
};
inline FaceCorners cornersOf(const SurfaceMesh& mesh, FaceHandle face) {
    const HalfedgeHandle first = mesh.halfedge_handle(face);
    const HalfedgeHandle second = mesh.next_halfedge_handle(first);
    return {{first, second, mesh.next_halfedge_handle(second)}};
}

// Fills the mesh with the faces of the manifold; vertices and faces keep their numbers. Unlike OpenMesh's add_face(),
// it accepts a second edge between two vertices, which may result from cutting non-manifold edges. `triangles` are the
// triangles from which the manifold was built. The mesh vertices at their corners become the wedges of the corners.
void linkFaces(SurfaceMesh& mesh, const Manifold& manifold, const TriangleSet<MeshVertexNumber>& triangles);

// Copies all elements that are not deleted, renumbered in the same order. garbage_collection() would fill gaps with the
// last elements, which would separate neighbours in memory. The wedge table is moved to the copy, without wedges that
// no corner uses. `vertexNumbers` receives the new number of each vertex, invalid for deleted vertices.
std::unique_ptr<SurfaceMesh> livingCopy(SurfaceMesh& mesh, Numbered<VertexHandle, VertexHandle>& vertexNumbers);

}  // namespace defocus::engine
