#include "lod/simplify/surface_mesh.h"

#include <utility>

namespace defocus {

namespace {

// Closes the loops of half-edges beyond borders. Every vertex at a border has one that leaves it, as its faces form a
// single fan; it becomes the vertex's half-edge.
void linkBorders(SurfaceMesh& mesh) {
    const auto count = static_cast<int>(mesh.n_halfedges());
    for (int h = 0; h < count; ++h)
        if (const HalfedgeHandle border(h); mesh.is_boundary(border))
            mesh.set_halfedge_handle(mesh.from_vertex_handle(border), border);
    for (int h = 0; h < count; ++h)
        if (const HalfedgeHandle border(h); mesh.is_boundary(border))
            mesh.set_next_halfedge_handle(border, mesh.halfedge_handle(mesh.to_vertex_handle(border)));
}

// Numbers in their old order what `isKept` lets in, others are invalid; returns how many there are.
template <typename Handle, typename IsKept>
std::size_t number(std::vector<Handle>& numbers, std::size_t count, const IsKept& isKept) {
    numbers.assign(count, Handle());
    int next = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (isKept(Handle(static_cast<int>(i)))) numbers[i] = Handle(next++);
    return static_cast<std::size_t>(next);
}

// Drops the wedges that no living corner draws; says what the others are from now on.
std::vector<WedgeNumber> keepDrawnWedges(SurfaceMesh& mesh) {
    std::vector<WedgeNumber> numbers(mesh.wedges.size());
    forEachFace(mesh, [&](FaceHandle face) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) numbers[mesh.wedge(corner).value] = {0};
    });
    std::vector<WedgeNumber> kept;
    for (std::uint32_t w = 0; w < numbers.size(); ++w) {
        if (!numbers[w].isValid()) continue;
        numbers[w] = {static_cast<std::uint32_t>(kept.size())};
        kept.push_back({w});
    }
    mesh.wedges.keep(kept);
    return numbers;
}

}  // namespace

void linkFaces(SurfaceMesh& mesh, const Manifold& manifold, const TriangleSet& triangles) {
    // Each pair of twins is an edge, and so is each half-edge without one; the first of them in the order of faces is
    // its half-edge 0.
    std::vector<HalfedgeHandle> halfedges(manifold.twins.size());
    int edges = 0;
    for (std::uint32_t h = 0; h < halfedges.size(); ++h) {
        const std::uint32_t twin = manifold.twins[h];
        if (twin != Manifold::none && twin < h)
            halfedges[h] = mesh.opposite_halfedge_handle(halfedges[twin]);
        else
            halfedges[h] = SurfaceMesh::s_halfedge_handle(EdgeHandle(edges++), 0);
    }
    if (edges == 0) return;
    mesh.resize(manifold.positions.size(), static_cast<std::size_t>(edges), manifold.faces.size());

    const std::vector<std::uint32_t> primitives = primitivesOf(triangles);
    for (std::uint32_t f = 0; f < manifold.faces.size(); ++f) {
        const FaceHandle face(static_cast<int>(f));
        const bool turned = manifold.turned[f] != 0;
        mesh.data(face).primitiveAndTurn = primitives[manifold.faces[f]] << 1 | (turned ? 1 : 0);
        // A turned face runs from corner 0 over 2 to 1: half-edge 2, which the manifold runs from 2 to 0, leaves 0.
        const std::uint32_t cornerOrder[3] = {3 * f, 3 * f + (turned ? 2 : 1), 3 * f + (turned ? 1 : 2)};
        const HalfedgeHandle sides[3] = {halfedges[3 * f + (turned ? 2 : 0)], halfedges[3 * f + 1],
                                         halfedges[3 * f + (turned ? 0 : 2)]};
        mesh.set_halfedge_handle(face, sides[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexHandle from(static_cast<int>(manifold.corners[cornerOrder[i]]));
            mesh.set_face_handle(sides[i], face);
            mesh.set_next_halfedge_handle(sides[i], sides[(i + 1) % 3]);
            mesh.set_vertex_handle(mesh.opposite_halfedge_handle(sides[i]), from);
            mesh.set_vertex_handle(sides[i],
                                   VertexHandle(static_cast<int>(manifold.corners[cornerOrder[(i + 1) % 3]])));
            mesh.data(sides[i]).wedge = {triangles.indices[3 * std::size_t{manifold.faces[f]} + cornerOrder[i] % 3]};
            if (mesh.is_isolated(from)) mesh.set_halfedge_handle(from, sides[i]);
        }
    }
    linkBorders(mesh);
}

std::unique_ptr<SurfaceMesh> livingCopy(SurfaceMesh& mesh, std::vector<VertexHandle>& vertexNumbers) {
    const std::vector<WedgeNumber> wedges = keepDrawnWedges(mesh);
    std::vector<EdgeHandle> edges;
    std::vector<FaceHandle> faces;
    const std::size_t vertexCount =
        number(vertexNumbers, mesh.n_vertices(), [&](VertexHandle v) { return mesh.isAlive(v); });
    const std::size_t edgeCount = number(edges, mesh.n_edges(), [&](EdgeHandle e) { return mesh.isAlive(e); });
    const std::size_t faceCount = number(faces, mesh.n_faces(), [&](FaceHandle f) { return mesh.isAlive(f); });
    const auto numberOf = [&](HalfedgeHandle h) {
        return SurfaceMesh::s_halfedge_handle(edges[static_cast<std::size_t>(h.idx() / 2)],
                                              static_cast<unsigned>(h.idx() % 2));
    };
    const auto vertexNumber = [&](VertexHandle v) { return vertexNumbers[indexOf(v)]; };
    const auto faceNumber = [&](FaceHandle f) { return faces[indexOf(f)]; };

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
        copy->data(to).wedge = wedges[mesh.wedge(h).value];
    }
    forEachFace(mesh, [&](FaceHandle face) {
        copy->data(faceNumber(face)) = mesh.data(face);
        copy->set_halfedge_handle(faceNumber(face), numberOf(mesh.halfedge_handle(face)));
    });

    // A candidate that is outdated may have lost its edge; any other of the vertex's stands for it.
    forEachVertex(*copy, [&](VertexHandle v) {
        HalfedgeHandle& along = copy->data(v).candidate.along;
        if (!along.is_valid()) return;
        along = mesh.isAlive(mesh.edge_handle(along)) ? numberOf(along) : copy->halfedge_handle(v);
    });
    return copy;
}

}  // namespace defocus
