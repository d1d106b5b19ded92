// The surface at unit size with its quadrics: boundary constraints after Garland and Heckbert 1997.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/memory.h"
#include "lod/simplify/manifold.h"
#include "lod/simplify/state.h"

namespace defocus {

namespace {

// Constraint planes through an edge, upright on its face, weighed by the edge's squared length (a face weighs its
// area).
constexpr double borderWeight = 10;    // open and material borders
constexpr double seamWeight = 0.5;     // jumps of uv or colour
constexpr double rimWeight = 1;        // where the surface folds back on itself; less for smaller angles
constexpr double leastQuality = 1e-3;  // twice the area / sum of squared edges; 0.29 for an equilateral triangle

// Faces of the manifold, those that it turned with their last two corners the other way round.
Faces connectedFaces(const Manifold& manifold, const LevelTriangles& triangles,
                     const std::vector<std::uint32_t>& primitives) {
    Faces faces;
    faces.turned = manifold.turned;
    faces.primitives.reserve(manifold.faces.size());
    faces.corners.resize(manifold.corners.size());
    // Where a corner and the half-edge from it (in the mesh's order) are now.
    const auto cornerAt = [&](std::uint32_t c) {
        return manifold.turned[c / 3] != 0 && c % 3 != 0 ? 6 * (c / 3) + 3 - c : c;
    };
    const auto halfEdgeAt = [&](std::uint32_t e) { return manifold.turned[e / 3] != 0 ? 6 * (e / 3) + 2 - e : e; };
    for (std::uint32_t face = 0; face < manifold.faces.size(); ++face) {
        faces.primitives.push_back(primitives[manifold.faces[face]]);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t c = 3 * face + i;
            Corner& corner = faces.corners[cornerAt(c)];
            corner.vertex = manifold.corners[c];
            corner.wedge = triangles.indices[3 * std::size_t{manifold.faces[face]} + i];
            if (manifold.twins[c] != Manifold::none) faces.corners[halfEdgeAt(c)].twin = halfEdgeAt(manifold.twins[c]);
        }
    }
    return faces;
}

glm::dvec3 faceCross(const Simplifier& s, std::uint32_t face) {
    const Corner* const corner = &s.faces.corners[3 * std::size_t{face}];
    const glm::dvec3 a = s.point(corner[0].vertex);
    return glm::cross(s.point(corner[1].vertex) - a, s.point(corner[2].vertex) - a);
}

// Whether the surface ends at half-edge `e`; a face without area beyond it is no surface.
bool isBorder(const LargeVector<glm::dvec3>& crosses, const Faces& faces, std::uint32_t e) {
    const std::uint32_t twin = faces.corners[e].twin;
    return twin == Corner::none || !(glm::dot(crosses[twin / 3], crosses[twin / 3]) > 0);
}

// Weight of the constraint that a seam or border at half-edge `e` puts on its face's side.
double seamConstraint(const Faces& faces, std::uint32_t e) {
    const std::uint32_t twin = faces.corners[e].twin;
    if (twin == Corner::none || faces.primitives[e / 3] != faces.primitives[twin / 3]) return borderWeight;
    const auto torn = [&](std::uint32_t mine, std::uint32_t theirs) {
        const std::uint32_t a = faces.corners[mine].wedge;
        const std::uint32_t b = faces.corners[theirs].wedge;
        return a != b && !sameChart(faces.wedges[a].row, faces.wedges[b].row);
    };
    return torn(e, nextCorner(twin)) || torn(nextCorner(e), twin) ? seamWeight : 0;
}

// The same for an edge where the surface turns by more than 60°: without it the rim of a thin sheet, whose own area is
// next to nothing, would cost nothing to cut back.
double rimConstraint(const LargeVector<glm::dvec3>& crosses, const Faces& faces, std::uint32_t e) {
    const std::uint32_t twin = faces.corners[e].twin;
    if (twin == Corner::none) return 0;
    const glm::dvec3& mine = crosses[e / 3];
    const glm::dvec3& theirs = crosses[twin / 3];
    const double lengths = std::sqrt(glm::dot(mine, mine) * glm::dot(theirs, theirs));
    return lengths > 0 ? rimWeight * std::max(0.0, 0.5 - glm::dot(mine, theirs) / lengths) : 0;
}

void buildAttributeQuadrics(Simplifier& s) {
    s.attributeQuadrics.resize(s.faces.wedges.size());
    for (std::uint32_t face = 0; face < s.faces.count(); ++face) {
        glm::dvec3 places[3];
        const glm::dvec3* points[3];
        const AttributeRow* rows[3];
        std::uint32_t wedges[3];
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Corner& corner = s.faces.corners[3 * face + i];
            wedges[i] = corner.wedge;
            places[i] = s.point(corner.vertex);
            points[i] = &places[i];
            rows[i] = &s.faces.wedges[corner.wedge].row;
        }
        double squaredEdges = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 edge = places[(i + 1) % 3] - places[i];
            squaredEdges += glm::dot(edge, edge);
        }
        const double doubleArea = glm::length(glm::cross(places[1] - places[0], places[2] - places[0]));
        if (!(doubleArea > leastQuality * squaredEdges)) continue;  // its gradients would be noise
        AttributeQuadric quadric;
        quadric.addFace(attributeGradients(points, rows), static_cast<float>(doubleArea / 6));
        for (const std::uint32_t wedge : wedges) s.attributeQuadrics[wedge].addFaces(quadric);
    }
}

