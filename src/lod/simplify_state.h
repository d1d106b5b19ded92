#pragma once
// What simplify works on while it collapses. Private to simplify*.cpp, the only files that know OpenMesh.

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "lod/attribute_quadric.h"
#include "lod/collapse_queue.h"
#include "lod/corners.h"
#include "lod/quadric.h"
#include "lod/simplify.h"

namespace defocus {

// The collapse that a vertex waits for in the queue.
struct Candidate {
    OpenMesh::HalfedgeHandle edge;  // from the vertex to the survivor; invalid: none
    std::uint32_t to = 0;           // the survivor
    float cost = std::numeric_limits<float>::infinity();
    Fit fit = Fit::good;    // as far as it has been looked at
    bool outdated = false;  // no longer its best, or not at this cost
};

struct WedgeQuadric {
    AttributeRow row;  // attributes as lengths that weigh as much as distances do
    AttributeQuadric quadric;
};

// A part of the mesh that shares no position with the rest; see simplify_components.cpp.
struct Component {
    Ball ball;                    // around all that the mesh had of it
    double area = 0;              // object units; what the mesh had of it, and of all that it stands in for
    std::uint32_t primitive = 0;  // of one of its faces
    bool standsIn = false;        // for others that were removed
    bool removed = false;
};

struct Simplifier {
    OpenMesh::TriConnectivity mesh;  // vertex and face numbers are those of the manifold
    Corners corners;
    std::vector<glm::dvec3> points;  // of the vertices; the mesh's longest side is 1
    double scale = 0;                // object units per unit of `points`; 0: nothing to simplify
    std::vector<Quadric> quadrics;
    std::vector<WedgeQuadric> wedges;      // of each mesh vertex
    std::vector<std::uint32_t> survivors;  // for each vertex the one it collapsed onto, itself while it lives
    std::vector<Candidate> candidates;
    CollapseQueue queue;
    bool queued = false;  // vertices wait in it
    std::size_t liveFaces = 0;
    std::uint32_t repairedFaces = 0;
    std::vector<std::uint32_t> firstCorner;  // of each mesh vertex, as the mesh was; EdgeSide::none if it has no face
    std::vector<std::uint32_t> firstVertex;  // of each mesh vertex's first corner, as the mesh was

    std::span<const std::uint32_t> smoothing;                 // of each mesh vertex, see FitSource
    std::vector<std::uint32_t> twins;                         // see Simplification
    std::unordered_map<std::uint32_t, std::uint32_t> twinOf;  // mesh vertex → the number of its twin

    std::vector<Component> components;       // once many are as small as they get
    std::vector<std::uint32_t> componentOf;  // for each vertex; EdgeSide::none if none of its faces were left

