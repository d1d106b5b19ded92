#pragma once
// What simplify works on while it collapses. Private to simplify*.cpp and centre_tree.h.

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "lod/simplify/collapse_queue.h"
#include "lod/simplify/corners.h"
#include "lod/simplify/quadric.h"
#include "lod/simplify/simplify.h"

namespace defocus {

// The mesh at unit size, so that no weight depends on its scale.
struct Frame {
    glm::dvec3 centre{0};
    double inverse = 0;  // of the mesh's longest side; 0: it has none

    [[nodiscard]] glm::dvec3 point(const glm::vec3& position) const {
        return (glm::dvec3(position) - centre) * inverse;
    }
    [[nodiscard]] glm::dvec3 step(const glm::vec3& from, const glm::vec3& to) const {
        return (glm::dvec3(to) - glm::dvec3(from)) * inverse;
    }
};

// The surface before any collapse, as far as it is asked for later. `vertices` and `smoothing` are the caller's.
struct Origin {
    const Vertices& vertices;
    std::span<const std::uint32_t> smoothing;  // of each mesh vertex, see FitSource
    Frame frame;
    std::vector<std::uint32_t> firstVertex;     // of each mesh vertex's first corner; Corner::none if it has no face
    std::vector<std::uint32_t> firstPrimitive;  // the same
    std::vector<std::uint32_t> places;          // of each vertex of the surface: its welded position
};

struct alignas(64) SurfaceVertex {
    glm::vec3 position{0};
    // One at the vertex, from which all are reached by forEachCorner: at a border, the one whose half-edge has no twin.
    std::uint32_t corner = Corner::none;
    Quadric quadric;
    std::uint32_t mark = 0;  // scratch of judgeCollapse: the markNumber that it has been seen with
};

// The collapse that a vertex waits for in the queue.
struct Candidate {
    std::uint32_t to = Corner::none;  // the survivor, a neighbour; none: no collapse is possible
    float cost = std::numeric_limits<float>::infinity();
    Fit fit = Fit::good;    // as far as it has been looked at
    bool outdated = false;  // no longer its best, or not at this cost

    [[nodiscard]] bool possible() const { return to != Corner::none; }
    [[nodiscard]] bool harmless() const { return possible() && fit < Fit::bad; }
};

struct Spoke {
    Edge edge;
    std::uint32_t to = 0;
};

// A part of the mesh that shares no position with the rest; see simplify_components.cpp.
struct Component {
    Ball ball;                    // around all that the mesh had of it
    double area = 0;              // object units; what the mesh had of it, and of all that it stands in for
    std::uint32_t primitive = 0;  // of one of its faces
    std::size_t faces = 0;        // that live
    std::size_t harmless = 0;     // vertices that have a collapse that isn't bad, as far as they have been looked at
    bool spent = false;           // it had none once
    bool standsIn = false;        // for others that were removed
    bool removed = false;
};

// After compact() the arrays hold what lives and nothing else.
struct Simplifier {
    std::shared_ptr<const Origin> origin;
    Faces faces;
    LargeVector<AttributeQuadric> attributeQuadrics;  // one a wedge
    LargeVector<SurfaceVertex> vertices;
    LargeVector<Candidate> candidates;     // one a vertex
    std::vector<std::uint32_t> survivors;  // for each vertex the one it collapsed onto, itself while it lives, or
                                           // Corner::none if it was taken out with its component
    std::vector<std::uint32_t> current;    // for each vertex of Origin, the one that it is now or has collapsed onto
    CollapseQueue queue;
    bool queued = false;  // vertices wait in it
    std::size_t liveFaces = 0;
    std::uint32_t repairedFaces = 0;

    std::vector<std::uint32_t> twins;                         // see Simplification
    std::unordered_map<std::uint32_t, std::uint32_t> twinOf;  // mesh vertex → the number of its twin

    std::vector<Component> components;       // once faces are few or many components as small as they get
    std::vector<std::uint32_t> componentOf;  // for each vertex
    double area = 0;                         // object units; of all components
    bool grows = false;                      // small ones do, since many are as small as they get
    std::size_t spentFaces = 0;              // that live, of spent ones
    double spentArea = 0;                    // object units; of spent ones that are left

    // Scratch.
    std::vector<Spoke> spokes;                          // of cheapestCollapse and judgeCollapse
    std::vector<std::uint32_t> cornersFrom, cornersTo;  // of judgeCollapse
    std::uint32_t markNumber = 0;
    // What judgeCollapse finds out for the collapse that may follow.
    Edge edge;
    std::vector<Retarget> retargets;  // the wedges that are handed over

