#pragma once
// Fits positions, normals, colours and texture coordinates for a coarser level. The values that its vertices happen to
// have pick up single spots of a pattern and single bumps of a relief, and a level whose vertices all lie on a bulging
// surface is too small for it. Instead what the level interpolates linearly is fitted to all vertices of level 0, in
// the sense of least squares (as Hoppe et al. 1993, Mesh Optimization, fit positions; Jacobi-preconditioned conjugate
// gradients, Hestenes and Stiefel 1952).

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

// What all levels of a mesh are fitted to: its vertices, what they share with each other, and what the levels keep of
// the whole surface.
struct FitSource {
    const Vertices& vertices;
    const WeldedPositions& positions;
    const VertexGroups& smoothing;                   // vertices of one group share a normal
    VertexGroups shades;                             // those of one group share a colour; empty without colours
    VertexGroups charts;                             // those of one group share texture coordinates; empty without
    Numbered<MeshVertexNumber, std::uint8_t> seams;  // 1: others at its position have other coordinates; empty without
    Numbered<MeshVertexNumber, float> areas;  // the share of level 0's surface that each vertex stands for, mean 1
    Bounds bounds;                            // of level 0's triangles
    // Level 0's values of what the levels keep; see conserve().
    glm::dvec4 meanColor{0};
    std::vector<CoverGrid> outlines;
    LightMeans light{};
};

// Prepares the fit; `triangles` are level 0's. It keeps references to the other three.
FitSource prepareFit(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                     const TriangleSet<MeshVertexNumber>& triangles);

// Where a vertex of level 0 lies on a coarser level: a point of one of its triangles, as a weighted mean of the
// corners. Weights of 0 leave the vertex out of the fit.
struct Anchor {
    TriangleNumber triangle;
    float weight[3] = {0, 0, 0};

    // Of a vertex that has no anchor of its own: its area, colour and normal count at the anchor of `near`.
    static Anchor sharedWith(MeshVertexNumber near) { return {{near.value}}; }
    [[nodiscard]] bool isUnused() const { return weight[0] == 0 && weight[1] == 0 && weight[2] == 0; }
    // The vertex whose anchor this one shares; invalid if there is none.
    [[nodiscard]] MeshVertexNumber shared() const {
        return isUnused() ? MeshVertexNumber{triangle.value} : MeshVertexNumber{};
    }
};

// Says how a component of a level grows once it is fitted. It is scaled about `centre` until it has `area`, which is
// what the mesh had of it and of those that it stands in for. It never shrinks, and grows by `mostFactor` at most.
struct Growth {
    glm::dvec3 centre{0};  // object units
    double area = 0;       // object units squared
    double maxFactor = 1;
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

// Corrects a fitted level until it keeps what a wide blur would show of level 0:
// - the area that it covers, where it is so coarse that it may lose any: what lies at its outlines moves (outline.h);
// - the mean colour over its area, alpha included: all colours are shifted alike;
// - the light that it throws back if it is matt, from any direction: its normals turn a little (light.h).
// What fitLevel promises of places and of normals that are shared still holds; a triangle turns by at most 60° more.
void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit);

}  // namespace defocus::engine
