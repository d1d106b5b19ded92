// Builds the surface to simplify, scaled to unit size, and its quadrics. Boundary constraints follow Garland and
// Heckbert 1997.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/memory.h"
#include "lod/simplify/manifold.h"
#include "lod/simplify/state.h"

namespace defocus::engine {

namespace {

// Weights of constraint planes, which contain an edge and are perpendicular to the edge's face. The weight is
// multiplied by the squared edge length. (The plane of a face is weighted by the face's area.)
constexpr double borderWeight = 10;  // weight of planes at open borders and material borders
constexpr double seamWeight = 0.5;   // weight of planes at discontinuities of uv or colour
constexpr double rimWeight = 1;      // weight of planes at bends by an angle β > 60°, multiplied by 1/2 − cos β

glm::dvec3 faceCross(const SurfaceMesh& mesh, FaceHandle face) {
    const FaceCorners corner = cornersOf(mesh, face);
    const glm::dvec3 a = mesh.place(mesh.from_vertex_handle(corner.at[0]));
    return glm::cross(mesh.place(mesh.from_vertex_handle(corner.at[1])) - a,
                      mesh.place(mesh.from_vertex_handle(corner.at[2])) - a);
}

// Face normals whose length is twice the face's area.
using Crosses = LargeVector<glm::dvec3>;

const glm::dvec3& crossOf(const Crosses& crosses, FaceHandle face) {
    return crosses[indexOf(face)];
}

// Returns whether the surface ends at an edge. `beyond` is the face on the other side of the edge; a face without area
// counts as missing.
bool endsAt(const Crosses& crosses, FaceHandle beyond) {
    if (!beyond.is_valid()) return true;
    const glm::dvec3& cross = crossOf(crosses, beyond);
    return !(glm::dot(cross, cross) > 0);
}

// Returns the weight of the constraint at half-edge `e`, on the side of the half-edge's face, if the edge is a seam or
// border; else 0.
double seamConstraint(const SurfaceMesh& mesh, HalfedgeHandle e) {
    const HalfedgeHandle twin = mesh.opposite_halfedge_handle(e);
    if (mesh.is_boundary(twin) || mesh.primitive(mesh.face_handle(e)) != mesh.primitive(mesh.face_handle(twin)))
        return borderWeight;
    const auto torn = [&](HalfedgeHandle mine, HalfedgeHandle theirs) {
        const WedgeNumber a = mesh.wedge(mine);
        const WedgeNumber b = mesh.wedge(theirs);
        return a != b && !mesh.wedges.sameChart(a, b);
    };
    return torn(e, mesh.next_halfedge_handle(twin)) || torn(mesh.next_halfedge_handle(e), twin) ? seamWeight : 0;
}

// Returns the weight of the constraint at an edge where the surface bends by more than 60°. Without this constraint,
// the rim of a thin plate such as a fin could be cut back at no cost, because the faces of the rim have almost no area.
double rimConstraint(const Crosses& crosses, FaceHandle face, FaceHandle beyond) {
    const glm::dvec3& mine = crossOf(crosses, face);
    const glm::dvec3& theirs = crossOf(crosses, beyond);
    const double lengths = std::sqrt(glm::dot(mine, mine) * glm::dot(theirs, theirs));
    return lengths > 0 ? rimWeight * std::max(0.0, 0.5 - glm::dot(mine, theirs) / lengths) : 0;
}

std::array<WedgeNumber, 3> wedgesOf(const SurfaceMesh& mesh, const FaceCorners& corners) {
    return {mesh.wedge(corners.at[0]), mesh.wedge(corners.at[1]), mesh.wedge(corners.at[2])};
}

std::vector<bool> changingWedges(const SurfaceMesh& mesh) {
    std::vector<bool> changing(mesh.wedges.size(), false);
    forEachFace(mesh, [&](FaceHandle face) {
        const auto wedges = wedgesOf(mesh, cornersOf(mesh, face));
        if (!mesh.wedges.changes(wedges.data())) return;
        for (const WedgeNumber w : wedges) changing[w.value] = true;
    });
    return changing;
}

void buildAttributeQuadrics(SurfaceMesh& mesh) {
    mesh.wedges.startQuadrics(changingWedges(mesh));
    forEachFace(mesh, [&](FaceHandle face) {
        const FaceCorners corners = cornersOf(mesh, face);
        const auto wedges = wedgesOf(mesh, corners);
        glm::dvec3 places[3];
        for (std::size_t i = 0; i < 3; ++i) places[i] = mesh.place(mesh.from_vertex_handle(corners.at[i]));
        mesh.wedges.addFace(wedges.data(), places);
    });
}

void buildQuadrics(SurfaceMesh& mesh) {
    Crosses crosses;
    crosses.reserve(mesh.n_faces());
    forEachFace(mesh, [&](FaceHandle face) { crosses.push_back(faceCross(mesh, face)); });
    forEachFace(mesh, [&](FaceHandle face) {
        const glm::dvec3& cross = crossOf(crosses, face);
        const double doubleArea = glm::length(cross);
        if (!(doubleArea > 0)) return;
        const glm::dvec3 normal = cross / doubleArea;
        for (const HalfedgeHandle e : cornersOf(mesh, face)) {
            const VertexHandle a = mesh.from_vertex_handle(e);
            const VertexHandle b = mesh.to_vertex_handle(e);
            const FaceHandle beyond = mesh.face_handle(mesh.opposite_halfedge_handle(e));
            mesh.data(a).quadric.addPlane(glm::vec3(normal), static_cast<float>(doubleArea / 6));
            const bool border = endsAt(crosses, beyond);
            const double weight =
                border ? borderWeight : std::max(seamConstraint(mesh, e), rimConstraint(crosses, face, beyond));
            if (weight == 0) continue;
            const glm::dvec3 upright = glm::cross(mesh.step(a, b), normal);
            const double length = glm::length(upright);
            if (!(length > 0)) continue;
            // A short border edge of a long face, such as the end of a strip, is weighted by the face's area. If only
            // the edge's length counted, shortening the strip would be cheaper than removing vertices in its interior.
            const double area = border ? std::max(length * length, doubleArea) : length * length;
            const glm::vec3 constraint(upright / length);
            mesh.data(a).quadric.addPlane(constraint, static_cast<float>(weight * area));
            mesh.data(b).quadric.addPlane(constraint, static_cast<float>(weight * area));
        }
    });
}

Frame frameOf(const Vertices& vertices, const TriangleSet<MeshVertexNumber>& triangles) {
    Bounds bounds;
    for (const MeshVertexNumber v : triangles.indices) {
        const glm::dvec3 point = vertices.positions[v.value];
        if (std::isfinite(point.x + point.y + point.z)) bounds.extend(point);
    }
    const glm::dvec3 size = bounds.size();
    const double longest = bounds.empty() ? 0 : std::max({size.x, size.y, size.z});
    return longest > 0 ? Frame{bounds.centre(), 1 / longest} : Frame{};
}

// Returns the factor that converts lengths in texture space to lengths on the unit-size mesh. It makes the total areas
// of the triangles in both spaces equal.
float uvScaleOf(const Vertices& vertices, const TriangleSet<MeshVertexNumber>& triangles, const Frame& frame) {
    double area = 0;
    double uvArea = 0;
    if (vertices.uv0.empty()) return 0;
    for (const TriangleNumber triangle : triangles.numbers()) {
        const auto v = triangles.corners(triangle);
        const auto position = [&](std::size_t i) { return glm::dvec3(vertices.positions[v[i].value]); };
        const auto uv = [&](std::size_t i) { return glm::dvec2(vertices.uv0[v[i].value]); };
        area += glm::length(glm::cross(position(1) - position(0), position(2) - position(0)));
        const glm::dvec2 s = uv(1) - uv(0);
        const glm::dvec2 t = uv(2) - uv(0);
        uvArea += std::abs(s.x * t.y - s.y * t.x);
    }
    const double ratio = std::sqrt(area / uvArea) * frame.inverse;
    return std::isfinite(ratio) ? static_cast<float>(ratio) : 0.0f;
}

// Records the surface vertex and the primitive of each mesh vertex, taken from the first corner that uses the mesh
// vertex.
void rememberCorners(Origin& origin, const SurfaceMesh& mesh) {
    origin.firstVertex.resize(origin.vertices.count());
    origin.firstPrimitive.resize(origin.vertices.count());
    forEachFace(mesh, [&](FaceHandle face) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) {
            const MeshVertexNumber v = mesh.wedges.source(mesh.wedge(corner));
            if (origin.firstVertex[v].isValid()) continue;
            origin.firstVertex[v] = itemAt<SurfaceVertexNumber>(indexOf(mesh.from_vertex_handle(corner)));
            origin.firstPrimitive[v] = mesh.primitive(face);
        }
    });
}

}  // namespace

