#pragma once
// Fits positions, normals, colours and texture coordinates of a coarser level to level 0, the full mesh. Copies of the
// remaining vertices' attributes would alias: single spots of a pattern or single bumps of a relief would cover large
// areas. A level whose vertices lie on a convex surface would also be too small. Therefore, the linear interpolation
// over the level is fitted to all vertices of level 0 by least squares. Hoppe et al. 1993, Mesh Optimization, fit
// positions in this way. The solver is the Jacobi-preconditioned conjugate gradient method (Hestenes and Stiefel 1952).

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "core/bounds.h"
#include "lod/simplify/light.h"
#include "lod/simplify/outline.h"
#include "lod/simplify/triangle_set.h"
#include "lod/simplify/weld.h"
#include "scene/mesh.h"

namespace defocus::engine {

// Data of level 0, the full mesh, to which coarser levels are fitted: its vertices, the groups of vertices that share a
// value, and the properties that conserve() preserves.
struct FitSource {
    const Vertices& vertices;
    const WeldedPositions& positions;
    const VertexGroups& smoothing;  // vertices in one group share a normal
    VertexGroups shades;            // vertices in one group share normal and colour; empty without colours
    // Vertices in one group have the same position and texture coordinates; empty without texture coordinates.
    VertexGroups charts;
    // 1: the vertex is on a texture seam, since another vertex at its position has different texture coordinates; else
    // 0. Empty without texture coordinates.
    Numbered<MeshVertexNumber, std::uint8_t> seams;
    Numbered<MeshVertexNumber, float> areas;  // surface area around each vertex, relative to the mean
    Bounds bounds;                            // bounding box of level 0's triangles
    // Mean colour, silhouettes and reflected radiance of level 0, which conserve() preserves.
    glm::dvec4 meanColor{0};
    std::vector<CoverGrid> outlines;
    LightMeans light{};
};

// Collects the data of level 0 for the fit of all levels. `triangles` are the triangles of level 0. Keeps references to
// the other arguments.
FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles);

// Point on a coarser level that represents a vertex of level 0: a triangle and barycentric coordinates. If all weights
// are 0, the vertex has no anchor of its own. `triangle` then holds the number of the vertex whose anchor it shares, or
// is invalid.
struct Anchor {
    TriangleNumber triangle;
    float weight[3] = {0, 0, 0};

    // Returns the value for a vertex that is represented by the anchor of vertex `near`. The area, colour and normal of
    // the represented vertex are added to those of `near`.
    static Anchor sharedWith(MeshVertexNumber near) { return {{near.value}}; }
    [[nodiscard]] bool isUnused() const { return weight[0] == 0 && weight[1] == 0 && weight[2] == 0; }
    // Returns the vertex whose anchor (the point that represents it) this vertex shares; invalid if it shares none.
    [[nodiscard]] MeshVertexNumber shared() const {
        return isUnused() ? MeshVertexNumber{triangle.value} : MeshVertexNumber{};
    }
};

// Enlargement of a component (connected part of the mesh) after fitting. It makes up for removed components, or for
// area that the component lost during simplification. The component is scaled about `centre` until it has `area`, the
// sum of its original area and the areas of the components that it replaces. The scale is in [1, `maxFactor`].
struct Growth {
    glm::dvec3 centre{0};  // the point about which the component is scaled, object units
    double area = 0;       // target area of the component, object units squared
    double maxFactor = 1;
};

struct LevelMesh {
    TriangleSet<LevelVertexNumber> triangles;
    // For each level vertex, the mesh vertex that it comes from. If the level vertex is a duplicate, made for the back
    // of a thin plate, this is the mesh vertex that was duplicated.
    Numbered<LevelVertexNumber, MeshVertexNumber> sources;
    // 1: the vertex is on the back of a thin plate, such as a fin, and the other vertices at its position are on the
    // front; else 0. A back vertex shares its normal and colour only with other back vertices.
    Numbered<LevelVertexNumber, std::uint8_t> apart;
    Numbered<ComponentNumber, Growth> growths;
    // Component (connected part) of each vertex; empty if no component is enlarged.
    Numbered<LevelVertexNumber, ComponentNumber> growthsOf;
};

// Fitted attributes of all vertices of a LevelMesh.
struct LevelFit {
    Numbered<LevelVertexNumber, glm::vec3> positions;
    Numbered<LevelVertexNumber, glm::vec3> normals;   // length ≤ 1; shorter where the normals of level 0 diverge more
    Numbered<LevelVertexNumber, glm::vec4> colors;    // may lie outside [0, 1]; empty without colours
    Numbered<LevelVertexNumber, glm::vec2> uv0, uv1;  // empty without texture coordinates
};

// Fits the attributes of a level to level 0. Each mesh vertex is weighted by the area of the triangles around it. This
// area is projected onto the level's triangle that contains the vertex's anchor, the point that represents the vertex
// on the level. Level vertices without any anchor on their triangles keep their original values. No triangle rotates by
// more than 60°, and all triangles stay inside level 0's bounding box. Vertices at the same position stay together. To
// prevent gaps and visible seams, vertices whose normals agree within one degree share a normal; if their colours are
// equal, they also share a colour.
LevelFit fitLevel(const FitSource& source, const LevelMesh& level, Numbered<MeshVertexNumber, Anchor> anchors);

// Corrects a fitted level so that it preserves the properties of level 0 that remain visible after a wide blur:
// - the covered area, if the level is coarse: vertices at outlines are moved (outline.h);
// - the mean colour over the area, including alpha: all colours are shifted by the same amount;
// - the radiance that a matt surface reflects, for each light direction: normals are rotated slightly (light.h).
// The guarantees of fitLevel still hold, except that a triangle may rotate by up to 60° more.
void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit);

}  // namespace defocus::engine
