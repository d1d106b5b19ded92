#include "lod/simplify/surface_mesh.h"

#include <utility>

namespace defocus::engine {

namespace {

// Connects the half-edges without faces into loops along the borders. Each border vertex has exactly one outgoing
// half-edge without a face, because its faces form a single fan. This half-edge becomes the halfedge_handle of the
// vertex.
void linkBorders(SurfaceMesh& mesh) {
    const auto count = static_cast<int>(mesh.n_halfedges());
    for (int h = 0; h < count; ++h)
        if (const HalfedgeHandle border(h); mesh.is_boundary(border))
            mesh.set_halfedge_handle(mesh.from_vertex_handle(border), border);
    for (int h = 0; h < count; ++h)
        if (const HalfedgeHandle border(h); mesh.is_boundary(border))
            mesh.set_next_halfedge_handle(border, mesh.halfedge_handle(mesh.to_vertex_handle(border)));
}

// Assigns consecutive new indices to the elements for which isKept is true; the other elements become invalid. Returns
// the number of kept elements.
template <typename Handle, typename IsKept>
std::size_t number(Numbered<Handle, Handle>& numbers, std::size_t count, const IsKept& isKept) {
    numbers.assign(count, Handle());
    int next = 0;
    for (const Handle item : numbers.numbers())
        if (isKept(item)) numbers[item] = Handle(next++);
    return static_cast<std::size_t>(next);
}

// Removes the wedges (vertices) that no remaining face corner uses. Returns the new number of each wedge.
Numbered<WedgeNumber, WedgeNumber> keepDrawnWedges(SurfaceMesh& mesh) {
    Numbered<WedgeNumber, WedgeNumber> numbers(mesh.wedges.size());
    forEachFace(mesh, [&](FaceHandle face) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) numbers[mesh.wedge(corner)] = {0};
    });
    std::vector<WedgeNumber> kept;
    for (const WedgeNumber w : numbers.numbers()) {
        if (!numbers[w].isValid()) continue;
        numbers[w] = {static_cast<std::uint32_t>(kept.size())};
        kept.push_back(w);
    }
    mesh.wedges.keep(kept);
    return numbers;
}

}  // namespace

