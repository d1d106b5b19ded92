// Half-edges after Botsch, Steinberg, Bischoff and Kobbelt 2002, OpenMesh; quadrics and boundary constraints after
// Garland and Heckbert 1997.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "lod/manifold.h"
#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// Constraint planes through an edge, upright on its face, weighed by the edge's squared length (a face weighs its
// area).
constexpr double borderWeight = 10;  // open and material borders
constexpr double seamWeight = 0.5;   // jumps of uv or colour
constexpr double rimWeight = 1;      // where the surface folds back on itself; less for smaller angles
// The distance, in the mesh's longest sides, that weighs as much as a unit of an attribute. Swept on the school of
// fish: half or twice as much costs up to 0.5 dB at the same triangles.
constexpr float normalWeight = 0.003f;
constexpr float colorWeight = 0.005f;
constexpr float uvWeight = 0.05f;      // of uv scaled to lengths: a texture that slides
constexpr double leastQuality = 1e-3;  // twice the area / sum of squared edges; 0.29 for an equilateral triangle

// Links half-edges directly: the manifold is known to be one, which add_face would find out again face by face.
void buildConnectivity(Simplifier& s, const Manifold& manifold) {
    auto& mesh = s.mesh;
    const std::size_t edgeCount = manifold.twins.size();
    mesh.reserve(manifold.positions.size(), edgeCount, manifold.faces.size());
    for (std::size_t v = 0; v < manifold.positions.size(); ++v) mesh.new_vertex();

    // Half-edge 3·f + i joins corners i and i + 1, against that order where the face is turned.
    const auto next = [](std::size_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    const auto previous = [](std::size_t e) { return e % 3 == 0 ? e + 2 : e - 1; };
    std::vector<HalfedgeHandle> handles(edgeCount);
    std::vector<HalfedgeHandle> borderInto(manifold.positions.size());
    for (std::size_t e = 0; e < edgeCount; ++e) {
        if (handles[e].is_valid()) continue;
        const bool turned = manifold.turned[e / 3] != 0;
        const VertexHandle a = vertexHandle(manifold.corners[turned ? next(e) : e]);
        const VertexHandle b = vertexHandle(manifold.corners[turned ? e : next(e)]);
        handles[e] = mesh.new_edge(a, b);
        mesh.set_halfedge_handle(a, handles[e]);
        mesh.set_halfedge_handle(b, mesh.opposite_halfedge_handle(handles[e]));
        if (manifold.twins[e] != Manifold::none)
            handles[manifold.twins[e]] = mesh.opposite_halfedge_handle(handles[e]);
        else
            borderInto[index(a)] = mesh.opposite_halfedge_handle(handles[e]);
    }
    for (std::size_t e = 0; e < edgeCount; ++e) {
        if (e % 3 == 0) mesh.set_halfedge_handle(mesh.new_face(), handles[e]);
        mesh.set_face_handle(handles[e], FaceHandle(static_cast<int>(e / 3)));
        mesh.set_next_halfedge_handle(handles[e], handles[manifold.turned[e / 3] != 0 ? previous(e) : next(e)]);
    }

    // Each border vertex has one border half-edge in and one out; the latter is its first, as OpenMesh expects.
    for (std::size_t e = 0; e < edgeCount; ++e) {
        if (manifold.twins[e] != Manifold::none) continue;
        const HalfedgeHandle border = mesh.opposite_halfedge_handle(handles[e]);
        const VertexHandle start = mesh.from_vertex_handle(border);
        mesh.set_halfedge_handle(start, border);
        mesh.set_next_halfedge_handle(borderInto[index(start)], border);
    }
}

glm::dvec3 faceCross(const Simplifier& s, std::uint32_t face) {
    const glm::dvec3& a = s.points[s.corners.vertex[3 * face]];
    return glm::cross(s.points[s.corners.vertex[3 * face + 1]] - a, s.points[s.corners.vertex[3 * face + 2]] - a);
}

// Whether the surface ends at edge `e` of the manifold; a face without area beyond it is no surface.
bool isBorder(const std::vector<glm::dvec3>& crosses, const Manifold& manifold, std::uint32_t e) {
    const std::uint32_t twin = manifold.twins[e];
    return twin == Manifold::none || !(glm::dot(crosses[twin / 3], crosses[twin / 3]) > 0);
}

// Weight of the constraint that a seam or border at edge `e` (of the manifold) puts on its face's side.
double seamConstraint(const Corners& corners, const Manifold& manifold, std::uint32_t e) {
    const std::uint32_t twin = manifold.twins[e];
    if (twin == Manifold::none || corners.primitive[e / 3] != corners.primitive[twin / 3]) return borderWeight;
    const std::uint32_t end = e % 3 == 2 ? e - 2 : e + 1;
    for (const std::uint32_t corner : {e, end}) {
        const std::uint32_t mine = corners.wedge[corner];
        const std::uint32_t theirs = corners.wedge[corners.at(twin / 3, corners.vertex[corner])];
        if (mine == theirs) continue;
        const WedgeAttributes& a = corners.attributes[mine];
        const WedgeAttributes& b = corners.attributes[theirs];
        if (a.uv != b.uv || a.color != b.color) return seamWeight;
    }
    return 0;
}

// The same for an edge where the surface turns by more than 60°: without it the rim of a thin sheet, whose own area is
// next to nothing, would cost nothing to cut back.
double rimConstraint(const std::vector<glm::dvec3>& crosses, const Manifold& manifold, std::uint32_t e) {
    const std::uint32_t twin = manifold.twins[e];
    if (twin == Manifold::none) return 0;
    const glm::dvec3& mine = crosses[e / 3];
    const glm::dvec3& theirs = crosses[twin / 3];
    const double lengths = std::sqrt(glm::dot(mine, mine) * glm::dot(theirs, theirs));
    return lengths > 0 ? rimWeight * std::max(0.0, 0.5 - glm::dot(mine, theirs) / lengths) : 0;
}

// Attributes in lengths of the unit frame.
void buildAttributeRows(Simplifier& s) {
    s.wedges.resize(s.corners.attributes.size());
    for (std::size_t w = 0; w < s.wedges.size(); ++w) {
        const WedgeAttributes& a = s.corners.attributes[w];
        const glm::vec3 normal = normalWeight * a.normal;
        const glm::vec3 color = colorWeight * a.color;
        const glm::vec2 uv = uvWeight * a.uv;
        s.wedges[w].row = {normal.x, normal.y, normal.z, color.x, color.y, color.z, uv.x, uv.y};
    }
}

void buildAttributeQuadrics(Simplifier& s) {
    buildAttributeRows(s);
    for (std::size_t first = 0; first < s.corners.vertex.size(); first += 3) {
        const glm::dvec3* points[3];
        const AttributeRow* rows[3];
        double squaredEdges = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            points[i] = &s.points[s.corners.vertex[first + i]];
            rows[i] = &s.wedges[s.corners.wedge[first + i]].row;
            const glm::dvec3 edge = s.points[s.corners.vertex[first + (i + 1) % 3]] - *points[i];
            squaredEdges += glm::dot(edge, edge);
        }
        const double doubleArea = glm::length(faceCross(s, static_cast<std::uint32_t>(first / 3)));
        if (!(doubleArea > leastQuality * squaredEdges)) continue;  // its gradients would be noise
        const AttributeGradients gradients = attributeGradients(points, rows);
        for (std::size_t i = 0; i < 3; ++i)
            s.wedges[s.corners.wedge[first + i]].quadric.addFace(gradients, static_cast<float>(doubleArea / 6));
    }
}

