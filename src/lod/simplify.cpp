// Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics; half-edge collapses over OpenMesh's
// half-edges (Botsch, Steinberg, Bischoff and Kobbelt 2002). One pass with a priority queue, which holds each vertex's
// cheapest collapse by cost alone, and whether it is allowed is only looked at when it comes up.

#include "lod/simplify.h"

#include <algorithm>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// A poor collapse is made when good ones cost this much more.
constexpr float poorPenalty = 10;
// A further level must save a quarter of the triangles …
constexpr double largestShare = 0.75;
// … but leave this share of those that can still go: where many components are as small as they get, halving all would
// be at the cost of the few large ones.
constexpr double leastShareOfMovable = 0.25;

void enqueue(Simplifier& s, std::uint32_t v, const Candidate& candidate) {
    s.candidates[v] = candidate;
    if (candidate.edge.is_valid())
        s.queue.put(v, candidate.cost, candidate.fit == Fit::bad);
    else
        s.queue.take(v);
}

// Puts the vertex's cheapest collapse into the queue, unseen whether it is a good one.
void enqueueCheapest(Simplifier& s, std::uint32_t v) {
    enqueue(s, v, cheapestCollapse(s, v));
}

// Puts the vertex's best collapse into the queue, all of them judged; nothing if none is possible.
void enqueueBest(Simplifier& s, std::uint32_t v) {
    Candidate best;
    best.fit = Fit::impossible;
    forEachOutgoing(s.mesh, vertexHandle(v), [&](HalfedgeHandle edge) {
        const Fit fit = judgeCollapse(s, edge);
        if (fit == Fit::impossible || (fit == Fit::bad && best.fit < Fit::bad)) return;
        const float cost = collapseCost(s, edge) * (fit == Fit::poor ? poorPenalty : 1);
        if (!(cost < best.cost) && (fit == Fit::bad || best.fit < Fit::bad)) return;
        best = {edge, cost, fit};
    });
    enqueue(s, v, best);
}

void fillQueue(Simplifier& s) {
    s.queue.reset(s.points.size());
    for (std::uint32_t v = 0; v < s.points.size(); ++v)
        if (s.survivors[v] == v) enqueueCheapest(s, v);
}

// The neighbours of the survivor: only the way to it has a new cost, unless the cheapest way led there or was refused.
void requeueAround(Simplifier& s, VertexHandle survivor) {
    enqueueCheapest(s, index(survivor));
    forEachOutgoing(s.mesh, survivor, [&](HalfedgeHandle edge) {
        const std::uint32_t v = index(s.mesh.to_vertex_handle(edge));
        const HalfedgeHandle back = s.mesh.opposite_halfedge_handle(edge);
        const Candidate& candidate = s.candidates[v];
        const VertexHandle chosen =
            candidate.edge.is_valid() ? s.mesh.to_vertex_handle(candidate.edge) : VertexHandle();
        const bool known = candidate.fit == Fit::good && chosen.is_valid() && chosen != survivor;
        if (!known)
            enqueueCheapest(s, v);
        else if (const float cost = collapseCost(s, back); cost < candidate.cost)
            enqueue(s, v, {back, cost, Fit::good});
    });
}

// `s.retargets` are this edge's.
void collapse(Simplifier& s, HalfedgeHandle edge) {
    const HalfedgeHandle opposite = s.mesh.opposite_halfedge_handle(edge);
    const std::uint32_t from = index(s.mesh.to_vertex_handle(opposite));
    const VertexHandle survivor = s.mesh.to_vertex_handle(edge);
    const std::uint32_t to = index(survivor);
    const glm::vec3 step(s.points[to] - s.points[from]);
    for (const HalfedgeHandle side : {edge, opposite})
        if (s.mesh.face_handle(side).is_valid()) --s.liveFaces;
    for (const Retarget& retarget : s.retargets) {
        const std::uint32_t old = s.corners.wedge[retarget.corner];
        if (old != retarget.wedge && s.attributeQuadrics[old].squares.weight > 0) {
            addAttributeQuadric(s, old, retarget.wedge, step);
            s.attributeQuadrics[old] = {};
        }
        s.corners.vertex[retarget.corner] = to;
        s.corners.wedge[retarget.corner] = retarget.wedge;
    }
    s.quadrics[to].add(s.quadrics[from], step);
    s.survivors[from] = to;
    removeEdge(s.mesh, edge);
    requeueAround(s, survivor);
}

