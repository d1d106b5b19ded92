// Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics; half-edge collapses over OpenMesh's
// half-edges (Botsch, Steinberg, Bischoff and Kobbelt 2002). Each vertex waits for its cheapest collapse by cost alone,
// and whether it is allowed is only looked at when it comes up: while faces are many, in sweeps over memory that allow
// for more and more cost; then by a priority queue.

#include "lod/simplify.h"

#include <algorithm>
#include <memory>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

// A poor collapse is made when good ones cost this much more.
constexpr float poorPenalty = 10;
// Up to this many faces every collapse is known at its cost at any time; coarse levels are what one sees best.
constexpr std::size_t mostFacesToFollow = 8192;
// Down to this many faces collapses are made in sweeps.
constexpr std::size_t leastFacesToSweep = 16'384;
constexpr std::size_t sweepsPerLevel = 8;  // each allows for one in so many of the collapses that are still wanted …
constexpr std::size_t leastSweepShare = 128;  // … or of the faces, if that is more
constexpr std::size_t costSample = 8192;      // vertices whose costs tell those of all
// A further level must save a quarter of the triangles …
constexpr double largestShare = 0.75;
// … but leave this share of those that can still go: where many components are as small as they get, halving all would
// be at the cost of the few large ones.
constexpr double leastShareOfMovable = 0.25;

// What the vertex waits for, in the queue once there is one.
void enqueue(Simplifier& s, std::uint32_t v, const Candidate& candidate) {
    s.candidates[v] = candidate;
    if (!s.queued) return;
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
        const float cost =
            collapseCost(s, edge, std::numeric_limits<float>::infinity()) * (fit == Fit::poor ? poorPenalty : 1);
        if (!(cost < best.cost) && (fit == Fit::bad || best.fit < Fit::bad)) return;
        best = {edge, index(s.mesh.to_vertex_handle(edge)), cost, fit};
    });
    enqueue(s, v, best);
}

void fillQueue(Simplifier& s) {
    s.queued = true;
    s.queue.reset(s.points.size());
    for (std::uint32_t v = 0; v < s.points.size(); ++v)
        if (s.survivors[v] == v && !isRemoved(s, v)) enqueueCheapest(s, v);
}

// From here on vertices wait in the queue for what they have waited for before.
void startQueue(Simplifier& s) {
    s.queued = true;
    s.queue.reset(s.points.size());
    for (std::uint32_t v = 0; v < s.points.size(); ++v)
        if (s.survivors[v] == v && !isRemoved(s, v)) enqueue(s, v, Candidate(s.candidates[v]));
}

