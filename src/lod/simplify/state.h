#pragma once
// What simplify works on while it collapses. Private to this folder.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "lod/simplify/collapse.h"
#include "lod/simplify/collapse_queue.h"
#include "lod/simplify/simplify.h"
#include "lod/simplify/surface_mesh.h"

namespace defocus {

// The surface before any collapse, as far as it is asked for later. The caller keeps `vertices` and `smoothing`.
struct Origin {
    const Vertices& vertices;
    const VertexGroups& smoothing;
    Frame frame;
    Numbered<MeshVertexNumber, SurfaceVertexNumber> firstVertex;  // of its first corner; invalid if it has no face
    Numbered<MeshVertexNumber, PrimitiveNumber> firstPrimitive;   // of the same corner
    Numbered<SurfaceVertexNumber, PositionNumber> places;
};

// A part of the mesh that shares no position with the rest; see components.cpp.
struct Component {
    Ball ball;                  // around all that the mesh had of it
    double area = 0;            // object units squared; of what the mesh had of it, and of all that it stands in for
    PrimitiveNumber primitive;  // of one of its faces
    std::size_t faces = 0;      // that live
    std::size_t harmless = 0;   // vertices that have a collapse that isn't bad, as far as they have been looked at
    bool spent = false;         // it had no such vertex once
    bool standsIn = false;      // for others that were removed
    bool removed = false;
};

struct Simplifier {
    std::shared_ptr<const Origin> origin;
    std::unique_ptr<SurfaceMesh> mesh;       // after compact() it holds what lives and nothing else
    std::optional<CollapseModules> modules;  // of `mesh`
    // For each vertex the one that it collapsed onto; itself while it lives; invalid if it was taken out with its
    // component.
    Numbered<VertexHandle, VertexHandle> survivors;
    // For each vertex of the surface before any collapse, the one that it had become when the mesh was last compact.
    Numbered<SurfaceVertexNumber, VertexHandle> current;
    CollapseQueue queue;
    bool queued = false;  // vertices wait in it
    std::size_t liveFaces = 0;
    std::uint32_t repairedFaces = 0;

    std::vector<MeshVertexNumber> twins;  // see Simplification
    std::unordered_map<MeshVertexNumber, MeshVertexNumber> twinOf;

    Numbered<ComponentNumber, Component>
        components;              // found once faces are few or many components are as small as they get
    double area = 0;             // object units squared; of all components
    bool grows = false;          // small components do, since many are as small as they get
    std::size_t spentFaces = 0;  // living faces of spent components
    double spentArea = 0;        // object units squared; of spent components that are left

    [[nodiscard]] Component& componentAt(VertexHandle v) { return components[mesh->data(v).component]; }
    [[nodiscard]] const Component& componentAt(VertexHandle v) const { return components[mesh->data(v).component]; }
    [[nodiscard]] VertexHandle& survivor(VertexHandle v) { return survivors[v]; }
};

// setup.cpp: makes the mesh's manifold with its quadrics; there are no candidates yet. Without a surface the mesh stays
// empty.
void prepareSimplifier(Simplifier& s, const Vertices& vertices, const WeldedPositions& positions,
                       const VertexGroups& smoothing, const TriangleSet<MeshVertexNumber>& triangles);

// collapse.cpp: how the faces around take the collapse along a half-edge, and their wedges.
Fit judgeFaces(Simplifier& s, HalfedgeHandle along);
// The same, but impossible where the topology forbids it. That is looked at last, and only where the collapse is no
// worse than `worst`: Debian's OpenMesh is built with assertions, which make is_collapse_ok dear.
Fit judgeCollapse(Simplifier& s, HalfedgeHandle along, Fit worst);
// Collapses along the half-edge, which the topology must allow, and tells the modules.
void collapseEdge(Simplifier& s, HalfedgeHandle along);
// The vertex that `v` is or has collapsed onto; invalid if that was taken out.
VertexHandle survivorOf(Simplifier& s, VertexHandle v);
// Numbers what lives anew, in the order it had, and gives back the memory of what is gone.
void compact(Simplifier& s);

// components.cpp: whether the faces hang together, by faces alone.
bool isConnected(const Simplifier& s);
// Whether many faces are of components that can be no smaller.
bool manyAreSmallest(const Simplifier& s);
// Finds the components of what is left of the mesh; the first call does, later ones do nothing.
void findComponents(Simplifier& s, const TriangleSet<MeshVertexNumber>& triangles);
// Notes that the vertex's component has no collapse left that isn't bad.
void spend(Simplifier& s, VertexHandle v);
// How many of so many faces an area would have if they were spread evenly over the mesh's.
double evenShare(const Simplifier& s, double area, std::size_t faces);
// Whether there are too few faces for the vertex's collapse, of this fit, on the way to a level of `target` faces. A
// bad one leaves its component the even share of them. Others, where spent components have most of the faces, leave the
// rest `share` of theirs.
bool isKept(const Simplifier& s, VertexHandle v, Fit fit, std::size_t target, double share);
// Takes whole components out of the mesh until `target` faces are left, or nothing that may go.
void removeComponents(Simplifier& s, std::size_t target);
std::vector<Ball> removedBalls(const Simplifier& s);
// See SimplifiedLevel.
Numbered<ComponentNumber, Growth> growths(const Simplifier& s);

// A level as it was when the collapses had come to it, for what is found out about it while they go on.
struct Snapshot {
    TriangleSet<MeshVertexNumber> drawn;
    Numbered<TriangleCorner, VertexHandle> corners;       // the same triangles in vertices of the level's surface
    Numbered<VertexHandle, glm::vec3> positions;          // of the level's surface
    Numbered<SurfaceVertexNumber, VertexHandle> nearest;  // Simplifier::current
    std::vector<MeshVertexNumber> twins;
    std::vector<MeshVertexNumber> behind;               // those of `drawn` whose corners all lie behind; sorted
    std::vector<Ball> removed;                          // see SimplifiedLevel
    Numbered<ComponentNumber, Growth> growths;          // the same
    Numbered<VertexHandle, ComponentNumber> growthsOf;  // empty without any
};

// snapshot.cpp: takes a picture of what compact() has left.
Snapshot snapshot(Simplifier& s, std::size_t primitiveCount);
// The level of which the picture was taken, with its anchors unless they are not wanted.
SimplifiedLevel described(const Origin& origin, const Snapshot& picture, bool withAnchors);

}  // namespace defocus