void buildQuadrics(Simplifier& s, const Manifold& manifold) {
    s.quadrics.resize(s.points.size());
    std::vector<glm::dvec3> crosses;
    crosses.reserve(manifold.faces.size());
    for (std::uint32_t face = 0; face < manifold.faces.size(); ++face) crosses.push_back(faceCross(s, face));
    for (std::uint32_t face = 0; face < manifold.faces.size(); ++face) {
        const glm::dvec3& cross = crosses[face];
        const double doubleArea = glm::length(cross);
        if (!(doubleArea > 0)) continue;
        const glm::dvec3 normal = cross / doubleArea;
        for (std::uint32_t e = 3 * face; e < 3 * face + 3; ++e) {
            const std::uint32_t a = s.corners.vertex[e];
            const std::uint32_t b = s.corners.vertex[e % 3 == 2 ? e - 2 : e + 1];
            s.quadrics[a].addPlane(glm::vec3(normal), static_cast<float>(doubleArea / 6));
            const bool border = isBorder(crosses, manifold, e);
            const double weight =
                border ? borderWeight
                       : std::max(seamConstraint(s.corners, manifold, e), rimConstraint(crosses, manifold, e));
            const glm::dvec3 edge = s.points[b] - s.points[a];
            const glm::dvec3 upright = glm::cross(edge, normal);
            const double length = glm::length(upright);
            if (weight == 0 || !(length > 0)) continue;
            // A border of short edges before long faces, the end of a strip, weighs as much as those faces: by its
            // edges alone it would cost less to shorten than the strip's inside costs to thin out.
            const double area = border ? std::max(length * length, doubleArea) : length * length;
            const glm::vec3 constraint(upright / length);
            s.quadrics[a].addPlane(constraint, static_cast<float>(weight * area));
            s.quadrics[b].addPlane(constraint, static_cast<float>(weight * area));
        }
    }
}

struct Frame {
    glm::dvec3 centre{0};
    double scale = 0;  // longest side of the box; 0 if there is none
};

Frame frameOf(const Vertices& vertices, const std::vector<std::uint32_t>& indices) {
    Bounds bounds;
    for (const std::uint32_t v : indices) {
        const glm::dvec3 point = vertices.positions[v];
        if (std::isfinite(point.x + point.y + point.z)) bounds.extend(point);
    }
    const glm::dvec3 size = bounds.size();
    return bounds.empty() ? Frame{} : Frame{bounds.centre(), std::max({size.x, size.y, size.z})};
}