// The survivor, and its neighbours that would have collapsed onto it or onto what is gone, or not at all, look for
// their best anew. While faces are many, they do so when their turn comes: what they wait for has only become dearer,
// but for the few to which the survivor is nearer than what is gone.
void requeueAround(Simplifier& s, VertexHandle survivor, std::uint32_t gone) {
    const bool atOnce = s.liveFaces <= mostFacesToFollow;
    const auto outdate = [&](std::uint32_t v) {
        Candidate& candidate = s.candidates[v];
        if (!atOnce && candidate.edge.is_valid() && candidate.fit == Fit::good)
            candidate.outdated = true;
        else
            enqueueCheapest(s, v);
    };
    outdate(index(survivor));
    forEachOutgoing(s.mesh, survivor, [&](HalfedgeHandle edge) {
        const std::uint32_t v = index(s.mesh.to_vertex_handle(edge));
        const Candidate& candidate = s.candidates[v];
        const bool known = candidate.edge.is_valid() && candidate.fit == Fit::good && candidate.to != gone &&
                           candidate.to != index(survivor);
        if (!known) return outdate(v);
        if (!atOnce || candidate.outdated) return;
        const HalfedgeHandle back = s.mesh.opposite_halfedge_handle(edge);
        if (const float cost = collapseCost(s, back, candidate.cost); cost < candidate.cost)
            enqueue(s, v, {back, index(survivor), cost});
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
        if (old != retarget.wedge && s.wedges[old].quadric.squares.weight > 0) {
            addAttributeQuadric(s, old, retarget.wedge, step);
            s.wedges[old].quadric = {};
        }
        s.corners.vertex[retarget.corner] = to;
        s.corners.wedge[retarget.corner] = retarget.wedge;
    }
    s.quadrics[to].add(s.quadrics[from], step);
    s.survivors[from] = to;
    s.candidates[from] = Candidate();
    removeEdge(s.mesh, edge);
    requeueAround(s, survivor, from);
}

// What looking at the vertex's collapses begins with.
void prefetchVertex(const Simplifier& s, std::uint32_t v) {
    prefetch(&s.candidates[v]);
    prefetch(&s.points[v]);
    prefetch(&s.quadrics[v]);
    const HalfedgeHandle edge = s.mesh.halfedge_handle(vertexHandle(v));
    prefetch(&s.mesh.halfedge(edge));
}

// Collapses in order of fit and cost until `target` faces are left or nothing more is possible.
void collapseTo(Simplifier& s, std::size_t target) {
    bool collapsed = true;
    while (s.liveFaces > target) {
        if (s.queue.empty()) {
            // A collapse may become possible by one two rings away, which nobody is told of: look once more everywhere.
            if (!collapsed) return;
            collapsed = false;
            fillQueue(s);
            continue;
        }
        const std::uint32_t v = s.queue.takeBest();
        if (!s.queue.empty()) prefetchVertex(s, s.queue.best());
        const Candidate candidate = s.candidates[v];
        if (candidate.outdated) {
            enqueueCheapest(s, v);
            continue;
        }
        if (judgeCollapse(s, candidate.edge) > candidate.fit) {
            enqueueBest(s, v);
            continue;
        }
        collapse(s, candidate.edge);
        collapsed = true;
    }
}

// The cost that `rank` of the collapses that are not bad are cheaper than, about.
float costAtRank(const Simplifier& s, std::size_t rank) {
    std::vector<float> costs;
    const std::size_t stride = 1 + s.points.size() / costSample;
    for (std::size_t v = 0; v < s.points.size(); v += stride)
        if (const Candidate& c = s.candidates[v]; c.edge.is_valid() && c.fit < Fit::bad) costs.push_back(c.cost);
    if (costs.size() <= rank / stride) return std::numeric_limits<float>::infinity();
    const auto place = costs.begin() + static_cast<std::ptrdiff_t>(rank / stride);
    std::nth_element(costs.begin(), place, costs.end());
    return *place;
}

// Makes the collapses that cost at most `most` and aren't bad, in the order of vertices, until `target` faces are left.
// Says whether there were any.
bool sweep(Simplifier& s, const std::vector<std::uint32_t>& vertices, std::size_t target, float most) {
    bool collapsed = false;
    for (const std::uint32_t v : vertices) {
        if (s.liveFaces <= target) break;
        const auto ready = [&] {
            const Candidate& c = s.candidates[v];
            return c.cost <= most && c.fit < Fit::bad && c.edge.is_valid();
        };
        if (!ready()) continue;
        if (s.candidates[v].outdated) enqueueCheapest(s, v);
        while (ready()) {
            const Candidate candidate = s.candidates[v];
            if (judgeCollapse(s, candidate.edge) > candidate.fit) {
                enqueueBest(s, v);
                continue;
            }
            collapse(s, candidate.edge);
            collapsed = true;
            break;
        }
    }
    return collapsed;
}

// The same as collapseTo, but for the order: while faces are many, vertices take turns as they lie in memory, sweep
// after sweep with a higher cost allowed. False if that leads no further.
bool sweepTo(Simplifier& s, std::size_t target) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(s.liveFaces / 2 + 2);  // of a closed surface
    for (std::uint32_t v = 0; v < s.points.size(); ++v)
        if (s.survivors[v] == v && !isRemoved(s, v)) vertices.push_back(v);
    while (s.liveFaces > target) {
        const std::size_t wanted = (s.liveFaces - target) / 2;
        const float most = costAtRank(s, std::max(wanted / sweepsPerLevel, s.liveFaces / leastSweepShare));
        if (!sweep(s, vertices, target, most) && !(most < std::numeric_limits<float>::infinity())) return false;
    }
    return true;
}

std::uint32_t survivorOf(Simplifier& s, std::uint32_t v) {
    while (s.survivors[v] != v) v = s.survivors[v] = s.survivors[s.survivors[v]];
    return v;
}

// What is known of components once many are as small as they get.
void noteComponents(const Simplifier& s, Snapshot& level) {
    if (s.components.empty()) return;
    level.removed = removedBalls(s);
    level.growths = growths(s);
    for (std::uint32_t v = 0; v < s.points.size(); ++v)
        if (s.survivors[v] == v && !isRemoved(s, v)) level.growthsOf.push_back(s.componentOf[v]);
}

