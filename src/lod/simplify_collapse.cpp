// The half-edge collapse in a triangle mesh: two faces go, and with each one of the two edges that they would leave
// between the same vertices. Without OpenMesh's marks for what is deleted, which cost memory and time.

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::TriConnectivity;
using OpenMesh::VertexHandle;

// `inner` takes the place of `outer`: it runs between the same vertices, along what lies beyond.
void replaceOuter(TriConnectivity& mesh, HalfedgeHandle outer, HalfedgeHandle inner) {
    const FaceHandle beyond = mesh.face_handle(outer);
    mesh.set_face_handle(inner, beyond);
    if (beyond.is_valid() && mesh.halfedge_handle(beyond) == outer) mesh.set_halfedge_handle(beyond, inner);
    mesh.set_next_halfedge_handle(mesh.prev_halfedge_handle(outer), inner);
    mesh.set_next_halfedge_handle(inner, mesh.next_halfedge_handle(outer));
}

// The face beside `side`, one of the edge's two half-edges, goes; `kept` is its edge at the survivor, `lost` the one at
// the vertex that goes.
void removeSide(TriConnectivity& mesh, HalfedgeHandle side, HalfedgeHandle kept, HalfedgeHandle lost,
                VertexHandle third) {
    const FaceHandle face = mesh.face_handle(side);
    if (!face.is_valid()) {
        mesh.set_next_halfedge_handle(mesh.prev_halfedge_handle(side), mesh.next_halfedge_handle(side));
        return;
    }
    mesh.set_halfedge_handle(face, HalfedgeHandle());
    const HalfedgeHandle outer = mesh.opposite_halfedge_handle(lost);
    const HalfedgeHandle thirdFirst = mesh.halfedge_handle(third);
    if (thirdFirst == lost) mesh.set_halfedge_handle(third, mesh.opposite_halfedge_handle(kept));
    if (thirdFirst == outer) mesh.set_halfedge_handle(third, kept);
    replaceOuter(mesh, outer, kept);
}

}  // namespace

void removeEdge(TriConnectivity& mesh, HalfedgeHandle edge) {
    const HalfedgeHandle opposite = mesh.opposite_halfedge_handle(edge);
    const VertexHandle from = mesh.to_vertex_handle(opposite);
    const VertexHandle to = mesh.to_vertex_handle(edge);
    const HalfedgeHandle fromFirst = mesh.halfedge_handle(from);
    const HalfedgeHandle toFirst = mesh.halfedge_handle(to);
    const bool fromBorder = !mesh.face_handle(fromFirst).is_valid();
    const bool toBorder = !mesh.face_handle(toFirst).is_valid();
    forEachOutgoing(mesh, from,
                    [&](HalfedgeHandle out) { mesh.set_vertex_handle(mesh.opposite_halfedge_handle(out), to); });

    // from → to → third, then to → from → third on the other side.
    const HalfedgeHandle onward = mesh.next_halfedge_handle(edge);
    const HalfedgeHandle back = mesh.prev_halfedge_handle(edge);
    const HalfedgeHandle backBeyond = mesh.opposite_halfedge_handle(back);
    removeSide(mesh, edge, onward, back, mesh.to_vertex_handle(onward));
    const HalfedgeHandle lost = mesh.next_halfedge_handle(opposite);
    const HalfedgeHandle inward = mesh.prev_halfedge_handle(opposite);
    removeSide(mesh, opposite, inward, lost, mesh.to_vertex_handle(lost));

    // The survivor's first half-edge: along the border if it lies there.
    HalfedgeHandle first = toFirst;
    if (toBorder) {
        if (toFirst == opposite) first = lost;
    } else if (fromBorder) {
        first = fromFirst == backBeyond ? onward : fromFirst;
    } else if (toFirst == opposite) {
        first = onward;
    }
    mesh.set_halfedge_handle(to, first);
    mesh.set_halfedge_handle(from, HalfedgeHandle());
}

}  // namespace defocus