void buildQuadrics(Simplifier& s) {
    const Faces& faces = s.faces;
    LargeVector<glm::dvec3> crosses;
    crosses.reserve(faces.count());
    for (std::uint32_t face = 0; face < faces.count(); ++face) crosses.push_back(faceCross(s, face));
    for (std::uint32_t face = 0; face < faces.count(); ++face) {
        const glm::dvec3& cross = crosses[face];
        const double doubleArea = glm::length(cross);
        if (!(doubleArea > 0)) continue;
        const glm::dvec3 normal = cross / doubleArea;
        for (std::uint32_t e = 3 * face; e < 3 * face + 3; ++e) {
            const std::uint32_t a = faces.corners[e].vertex;
            const std::uint32_t b = faces.corners[nextCorner(e)].vertex;
            s.vertices[a].quadric.addPlane(glm::vec3(normal), static_cast<float>(doubleArea / 6));
            const bool border = isBorder(crosses, faces, e);
            const double weight =
                border ? borderWeight : std::max(seamConstraint(faces, e), rimConstraint(crosses, faces, e));
            if (weight == 0) continue;
            const glm::dvec3 upright = glm::cross(s.step(a, b), normal);
            const double length = glm::length(upright);
            if (!(length > 0)) continue;
            // A border of short edges before long faces, the end of a strip, weighs as much as those faces: by its
            // edges alone it would cost less to shorten than the strip's inside costs to thin out.
            const double area = border ? std::max(length * length, doubleArea) : length * length;
            const glm::vec3 constraint(upright / length);
            s.vertices[a].quadric.addPlane(constraint, static_cast<float>(weight * area));
            s.vertices[b].quadric.addPlane(constraint, static_cast<float>(weight * area));
        }
    }
}

Frame frameOf(const Vertices& vertices, const std::vector<std::uint32_t>& indices) {
    Bounds bounds;
    for (const std::uint32_t v : indices) {
        const glm::dvec3 point = vertices.positions[v];
        if (std::isfinite(point.x + point.y + point.z)) bounds.extend(point);
    }
    const glm::dvec3 size = bounds.size();
    const double longest = bounds.empty() ? 0 : std::max({size.x, size.y, size.z});
    return longest > 0 ? Frame{bounds.centre(), 1 / longest} : Frame{};
}