void linkFaces(SurfaceMesh& mesh, const Manifold& manifold, const TriangleSet<MeshVertexNumber>& triangles) {
    // Each pair of opposite half-edges forms an edge, and so does each half-edge without an opposite one. The half-edge
    // with the lower number is half-edge 0 of its edge.
    Numbered<SurfaceCorner, HalfedgeHandle> halfedges(manifold.twins.size());
    int edges = 0;
    for (const SurfaceCorner h : halfedges.numbers()) {
        const SurfaceCorner twin = manifold.twins[h];
        if (twin.isValid() && twin < h)
            halfedges[h] = mesh.opposite_halfedge_handle(halfedges[twin]);
        else
            halfedges[h] = SurfaceMesh::s_halfedge_handle(EdgeHandle(edges++), 0);
    }
    if (edges == 0) return;
    mesh.resize(manifold.positions.size(), static_cast<std::size_t>(edges), manifold.faces.size());

    const Numbered<TriangleNumber, PrimitiveNumber> primitives = primitivesOf(triangles);
    for (const SurfaceFaceNumber f : manifold.faces.numbers()) {
        const auto face = itemAt<FaceHandle>(indexOf(f));
        const bool turned = manifold.turned[f] != 0;
        mesh.data(face).primitiveAndTurn = primitives[manifold.faces[f]].value << 1 | (turned ? 1 : 0);
        // A reversed face has the corner order 0, 2, 1 in the mesh. Half-edge 2 of the manifold, from corner 2 to
        // corner 0, becomes the half-edge from 0 to 2 in the mesh.
        const std::uint32_t cornerOrder[3] = {0, turned ? 2u : 1u, turned ? 1u : 2u};
        const HalfedgeHandle sides[3] = {halfedges[cornerAt(f, turned ? 2 : 0)], halfedges[cornerAt(f, 1)],
                                         halfedges[cornerAt(f, turned ? 0 : 2)]};
        const auto vertexAt = [&](std::size_t i) {
            return itemAt<VertexHandle>(indexOf(manifold.corners[cornerAt(f, cornerOrder[i])]));
        };
        mesh.set_halfedge_handle(face, sides[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexHandle from = vertexAt(i);
            mesh.set_face_handle(sides[i], face);
            mesh.set_next_halfedge_handle(sides[i], sides[(i + 1) % 3]);
            mesh.set_vertex_handle(mesh.opposite_halfedge_handle(sides[i]), from);
            mesh.set_vertex_handle(sides[i], vertexAt((i + 1) % 3));
            mesh.data(sides[i]).wedge = {triangles.corners(manifold.faces[f])[cornerOrder[i]].value};
            if (mesh.is_isolated(from)) mesh.set_halfedge_handle(from, sides[i]);
        }
    }
    linkBorders(mesh);
}

std::unique_ptr<SurfaceMesh> livingCopy(SurfaceMesh& mesh, Numbered<VertexHandle, VertexHandle>& vertexNumbers) {
    const Numbered<WedgeNumber, WedgeNumber> wedges = keepDrawnWedges(mesh);
    Numbered<EdgeHandle, EdgeHandle> edges;
    Numbered<FaceHandle, FaceHandle> faces;
    const std::size_t vertexCount =
        number(vertexNumbers, mesh.n_vertices(), [&](VertexHandle v) { return mesh.isAlive(v); });
    const std::size_t edgeCount = number(edges, mesh.n_edges(), [&](EdgeHandle e) { return mesh.isAlive(e); });
    const std::size_t faceCount = number(faces, mesh.n_faces(), [&](FaceHandle f) { return mesh.isAlive(f); });
    const auto numberOf = [&](HalfedgeHandle h) {
        return SurfaceMesh::s_halfedge_handle(edges[mesh.edge_handle(h)], static_cast<unsigned>(h.idx() % 2));
    };
    const auto vertexNumber = [&](VertexHandle v) { return vertexNumbers[v]; };
    const auto faceNumber = [&](FaceHandle f) { return faces[f]; };

    auto copy = std::make_unique<SurfaceMesh>();
    copy->frame = mesh.frame;
    copy->wedges = std::move(mesh.wedges);
    if (edgeCount == 0) return copy;
    copy->resize(vertexCount, edgeCount, faceCount);
    forEachVertex(mesh, [&](VertexHandle v) {
        copy->set_point(vertexNumber(v), mesh.point(v));
        copy->data(vertexNumber(v)) = mesh.data(v);
        copy->set_halfedge_handle(vertexNumber(v), numberOf(mesh.halfedge_handle(v)));
    });
    for (int i = 0; i < static_cast<int>(mesh.n_halfedges()); ++i) {
        const HalfedgeHandle h(i);
        if (!mesh.isAlive(mesh.edge_handle(h))) continue;
        const HalfedgeHandle to = numberOf(h);
        copy->set_vertex_handle(to, vertexNumber(mesh.to_vertex_handle(h)));
        copy->set_next_halfedge_handle(to, numberOf(mesh.next_halfedge_handle(h)));
        if (mesh.is_boundary(h)) continue;
        copy->set_face_handle(to, faceNumber(mesh.face_handle(h)));
        copy->data(to).wedge = wedges[mesh.wedge(h)];
    }
    forEachFace(mesh, [&](FaceHandle face) {
        copy->data(faceNumber(face)) = mesh.data(face);
        copy->set_halfedge_handle(faceNumber(face), numberOf(mesh.halfedge_handle(face)));
    });

    // A planned collapse that is outdated may refer to a deleted edge. Replace the edge by any half-edge of the same
    // vertex. The choice does not matter, because outdated collapses are planned again before use.
    forEachVertex(*copy, [&](VertexHandle v) {
        HalfedgeHandle& along = copy->data(v).candidate.along;
        if (!along.is_valid()) return;
        along = mesh.isAlive(mesh.edge_handle(along)) ? numberOf(along) : copy->halfedge_handle(v);
    });
    return copy;
}

}  // namespace defocus::engine