Snapshot snapshot(Simplifier& s, std::size_t primitiveCount) {
    Snapshot level;
    std::vector<std::uint32_t> numbers(s.points.size(), EdgeSide::none);
    level.points.reserve(s.liveFaces / 2 + 2);  // of a closed surface
    for (std::uint32_t v = 0; v < s.points.size(); ++v) {
        if (s.survivors[v] != v || isRemoved(s, v)) continue;
        numbers[v] = static_cast<std::uint32_t>(level.points.size());
        level.points.push_back(s.points[v]);
    }
    level.nearest.reserve(s.points.size());
    for (std::uint32_t v = 0; v < s.points.size(); ++v) level.nearest.push_back(numbers[survivorOf(s, v)]);

    Creases found = creases(s);
    level.primitiveIndexCounts.assign(primitiveCount, 0);
    level.wedges.reserve(3 * s.liveFaces);
    level.corners.reserve(3 * s.liveFaces);
    for (std::uint32_t face = 0; face < s.corners.primitive.size(); ++face) {
        if (!isAlive(s, face)) continue;
        for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
            level.wedges.push_back(found.wedges[corner]);
            level.corners.push_back(numbers[s.corners.vertex[corner]]);
        }
        level.primitiveIndexCounts[s.corners.primitive[face]] += 3;
    }
    level.twins = s.twins;
    level.behind = std::move(found.behind);
    noteComponents(s, level);
    return level;
}

SimplifiedLevel described(const Simplifier& s, const Snapshot& snapshot) {
    SimplifiedLevel level;
    level.anchors = anchors(s, snapshot);
    level.primitiveIndexCounts = snapshot.primitiveIndexCounts;
    const auto vertexCount = static_cast<std::uint32_t>(s.firstCorner.size());
    std::vector<std::uint32_t> local(vertexCount + snapshot.twins.size(), EdgeSide::none);
    level.mesh.indices.reserve(snapshot.wedges.size());
    level.removed = snapshot.removed;
    level.growths = snapshot.growths;
    for (std::size_t i = 0; i < snapshot.wedges.size(); ++i) {
        const std::uint32_t wedge = snapshot.wedges[i];
        if (local[wedge] == EdgeSide::none) {
            local[wedge] = static_cast<std::uint32_t>(level.numbers.size());
            const bool twin = wedge >= vertexCount;
            level.numbers.push_back(wedge);
            level.mesh.sources.push_back(twin ? snapshot.twins[wedge - vertexCount] : wedge);
            const bool behind = std::binary_search(snapshot.behind.begin(), snapshot.behind.end(), wedge);
            level.mesh.apart.push_back(twin || behind ? 1 : 0);
            if (!snapshot.growthsOf.empty()) level.growthsOf.push_back(snapshot.growthsOf[snapshot.corners[i]]);
        }
        level.mesh.indices.push_back(local[wedge]);
    }
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
    const std::size_t half = s.liveFaces / 2;
    const bool nearLeast = largestShare * static_cast<double>(half) < static_cast<double>(leastTriangles);
    return nearLeast ? leastTriangles : half;
}

// How many collapses should leave at least.
std::size_t collapseFloor(const Simplifier& s) {
    const std::size_t stuck = stuckFaces(s);
    return stuck + static_cast<std::size_t>(leastShareOfMovable * static_cast<double>(s.liveFaces - stuck));
}

}  // namespace

Simplification simplify(const Vertices& vertices, const Welded& positions, std::span<const std::uint32_t> smoothing,
                        const LevelTriangles& triangles, const SimplifyOptions& options, Tasks& tasks,
                        const std::function<void(std::uint32_t, SimplifiedLevel)>& take) {
    Simplification result;
    const auto s = std::make_shared<Simplifier>(prepareSimplifier(vertices, positions, triangles));
    result.repairedFaces = s->repairedFaces;
    rememberCorners(*s, vertices.count());
    s->smoothing = smoothing;

    // Collapse, and take a picture whenever half of the triangles are gone.
    s->candidates.resize(s->points.size());
    for (std::uint32_t v = 0; v < s->points.size(); ++v) enqueueCheapest(*s, v);
    while (result.levelCount < static_cast<std::uint32_t>(std::max(0, options.mostLevels))) {
        const std::size_t target = nextTarget(*s, options.leastTriangles);
        const std::size_t floor = std::max(target, collapseFloor(*s));
        const auto enough = static_cast<std::size_t>(largestShare * static_cast<double>(s->liveFaces));
        if (target > enough || s->liveFaces == 0) break;
        if (floor <= enough) {
            if (floor >= leastFacesToSweep) sweepTo(*s, floor);
            if (s->liveFaces > floor && !s->queued) startQueue(*s);
            collapseTo(*s, floor);
        }
        if (s->liveFaces > enough || manyAreSmallest(*s)) findComponents(*s, vertices, triangles);
        if (s->liveFaces > enough) removeComponents(*s, target);
        if (s->liveFaces > enough) break;
        const auto picture = std::make_shared<const Snapshot>(snapshot(*s, triangles.primitiveIndexCounts.size()));
        tasks.add([s, picture, take, l = result.levelCount++] { take(l, described(*s, *picture)); });
    }
    result.twins = s->twins;
    return result;
}

}  // namespace defocus