    std::vector<OpenMesh::HalfedgeHandle> spokes;   // scratch of cheapestCollapse
    std::vector<std::uint32_t> facesFrom, facesTo;  // scratch of judgeCollapse
    std::vector<std::uint32_t> marks;               // the same, one a vertex: the markNumber that it has been seen with
    std::uint32_t markNumber = 0;
    std::vector<Retarget> retargets;  // the wedges that the collapse judged last hands over
};

// Asks the caches for what is needed soon: collapses come from all over the mesh.
inline void prefetch(const void* data) {
    __builtin_prefetch(data);
}

inline std::uint32_t index(OpenMesh::VertexHandle v) {
    return static_cast<std::uint32_t>(v.idx());
}
inline std::uint32_t index(OpenMesh::FaceHandle f) {
    return static_cast<std::uint32_t>(f.idx());
}
inline OpenMesh::VertexHandle vertexHandle(std::uint32_t v) {
    return OpenMesh::VertexHandle(static_cast<int>(v));
}

inline bool isAlive(const Simplifier& s, std::uint32_t face) {
    return s.mesh.halfedge_handle(OpenMesh::FaceHandle(static_cast<int>(face))).is_valid();
}

// Calls visit(half-edge) for every half-edge that leaves `v`, once around.
template <typename Visit>
void forEachOutgoing(const OpenMesh::TriConnectivity& mesh, OpenMesh::VertexHandle v, const Visit& visit) {
    const OpenMesh::HalfedgeHandle first = mesh.halfedge_handle(v);
    OpenMesh::HalfedgeHandle edge = first;
    do {
        visit(edge);
        edge = mesh.next_halfedge_handle(mesh.opposite_halfedge_handle(edge));
    } while (edge != first);
}

void facesAround(const Simplifier& s, OpenMesh::VertexHandle v, std::vector<std::uint32_t>& faces);

// simplify_setup.cpp: the mesh at unit size, its manifold in half-edges, quadrics; no queue yet.
Simplifier prepareSimplifier(const Vertices& vertices, const Welded& positions, const LevelTriangles& triangles);

// simplify_judge.cpp: how good a collapse along `edge` is, which sets Simplifier::retargets.
Fit judgeCollapse(Simplifier& s, OpenMesh::HalfedgeHandle edge);

// simplify_cost.cpp: what a good collapse along `edge` costs, or at least (where that is `most` or more), and the
// cheapest of those from `v` (an invalid edge if there is none).
float collapseCost(const Simplifier& s, OpenMesh::HalfedgeHandle edge, float most);
Candidate cheapestCollapse(Simplifier& s, std::uint32_t v);
// Adds the quadric of wedge `from` to that of `to`, `step` away.
void addAttributeQuadric(Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step);

// simplify_collapse.cpp: takes the vertex that `edge` leaves and the faces beside the edge out of the mesh, which the
// link condition allows.
void removeEdge(OpenMesh::TriConnectivity& mesh, OpenMesh::HalfedgeHandle edge);

// simplify_creases.cpp: the wedges of all corners; where the faces around those that share a normal look opposite ways,
// those on one side lie behind the others, and a wedge that is on both sides is split.
struct Creases {
    std::vector<std::uint32_t> wedges;  // of each corner; numbers from the mesh's vertex count on are twins
    std::vector<std::uint32_t> behind;  // those of whose corners all lie behind; sorted
};
Creases creases(Simplifier& s);

// simplify_components.cpp: are many faces of components that can be no smaller?
bool manyAreSmallest(const Simplifier& s);
// Finds the components, of what is left of the mesh, once.
void findComponents(Simplifier& s, const Vertices& vertices, const LevelTriangles& triangles);
// Takes whole ones out of the mesh until `target` faces are left, or nothing that may go.
void removeComponents(Simplifier& s, std::size_t target);
// Is the vertex, or the one it collapsed onto, of a component that was taken out?
bool isRemoved(const Simplifier& s, std::uint32_t v);
std::vector<Ball> removedBalls(const Simplifier& s);
// One a component; see SimplifiedLevel.
std::vector<Growth> growths(const Simplifier& s);

// A level as it was when the collapses had come to it, for what is found out about it while they go on.
struct Snapshot {
    std::vector<std::uint32_t> wedges;   // three a face; numbers from the mesh's vertex count on are twins
    std::vector<std::uint32_t> corners;  // the same in vertices of the level's surface, numbered from 0
    std::vector<std::uint32_t> primitiveIndexCounts;
    std::vector<glm::dvec3> points;      // of the level's surface
    std::vector<std::uint32_t> nearest;  // for each vertex of the mesh's surface, the level's that it collapsed onto,
                                         // or EdgeSide::none
    std::vector<std::uint32_t> twins;
    std::vector<std::uint32_t> behind;     // see Creases
    std::vector<Ball> removed;             // see SimplifiedLevel
    std::vector<Growth> growths;           // the same
    std::vector<std::uint32_t> growthsOf;  // of each of the level's vertices, into `growths`; empty without any
};

// simplify_anchors.cpp: the closest points to all mesh vertices, as far as they lie on faces of their own primitive and
// component.
// Reads nothing of `s` that collapses change.
std::vector<Anchor> anchors(const Simplifier& s, const Snapshot& level);

}  // namespace defocus
