#pragma once
// The state of simplify() while it collapses edges. Private to this folder.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "lod/simplify/collapse.h"
#include "lod/simplify/collapse_queue.h"
#include "lod/simplify/simplify.h"
#include "lod/simplify/surface_mesh.h"

namespace defocus::engine {

// What is needed later of the surface before any collapse. The caller keeps `vertices` and `smoothing` alive.
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
    std::size_t firstFaces = 0;  // of which `lost` gets the share that is lost, in steps of a hundredth
    std::size_t facesAtReport = 0;
    std::function<void(double)> lost;
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

// collapse.cpp: judges what the collapse along a half-edge does to the faces around and to their wedges.
Fit judgeFaces(Simplifier& s, HalfedgeHandle along);
// Does the same, but returns Fit::impossible if the topology forbids the collapse. The topology is tested last, and
// only if the collapse is no worse than `worst`, because Debian's OpenMesh is built with assertions, which make
// is_collapse_ok slow.
Fit judgeCollapse(Simplifier& s, HalfedgeHandle along, Fit worst);
// Collapses along the half-edge, which the topology must allow, and tells the modules.
void collapseEdge(Simplifier& s, HalfedgeHandle along);
// Returns the vertex that `v` has collapsed onto, or `v` itself if it lives; invalid if it went with its component.
VertexHandle survivorOf(Simplifier& s, VertexHandle v);
// Removes what is gone from the mesh, numbers the rest anew in the same order, and gives back the memory.
void compact(Simplifier& s);

// components.cpp: returns whether all faces hang together by the vertices that they share. Equal positions don't count.
bool isConnected(const Simplifier& s);
// Returns whether more than a quarter of the faces are single triangles or parts of tetrahedra, which no collapse makes
// smaller.
bool manyAreSmallest(const Simplifier& s);
// Finds the components of what is left of the mesh. Only the first call does anything.
void findComponents(Simplifier& s, const TriangleSet<MeshVertexNumber>& triangles);
// Notes that the vertex's component has no collapse left that isn't bad.
void spend(Simplifier& s, VertexHandle v);
// Returns how many of `faces` faces would lie on `area` if they were spread evenly over the whole area of the mesh.
double evenShare(const Simplifier& s, double area, std::size_t faces);
// Returns whether the vertex's collapse, which has this fit, must not be made on the way to a level of `target` faces.
// A bad collapse must leave its component its even share of those faces. Other collapses are limited only if spent
// components have more than half of them: then the remaining components must keep `share` of their even share.
bool isKept(const Simplifier& s, VertexHandle v, Fit fit, std::size_t target, double share);
// Removes whole components from the mesh until `target` faces are left, or until no further component may go.
void removeComponents(Simplifier& s, std::size_t target);
// See SimplifiedLevel::removed.
std::vector<Ball> removedBalls(const Simplifier& s);
// See LevelMesh::growths.
Numbered<ComponentNumber, Growth> growths(const Simplifier& s);

// A copy of a level, so that it can be measured and fitted while the collapses go on.
struct Snapshot {
    TriangleSet<MeshVertexNumber> drawn;
    Numbered<TriangleCorner, VertexHandle> corners;       // the same triangles in vertices of the level's surface
    Numbered<VertexHandle, glm::vec3> positions;          // of the level's surface
    Numbered<SurfaceVertexNumber, VertexHandle> nearest;  // Simplifier::current
    std::vector<MeshVertexNumber> twins;
    std::vector<MeshVertexNumber> behind;               // those of `drawn` whose corners all lie behind; sorted
    std::vector<Ball> removed;                          // see SimplifiedLevel::removed
    Numbered<ComponentNumber, Growth> growths;          // see LevelMesh::growths
    Numbered<VertexHandle, ComponentNumber> growthsOf;  // empty without any
};

// snapshot.cpp: copies what compact() has left.
Snapshot snapshot(Simplifier& s, std::size_t primitiveCount);
// Makes the level of which `picture` is a copy. Its anchors are found only if `withAnchors` is set.
SimplifiedLevel described(const Origin& origin, const Snapshot& picture, bool withAnchors);

}  // namespace defocus::engine
