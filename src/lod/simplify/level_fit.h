#pragma once
// Fits positions, normals, colours and texture coordinates for a coarser level. The values that its vertices happen to
// have pick up single spots of a pattern and single bumps of a relief, and a level whose vertices all lie on a bulging
// surface is too small for it. Instead what the level interpolates linearly is fitted to all vertices of level 0, in
// the sense of least squares (as Hoppe et al. 1993, Mesh Optimization, fit positions; Jacobi-preconditioned conjugate
// gradients, Hestenes and Stiefel 1952).

#include <cstdint>

#include "lod/simplify/fit_source.h"
#include "lod/simplify/triangle_set.h"

namespace defocus {

// Where a vertex of level 0 lies on a coarser level: a point of one of its triangles, as a weighted mean of the
// corners. Weights of 0 leave the vertex out.
struct Anchor {
    TriangleNumber triangle;
    float weight[3] = {0, 0, 0};
    // Valid if the vertex has no anchor of its own: its area, colour and normal count at the anchor of this near one.
    MeshVertexNumber sharedWith = {};
};

// Says how a component of a level grows once it is fitted. It is scaled about `centre` until it has `area`, which is
// what the mesh had of it and of those that it stands in for. It never shrinks, and grows by `mostFactor` at most.
struct Growth {
    glm::dvec3 centre{0};  // object units
    double area = 0;       // object units squared
    double mostFactor = 1;
};

struct LevelMesh {
    TriangleSet<LevelVertexNumber> triangles;
    Numbered<LevelVertexNumber, MeshVertexNumber> sources;  // the vertex whose values each one has; never a twin
    // 1: the vertex lies on the other side of a thin sheet than the others at its place. It shares its normal and
    // colour only with others that are apart.
    Numbered<LevelVertexNumber, std::uint8_t> apart;
    Numbered<ComponentNumber, Growth> growths;
    Numbered<LevelVertexNumber, ComponentNumber> growthsOf;  // empty without any
};

// The values of each vertex of a LevelMesh.
struct LevelFit {
    Numbered<LevelVertexNumber, glm::vec3> positions;
    Numbered<LevelVertexNumber, glm::vec3>
        normals;  // of length ≤ 1: the shorter, the more the normals that it stands for differ
    Numbered<LevelVertexNumber, glm::vec4> colors;    // may lie outside [0, 1]; empty without colours
    Numbered<LevelVertexNumber, glm::vec2> uv0, uv1;  // empty without texture coordinates
};

// Fits a level. Each vertex of the mesh counts by its area, foreshortened on its anchor's
// triangle; vertices that no anchor names keep the values they have from the mesh. The fit turns no triangle by more
// than 60° and leaves no part of them outside level 0's box. Vertices at one position stay at one; those whose normals
// agree within a degree share one normal, and with equal colours one colour, so that neither gap nor seam shows.
LevelFit fitLevel(const FitSource& source, const LevelMesh& level, Numbered<MeshVertexNumber, Anchor> anchors);

}  // namespace defocus