// uv in lengths of the unit frame: the ratio that keeps the mesh's whole area.
float uvScaleOf(const Vertices& vertices, const std::vector<std::uint32_t>& indices, const Frame& frame) {
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
    const double ratio = std::sqrt(area / uvArea) * frame.inverse;
    return std::isfinite(ratio) ? static_cast<float>(ratio) : 0.0f;
}

LargeVector<Wedge> allWedges(const Vertices& vertices, float uvScale) {
    LargeVector<Wedge> wedges(vertices.count());
    for (std::size_t v = 0; v < wedges.size(); ++v) {
        wedges[v].source = static_cast<std::uint32_t>(v);
        const glm::vec3 normal = vertices.normals.empty() ? glm::vec3(0) : normalWeight * vertices.normals[v];
        const glm::vec3 color =
            vertices.colors.empty() ? glm::vec3(0) : colorWeight / 255.0f * glm::vec3(vertices.colors[v]);
        const glm::vec2 uv = vertices.uv0.empty() ? glm::vec2(0) : uvWeight * uvScale * vertices.uv0[v];
        wedges[v].row = {normal.x, normal.y, normal.z, color.x, color.y, color.z, uv.x, uv.y};
    }
    return wedges;
}

// Which vertex of the surface each mesh vertex is, and of which primitive: by the first corner that draws it.
void rememberCorners(Origin& origin, const Faces& faces) {
    origin.firstVertex.assign(origin.vertices.count(), Corner::none);
    origin.firstPrimitive.assign(origin.vertices.count(), 0);
    for (std::size_t c = faces.corners.size(); c-- > 0;) {
        const Corner& corner = faces.corners[c];
        origin.firstVertex[corner.wedge] = corner.vertex;
        origin.firstPrimitive[corner.wedge] = faces.primitives[c / 3];
    }
}

}  // namespace

Simplifier prepareSimplifier(const Vertices& vertices, const Welded& positions,
                             std::span<const std::uint32_t> smoothing, const LevelTriangles& triangles) {
    Simplifier s;
    const auto origin =
        std::make_shared<Origin>(Origin{vertices, smoothing, frameOf(vertices, triangles.indices), {}, {}, {}});
    s.origin = origin;
    if (!(origin->frame.inverse > 0)) return s;

    // Make a manifold of the mesh.
    {
        std::vector<glm::dvec3> points(positions.first.size());
        for (std::size_t p = 0; p < points.size(); ++p)
            points[p] = origin->frame.point(vertices.positions[positions.first[p]]);
        const Triangles welded = weldedTriangles(triangles.indices, triangles.primitiveIndexCounts, positions, points);
        Manifold manifold = buildManifold(welded, points);
        s.repairedFaces = manifold.repairs.faces;
        s.liveFaces = manifold.faces.size();
        s.faces = connectedFaces(manifold, triangles, welded.primitives);
        origin->places = std::move(manifold.positions);
    }
    if (s.liveFaces >= fewestToGiveBack) giveBackFreedMemory();  // before what takes the most
    s.vertices.resize(origin->places.size());
    for (std::size_t v = 0; v < s.vertices.size(); ++v)
        s.vertices[v].position = vertices.positions[positions.first[origin->places[v]]];
    for (std::uint32_t c = 0; c < s.faces.corners.size(); ++c) {
        SurfaceVertex& vertex = s.vertices[s.faces.corners[c].vertex];
        if (vertex.corner == Corner::none || s.faces.corners[c].twin == Corner::none) vertex.corner = c;
    }
    rememberCorners(*origin, s.faces);

    // Describe it: wedges and quadrics.
    s.faces.wedges = allWedges(vertices, uvScaleOf(vertices, triangles.indices, origin->frame));
    buildQuadrics(s);
    buildAttributeQuadrics(s);
    s.survivors.resize(s.vertices.size());
    std::iota(s.survivors.begin(), s.survivors.end(), 0u);
    s.current = s.survivors;
    return s;
}

}  // namespace defocus
