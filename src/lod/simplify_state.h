#pragma once
// What simplify works on while it collapses. Private to simplify*.cpp, the only files that know OpenMesh.

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <unordered_map>
#include <vector>

#include "lod/attribute_quadric.h"
#include "lod/corners.h"
#include "lod/quadric.h"
#include "lod/simplify.h"

namespace defocus {

struct QueueEntry {
    double cost;
    std::uint32_t vertex;
    std::uint32_t version;
    bool bad;

    // For std::push_heap, whose top is the greatest: not bad, then lower cost, then lower number.
    bool operator<(const QueueEntry& other) const {
        if (bad != other.bad) return bad;
        if (cost != other.cost) return cost > other.cost;
        return vertex > other.vertex;
    }
};

// The collapse that a vertex waits for in the queue.
struct Candidate {
    OpenMesh::HalfedgeHandle edge;  // from the vertex to the survivor; invalid: none
    double cost = std::numeric_limits<double>::infinity();
    Fit fit = Fit::good;        // as far as it has been looked at
    std::uint32_t version = 0;  // entries of another version are stale
};

struct Simplifier {
    OpenMesh::TriConnectivity mesh;  // vertex and face numbers are those of the manifold
    Corners corners;
    std::vector<glm::dvec3> points;  // of the vertices; the mesh's longest side is 1
    double scale = 0;                // object units per unit of `points`; 0: nothing to simplify
    std::vector<Quadric> quadrics;
    std::vector<AttributeRow> rows;  // attributes of each mesh vertex, as lengths that weigh as much as distances do
    std::vector<AttributeQuadric> attributeQuadrics;  // of each mesh vertex
    std::vector<std::uint32_t> survivors;  // for each vertex the one it collapsed onto, itself while it lives
    std::vector<Candidate> candidates;
    std::vector<QueueEntry> queue;
    std::size_t liveFaces = 0;
    std::uint32_t repairedFaces = 0;
    std::vector<std::uint32_t> firstCorner;  // of each mesh vertex, as the mesh was; EdgeSide::none if it has no face
    std::vector<std::uint32_t> firstVertex;  // of each mesh vertex's first corner, as the mesh was

    std::vector<std::uint32_t> twins;                         // see Simplification
    std::unordered_map<std::uint32_t, std::uint32_t> twinOf;  // mesh vertex → the number of its twin

    std::vector<std::uint32_t> facesFrom, facesTo;  // scratch of judgeCollapse
    std::vector<Retarget> retargets;                // the wedges that the collapse judged last hands over
};

inline std::uint32_t index(OpenMesh::VertexHandle v) {
    return static_cast<std::uint32_t>(v.idx());
}
inline std::uint32_t index(OpenMesh::FaceHandle f) {
    return static_cast<std::uint32_t>(f.idx());
}
inline OpenMesh::VertexHandle vertexHandle(std::uint32_t v) {
    return OpenMesh::VertexHandle(static_cast<int>(v));
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

// simplify_judge.cpp: what a good collapse along `edge` costs, and how good it is; the latter sets
// Simplifier::retargets.
double collapseCost(const Simplifier& s, OpenMesh::HalfedgeHandle edge);
Fit judgeCollapse(Simplifier& s, OpenMesh::HalfedgeHandle edge);

// simplify_anchors.cpp: the closest points to all mesh vertices, as far as they lie on faces of their own primitive;
// `wedges` (one a corner) are the vertices that they name.
std::vector<Anchor> anchors(Simplifier& s, const std::vector<std::uint32_t>& wedges);

// simplify_creases.cpp: the wedges of all corners, split into two where the faces around one look opposite ways.
std::vector<std::uint32_t> creasedWedges(Simplifier& s);

}  // namespace defocus
