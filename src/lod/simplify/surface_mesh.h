#pragma once
// The surface under simplification: OpenMesh's half-edges, with what the simplifier keeps on them. No other file
// includes OpenMesh; the rest of the simplifier uses the names below.
//
// Faces run around their corners so that neighbours agree. A half-edge stands for the corner of its face at the vertex
// that it leaves. At a border the half-edges beyond the surface have no face, and a vertex's halfedge_handle is the one
// that leaves it there. What collapses take away is only marked as deleted, until livingCopy().

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

// The mesh at unit size, so that no weight depends on its scale.
struct Frame {
    glm::dvec3 centre{0};  // object units
    double inverse = 0;    // of the mesh's longest side in object units; 0: the mesh has no extent

    // A place of the mesh in the frame.
    [[nodiscard]] glm::dvec3 point(const glm::vec3& position) const {
        return (glm::dvec3(position) - centre) * inverse;
    }
    // The way between two places, in units of the frame.
    [[nodiscard]] glm::dvec3 step(const glm::vec3& from, const glm::vec3& to) const {
        return (glm::dvec3(to) - glm::dvec3(from)) * inverse;
    }
};

// Collapses of a worse kind wait until no better one is left. See simplify.h for what makes one poor or bad.
enum class Fit : std::uint8_t { good, poor, bad, impossible };

// The collapse that a vertex waits for.
struct Candidate {
    HalfedgeHandle along;  // from the vertex to the survivor; invalid: no collapse is possible
    float cost = std::numeric_limits<float>::infinity();
    Fit fit = Fit::good;    // as far as it has been looked at
    bool outdated = false;  // the vertex has a better one by now, or this one has another cost

    [[nodiscard]] bool possible() const { return along.is_valid(); }
    [[nodiscard]] bool harmless() const { return possible() && fit < Fit::bad; }
};

struct SurfaceTraits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);

    template <class Base, class Refs>
    struct alignas(64) VertexT : Base {  // a line of the cache
        Quadric quadric;
        Candidate candidate;
        ComponentNumber component;  // once components are found
    };
    template <class Base, class Refs>
    struct HalfedgeT : Base {
        WedgeNumber wedge;  // of the corner; none beyond a border
    };
    template <class Base, class Refs>
    struct FaceT : Base {
        std::uint32_t primitiveAndTurn = 0;  // the primitive's number, doubled, plus 1 for a face that is turned

        [[nodiscard]] PrimitiveNumber primitive() const { return {primitiveAndTurn >> 1}; }
        // Whether the mesh has the face's last two corners the other way round.
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

    // Makes so many items (at least one each); the only way to make any.
    void resize(std::size_t vertexCount, std::size_t edgeCount, std::size_t faceCount) {
        using Kernel = OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits>;
        Kernel::resize(vertexCount, edgeCount, faceCount);
        vertexData_ = &Kernel::data(VertexHandle(0));
        halfedgeData_ = &Kernel::data(HalfedgeHandle(0));
        faceData_ = &Kernel::data(FaceHandle(0));
        positions_ = points();
    }

    // At each access OpenMesh looks for the property's array first; here it is known.
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

// OpenMesh's types of a collapse and of a decimater module.
using CollapseInfo = OpenMesh::Decimater::CollapseInfoT<SurfaceMesh>;
using CollapseModule = OpenMesh::Decimater::ModBaseT<SurfaceMesh>;

// Calls visit(half-edge) for every half-edge that leaves `v`, counter-clockwise. At a border the one without a face
// comes last.
template <typename Visit>
void forEachSpoke(const SurfaceMesh& mesh, VertexHandle v, const Visit& visit) {
    const HalfedgeHandle last = mesh.halfedge_handle(v);
    HalfedgeHandle spoke = last;
    do {
        spoke = mesh.ccw_rotated_halfedge_handle(spoke);
        visit(spoke);
    } while (spoke != last);
}

// Calls visit(handle) for every face, or every vertex, that lives, in the order of their numbers.
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

// The three half-edges of a face, in order.
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

// Links the manifold's faces: its vertices and faces keep their numbers. add_face() would refuse a second edge between
// two vertices, which cuts can leave. `triangles` are those that the manifold was made of, in mesh vertices, which are
// their corners' wedges.
void linkFaces(SurfaceMesh& mesh, const Manifold& manifold, const TriangleSet<MeshVertexNumber>& triangles);

// Copies what lives, numbered anew in the order that it had. (garbage_collection() would fill gaps from the end, and
// what is near in space would no longer be so in memory.) Moves the wedge table along, without the wedges that no
// corner draws. `vertexNumbers` gets the new number of each vertex, invalid for those that are gone.
std::unique_ptr<SurfaceMesh> livingCopy(SurfaceMesh& mesh, Numbered<VertexHandle, VertexHandle>& vertexNumbers);

}  // namespace defocus::engine
