#pragma once
// Declares the state of simplify() during edge collapses, and the functions that change it. Private to this folder.

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

// Data of the original surface, before any collapse. Keeps references to `vertices` and `smoothing`, which must outlive
// this struct.
struct Origin {
    const Vertices& vertices;
    const VertexGroups& smoothing;
    Frame frame;
    // For each mesh vertex, the first surface vertex whose faces use the mesh vertex; invalid if no face uses it.
    Numbered<MeshVertexNumber, SurfaceVertexNumber> firstVertex;
    Numbered<MeshVertexNumber, PrimitiveNumber> firstPrimitive;  // primitive of each mesh vertex's first face
    Numbered<SurfaceVertexNumber, PositionNumber> places;
};

// A connected part of the mesh, which shares no vertex position with the rest; see components.cpp.
struct Component {
    Ball ball;  // bounding sphere of the component in the original mesh
    // Area in object units squared: the component's area in the original mesh, plus the areas of components that it
    // replaces.
    double area = 0;
    PrimitiveNumber primitive;  // primitive of the component's first face
    std::size_t faces = 0;      // number of remaining faces of the component
    // Number of vertices whose planned collapse is of class `good` or `poor` (simplify.h). A collapse that has not been
    // tested counts as good.
    std::size_t harmless = 0;
    bool spent = false;     // no planned collapse is good or poor any more (`harmless` is 0)
    bool standsIn = false;  // the component grows to make up for removed components
    bool removed = false;
};

struct Simplifier {
    std::shared_ptr<const Origin> origin;
    std::unique_ptr<SurfaceMesh> mesh;       // the surface; compact() removes its deleted elements
    std::optional<CollapseModules> modules;  // collapse modules that operate on `mesh`
    // For each vertex, the vertex onto which it collapsed, or itself if it is not deleted. Invalid if its component was
    // removed.
    Numbered<VertexHandle, VertexHandle> survivors;
    // For each vertex of the original surface, the vertex that represented it at the last compact().
    Numbered<SurfaceVertexNumber, VertexHandle> current;
    CollapseQueue queue;
    bool queued = false;  // true while `queue` is in use
    std::size_t liveFaces = 0;
    std::size_t firstFaces = 0;  // initial number of faces, for progress reports
    std::size_t facesAtReport = 0;
    // Receives the removed fraction of the initial faces, each time it has grown by at least 0.01.
    std::function<void(double)> lost;
    std::uint32_t repairedFaces = 0;

    std::vector<MeshVertexNumber> twins;  // copies of vertices, see Simplification::twins
    std::unordered_map<MeshVertexNumber, MeshVertexNumber> twinOf;

    // Connected parts of the mesh; found only when few faces are left or many components can shrink no further.
    Numbered<ComponentNumber, Component> components;
    double area = 0;             // total area of the components, object units squared
    bool grows = false;          // true if components are enlarged to make up for lost area
    std::size_t spentFaces = 0;  // number of faces of spent components (without good or poor collapses)
    double spentArea = 0;        // total area of the remaining spent components, object units squared

    [[nodiscard]] Component& componentAt(VertexHandle v) { return components[mesh->data(v).component]; }
    [[nodiscard]] const Component& componentAt(VertexHandle v) const { return components[mesh->data(v).component]; }
    [[nodiscard]] VertexHandle& survivor(VertexHandle v) { return survivors[v]; }
};

// Converts the triangles to a manifold mesh (Simplifier::mesh) and computes its quadrics (setup.cpp). Candidates for
// collapses are set later. If all triangles are degenerate, the mesh stays empty.
void prepareSimplifier(Simplifier& s, const Vertices& vertices, const WeldedPositions& positions,
                       const VertexGroups& smoothing, const TriangleSet<MeshVertexNumber>& triangles);