void prepareSimplifier(Simplifier& s, const Vertices& vertices, const WeldedPositions& positions,
                       const VertexGroups& smoothing, const TriangleSet<MeshVertexNumber>& triangles) {
    const auto origin = std::make_shared<Origin>(Origin{vertices, smoothing, frameOf(vertices, triangles), {}, {}, {}});
    s.origin = origin;
    s.mesh = std::make_unique<SurfaceMesh>();
    s.modules.emplace(*s.mesh);
    SurfaceMesh& mesh = *s.mesh;
    mesh.frame = origin->frame;
    if (!(origin->frame.inverse > 0)) return;

    {
        Numbered<PositionNumber, glm::dvec3> points(positions.first.size());
        for (const PositionNumber p : points.numbers())
            points[p] = origin->frame.point(vertices.positions[positions.first[p].value]);
        Manifold manifold = buildManifold(weldedTriangles(triangles, positions, points), points);
        s.repairedFaces = manifold.repairs.faces;
        s.liveFaces = manifold.faces.size();
        linkFaces(mesh, manifold, triangles);
        origin->places = std::move(manifold.positions);
    }
    if (s.liveFaces >= fewestToGiveBack) giveBackFreedMemory();  // return freed memory before the largest allocations
    for (const SurfaceVertexNumber v : origin->places.numbers()) {
        const glm::vec3& p = vertices.positions[positions.first[origin->places[v]].value];
        mesh.set_point(itemAt<VertexHandle>(indexOf(v)), {p.x, p.y, p.z});
    }

    mesh.wedges.assign(vertices, uvScaleOf(vertices, triangles, origin->frame));
    rememberCorners(*origin, mesh);
    buildQuadrics(mesh);
    buildAttributeQuadrics(mesh);
    s.survivors.reserve(mesh.n_vertices());
    for (const auto v : numbersBelow<VertexHandle>(mesh.n_vertices())) s.survivors.push_back(v);
    s.current.assign(s.survivors.begin(), s.survivors.end());
    s.modules.emplace(mesh);
}

}  // namespace defocus::engine