// Faces with a corner that is no place at all become degenerate.
Triangles weldedTriangles(const std::vector<glm::dvec3>& points, const Welded& positions, const LevelTriangles& input) {
    const std::vector<std::uint32_t>& indices = input.indices;
    Triangles triangles;
    triangles.positions.reserve(indices.size());
    for (std::size_t f = 0; f < indices.size() / 3; ++f) {
        const std::uint32_t p[3] = {positions.id[indices[3 * f]], positions.id[indices[3 * f + 1]],
                                    positions.id[indices[3 * f + 2]]};
        const glm::dvec3 sum = points[p[0]] + points[p[1]] + points[p[2]];
        const bool proper = std::isfinite(sum.x + sum.y + sum.z);
        for (const std::uint32_t corner : p) triangles.positions.push_back(proper ? corner : p[0]);
    }
    triangles.primitives.reserve(indices.size() / 3);
    for (std::uint32_t p = 0; p < input.primitiveIndexCounts.size(); ++p)
        triangles.primitives.insert(triangles.primitives.end(), input.primitiveIndexCounts[p] / 3, p);
    return triangles;
}

// uv in lengths of the unit frame: the ratio that keeps the mesh's whole area.
std::vector<WedgeAttributes> scaledAttributes(const Vertices& vertices, const std::vector<std::uint32_t>& indices,
                                              const Frame& frame) {
    std::vector<WedgeAttributes> attributes(vertices.count());
    double area = 0;
    double uvArea = 0;
    for (std::size_t i = 0; i + 2 < indices.size() && !vertices.uv0.empty(); i += 3) {
        const std::uint32_t* v = &indices[i];
        const glm::dvec3 a = vertices.positions[v[0]];
        area +=
            glm::length(glm::cross(glm::dvec3(vertices.positions[v[1]]) - a, glm::dvec3(vertices.positions[v[2]]) - a));
        const glm::dvec2 s = glm::dvec2(vertices.uv0[v[1]]) - glm::dvec2(vertices.uv0[v[0]]);
        const glm::dvec2 t = glm::dvec2(vertices.uv0[v[2]]) - glm::dvec2(vertices.uv0[v[0]]);
        uvArea += std::abs(s.x * t.y - s.y * t.x);
    }
    const double ratio = std::sqrt(area / uvArea) / frame.scale;
    const float uvScale = std::isfinite(ratio) ? static_cast<float>(ratio) : 0.0f;
    for (std::size_t v = 0; v < attributes.size(); ++v) {
        if (!vertices.normals.empty()) attributes[v].normal = vertices.normals[v];
        if (!vertices.colors.empty()) attributes[v].color = glm::vec3(vertices.colors[v]) / 255.0f;
        if (!vertices.uv0.empty()) attributes[v].uv = uvScale * vertices.uv0[v];
    }
    return attributes;
}

}  // namespace

Simplifier prepareSimplifier(const Vertices& vertices, const Welded& positions, const LevelTriangles& triangles) {
    // Bring the mesh to unit size, so that no weight depends on its scale.
    Simplifier s;
    const Frame frame = frameOf(vertices, triangles.indices);
    s.scale = frame.scale;
    if (!(frame.scale > 0)) return s;
    std::vector<glm::dvec3> points(positions.first.size());
    for (std::size_t p = 0; p < points.size(); ++p)
        points[p] = (glm::dvec3(vertices.positions[positions.first[p]]) - frame.centre) / frame.scale;

    // Make a manifold of it.
    Triangles welded = weldedTriangles(points, positions, triangles);
    Manifold manifold = buildManifold(welded, points);
    s.repairedFaces = manifold.repairedFaces;
    s.liveFaces = manifold.faces.size();
    s.points.reserve(manifold.positions.size());
    for (const std::uint32_t position : manifold.positions) s.points.push_back(points[position]);

    // Describe it: corners with their wedges, half-edges, quadrics.
    s.corners.vertex = manifold.corners;
    s.corners.wedge.reserve(manifold.corners.size());
    s.corners.primitive.reserve(manifold.faces.size());
    for (const std::uint32_t face : manifold.faces) {
        for (std::size_t i = 0; i < 3; ++i) s.corners.wedge.push_back(triangles.indices[3 * std::size_t{face} + i]);
        s.corners.primitive.push_back(welded.primitives[face]);
    }
    s.corners.attributes = scaledAttributes(vertices, triangles.indices, frame);
    buildConnectivity(s, manifold);
    buildQuadrics(s, manifold);
    manifold = {};  // before what takes the most memory
    welded = {};
    points = {};
    buildAttributeQuadrics(s);
    s.survivors.resize(s.points.size());
    std::iota(s.survivors.begin(), s.survivors.end(), 0u);
    return s;
}

}  // namespace defocus