// Classifies the effect of a collapse on the surrounding faces and their wedges (vertices with attributes). Ignores the
// topology, which judgeCollapse() tests.
Fit judgeFaces(Simplifier& s, HalfedgeHandle along);
// Classifies a collapse like judgeFaces(), but returns Fit::impossible if the topology forbids it. The topology is
// tested last, and only if the collapse is not worse than `worst`. The test is slow: is_collapse_ok contains
// assertions, which are active in Debian's OpenMesh.
Fit judgeCollapse(Simplifier& s, HalfedgeHandle along, Fit worst);
// Collapses the half-edge and notifies the collapse modules. The topology must allow the collapse.
void collapseEdge(Simplifier& s, HalfedgeHandle along);
// Returns the vertex onto which `v` has collapsed directly or indirectly; `v` itself if it is not deleted, invalid if
// its component was removed.
VertexHandle survivorOf(Simplifier& s, VertexHandle v);
// Removes deleted elements from the mesh, renumbers the other elements in the same order, and frees the memory.
void compact(Simplifier& s);

// Returns whether all faces are connected through shared vertices (components.cpp). Separate vertices at the same
// position do not connect faces.
bool isConnected(const Simplifier& s);
// Returns whether more than a quarter of the faces are isolated triangles or belong to tetrahedra. No collapse can
// simplify these faces further.
bool manyAreSmallest(const Simplifier& s);
// Finds the components (connected parts) of the remaining mesh, unless they are already known.
void findComponents(Simplifier& s, const TriangleSet<MeshVertexNumber>& triangles);
// Marks the component of the vertex as spent: no good or poor collapse (simplify.h) is left in it.
void spend(Simplifier& s, VertexHandle v);
// Returns the number of faces that would lie on `area` if `faces` faces were distributed evenly over the area of the
// mesh.
double evenShare(const Simplifier& s, double area, std::size_t faces);
// Returns whether a collapse of the vertex, of class `fit` (good, poor or bad), must be skipped while simplifying to
// `target` faces. A bad collapse is skipped if the vertex's component would fall below its even share of `target`
// (evenShare). Good and poor collapses are skipped under two conditions: spent components (with only bad collapses
// left) have more than `target` / 2 faces, and the other components together would fall below `share` times their even
// share.
bool isKept(const Simplifier& s, VertexHandle v, Fit fit, std::size_t target, double share);
// Removes complete components (connected parts) until `target` faces are left or no further component may be removed.
void removeComponents(Simplifier& s, std::size_t target);
// Returns the bounding spheres of the removed components, for SimplifiedLevel::removed.
std::vector<Ball> removedBalls(const Simplifier& s);
// Returns how much each component is enlarged, for LevelMesh::growths. Components grow to make up for removed
// components, or if collapses have reduced them to a few faces.
Numbered<ComponentNumber, Growth> growths(const Simplifier& s);

// A copy of a level, from which other threads compute anchors and fit attributes while collapses continue.
struct Snapshot {
    TriangleSet<MeshVertexNumber> drawn;
    Numbered<TriangleCorner, VertexHandle> corners;       // surface vertex at each triangle corner
    Numbered<VertexHandle, glm::vec3> positions;          // positions of the surface vertices
    Numbered<SurfaceVertexNumber, VertexHandle> nearest;  // surviving vertex of each original surface vertex
    std::vector<MeshVertexNumber> twins;
    std::vector<MeshVertexNumber> behind;               // vertices that only the back of a thin plate uses; sorted
    std::vector<Ball> removed;                          // bounding spheres of the removed components
    Numbered<ComponentNumber, Growth> growths;          // enlargement of each component, for LevelMesh::growths
    Numbered<VertexHandle, ComponentNumber> growthsOf;  // component of each vertex; empty if no component grows
};

// Copies the current level (snapshot.cpp). compact() must have been called.
Snapshot snapshot(Simplifier& s, std::size_t primitiveCount);
// Makes a level from its snapshot `picture`. Computes anchors (level_fit.h) only if `withAnchors` is set.
SimplifiedLevel described(const Origin& origin, const Snapshot& picture, bool withAnchors);

}  // namespace defocus::engine