// Collapses in order of fit and cost until `target` faces are left; false if nothing more is possible before.
bool collapseTo(Simplifier& s, std::size_t target) {
    bool collapsed = true;
    while (s.liveFaces > target) {
        if (s.queue.empty()) {
            // A collapse may become possible by one two rings away, which nobody is told of: look once more everywhere.
            if (!collapsed) return false;
            collapsed = false;
            fillQueue(s);
            continue;
        }
        const std::uint32_t v = s.queue.takeBest();
        const Candidate candidate = s.candidates[v];
        if (judgeCollapse(s, candidate.edge) > candidate.fit) {
            enqueueBest(s, v);
            continue;
        }
        collapse(s, candidate.edge);
        collapsed = true;
    }
    return true;
}

SimplifiedLevel snapshot(Simplifier& s, std::size_t primitiveCount) {
    SimplifiedLevel level;
    const std::vector<std::uint32_t> wedges = creasedWedges(s);
    level.triangles.primitiveIndexCounts.assign(primitiveCount, 0);
    level.triangles.indices.reserve(3 * s.liveFaces);
    for (std::uint32_t face = 0; face < s.corners.primitive.size(); ++face) {
        if (!isAlive(s, face)) continue;
        for (std::uint32_t i = 0; i < 3; ++i) level.triangles.indices.push_back(wedges[3 * face + i]);
        level.triangles.primitiveIndexCounts[s.corners.primitive[face]] += 3;
    }
    level.anchors = anchors(s, wedges);
    return level;
}

// Which surface vertex each mesh vertex is, before corners are handed over.
void rememberCorners(Simplifier& s, std::size_t vertexCount) {
    s.firstCorner.assign(vertexCount, EdgeSide::none);
    s.firstVertex.assign(vertexCount, 0);
    for (std::size_t corner = s.corners.wedge.size(); corner-- > 0;) {
        s.firstCorner[s.corners.wedge[corner]] = static_cast<std::uint32_t>(corner);
        s.firstVertex[s.corners.wedge[corner]] = s.corners.vertex[corner];
    }
}

// Faces of whose vertices none can go: of tetrahedra, single triangles and the like.
std::size_t stuckFaces(const Simplifier& s) {
    std::size_t count = 0;
    for (std::uint32_t face = 0; face < s.corners.primitive.size(); ++face) {
        if (!isAlive(s, face)) continue;
        const auto canGo = [&](std::uint32_t corner) { return s.candidates[s.corners.vertex[corner]].edge.is_valid(); };
        if (!canGo(3 * face) && !canGo(3 * face + 1) && !canGo(3 * face + 2)) ++count;
    }
    return count;
}

// How many faces the next level should have: half, or the least at once where half would come so near to it that no
// level fits between.
std::size_t nextTarget(const Simplifier& s, std::size_t leastTriangles) {
    const std::size_t stuck = stuckFaces(s);
    const auto kept = static_cast<std::size_t>(leastShareOfMovable * static_cast<double>(s.liveFaces - stuck));
    const std::size_t half = s.liveFaces / 2;
    const bool nearLeast = largestShare * static_cast<double>(half) < static_cast<double>(leastTriangles);
    return std::max(nearLeast ? leastTriangles : half, stuck + kept);
}

}  // namespace

Simplification simplify(const Vertices& vertices, const Welded& positions, const LevelTriangles& triangles,
                        const SimplifyOptions& options) {
    Simplification result;
    Simplifier s = prepareSimplifier(vertices, positions, triangles);
    result.repairedFaces = s.repairedFaces;
    rememberCorners(s, vertices.count());

    // Collapse, and take a picture whenever half of the triangles are gone.
    s.candidates.resize(s.points.size());
    fillQueue(s);
    while (result.levels.size() < static_cast<std::size_t>(std::max(0, options.mostLevels))) {
        const std::size_t before = s.liveFaces;
        const std::size_t target = nextTarget(s, options.leastTriangles);
        const auto enough = static_cast<std::size_t>(largestShare * static_cast<double>(before));
        if (target > enough || before == 0) break;
        const bool reached = collapseTo(s, target);
        if (s.liveFaces <= enough) result.levels.push_back(snapshot(s, triangles.primitiveIndexCounts.size()));
        if (!reached) break;
    }
    result.twins = std::move(s.twins);
    return result;
}

}  // namespace defocus