    [[nodiscard]] bool isAlive(std::uint32_t v) const { return survivors[v] == v; }
    [[nodiscard]] glm::dvec3 point(std::uint32_t v) const { return origin->frame.point(vertices[v].position); }
    [[nodiscard]] glm::dvec3 step(std::uint32_t from, std::uint32_t to) const {
        return origin->frame.step(vertices[from].position, vertices[to].position);
    }
    [[nodiscard]] std::size_t vertexCount() const { return vertices.size(); }
};

// Asks the caches for what is needed soon: collapses come from all over the mesh.
inline void prefetch(const void* data) {
    __builtin_prefetch(data);
}

// Calls visit(edge, neighbour) for every edge that leaves `v`.
template <typename Visit>
void forEachEdgeAround(const Simplifier& s, std::uint32_t v, const Visit& visit) {
    forEachEdge(s.faces, s.vertices[v].corner, visit);
}

template <typename Visit>
void forEachLiveFace(const Simplifier& s, const Visit& visit) {
    for (std::uint32_t face = 0; face < s.faces.count(); ++face)
        if (s.faces.isAlive(face)) visit(face);
}

// simplify_setup.cpp: the mesh's manifold with its quadrics; no candidates yet. Without a surface there are no
// vertices.
Simplifier prepareSimplifier(const Vertices& vertices, const Welded& positions,
                             std::span<const std::uint32_t> smoothing, const LevelTriangles& triangles);

// simplify_judge.cpp: how good the collapse of `from` onto its neighbour `to` is; sets Simplifier::edge and retargets.
Fit judgeCollapse(Simplifier& s, std::uint32_t from, std::uint32_t to);

// simplify_cost.cpp: what a good collapse costs, or at least (where that is `most` or more), and the cheapest of those
// from `v`.
float collapseCost(const Simplifier& s, const Edge& edge, std::uint32_t from, std::uint32_t to, float most);
Candidate cheapestCollapse(Simplifier& s, std::uint32_t v);
// Adds the quadric of wedge `from` to that of `to`, `step` away.
void addAttributeQuadric(Simplifier& s, std::uint32_t from, std::uint32_t to, const glm::vec3& step);

// simplify_collapse.cpp: takes the vertex `from` and the faces beside the edge out of the surface, which the link
// condition allows. Its corners in faces that stay must be those of `to` already.
void removeEdge(Simplifier& s, const Edge& edge, std::uint32_t from, std::uint32_t to);
// Numbers what lives anew, in the order it had, and gives back the memory of what is gone.
void compact(Simplifier& s);

// simplify_creases.cpp: the mesh vertices that all corners draw; where the faces around those that share a normal look
// opposite ways, those on one side lie behind the others, and a mesh vertex that is on both sides is split.
struct Creases {
    std::vector<std::uint32_t> wedges;  // of each corner; numbers from the mesh's vertex count on are twins
    std::vector<std::uint32_t> behind;  // those of whose corners all lie behind; sorted
};
Creases creases(Simplifier& s);

// simplify_components.cpp: do the faces hang together, by faces alone?
bool isConnected(const Simplifier& s);
// Are many faces of components that can be no smaller?
bool manyAreSmallest(const Simplifier& s);
// Finds the components, of what is left of the mesh, once.
void findComponents(Simplifier& s, const LevelTriangles& triangles);
// The vertex's component has no collapse left that isn't bad.
void spend(Simplifier& s, std::uint32_t v);
// What so much area would have of so many faces if they were spread evenly over the mesh's.
double evenShare(const Simplifier& s, double area, std::size_t faces);
// Whether there are too few faces for the vertex's collapse, of this fit, on the way to a level of `target` faces. A
// bad one leaves its component the even share of them. Others, where spent components have most of the faces, leave the
// rest `share` of theirs.
bool isKept(const Simplifier& s, std::uint32_t v, Fit fit, std::size_t target, double share);
// Takes whole ones out of the mesh until `target` faces are left, or nothing that may go.
void removeComponents(Simplifier& s, std::size_t target);
std::vector<Ball> removedBalls(const Simplifier& s);
// One a component; see SimplifiedLevel.
std::vector<Growth> growths(const Simplifier& s);

// The vertex that `v` is or has collapsed onto; Corner::none if that was taken out.
std::uint32_t survivorOf(Simplifier& s, std::uint32_t v);

// A level as it was when the collapses had come to it, for what is found out about it while they go on.
struct Snapshot {
    std::vector<std::uint32_t> wedges;   // three a face; numbers from the mesh's vertex count on are twins
    std::vector<std::uint32_t> corners;  // the same in vertices of the level's surface, numbered from 0
    std::vector<std::uint32_t> primitiveIndexCounts;
    std::vector<glm::vec3> positions;    // of the level's surface
    std::vector<std::uint32_t> nearest;  // Simplifier::current
    std::vector<std::uint32_t> twins;
    std::vector<std::uint32_t> behind;     // see Creases
    std::vector<Ball> removed;             // see SimplifiedLevel
    std::vector<Growth> growths;           // the same
    std::vector<std::uint32_t> growthsOf;  // of each of the level's vertices, into `growths`; empty without any
};

// simplify_anchors.cpp: the closest points to all mesh vertices, as far as they lie on faces of their own primitive and
// component.
std::vector<Anchor> anchors(const Origin& origin, const Snapshot& level);

}  // namespace defocus
