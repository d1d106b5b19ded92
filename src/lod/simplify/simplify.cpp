// Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics. Each vertex waits for its cheapest
// collapse by cost alone, and whether it is allowed is only looked at when it comes up: while faces are many, in sweeps
// over memory that allow for more and more cost; then by a priority queue. What is gone is cleared away at each level.

#include "lod/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lod/simplify/state.h"

namespace defocus::engine {

namespace {

// A poor collapse is made when good ones cost this much more.
constexpr float poorPenalty = 10;
constexpr std::size_t minFacesToReport = 1000;  // fewer are gone before anyone looks
// Up to this many faces every collapse is known at its cost at any time; coarse levels are what one sees best.
constexpr std::size_t maxFacesToFollow = 8192;
// Down to this many faces collapses are made in sweeps.
constexpr std::size_t minFacesToSweep = 16'384;
constexpr std::size_t sweepsPerLevel = 8;   // each allows for one in so many of the collapses that are still wanted …
constexpr std::size_t minSweepShare = 128;  // … or of the faces, if that is more
constexpr std::size_t costSample = 8192;    // vertices whose costs tell those of all
// A further level must save a quarter of the triangles …
constexpr double largestShare = 0.75;
// … but leave this share of those that can still go: where many components are as small as they get, halving all would
// be at the cost of the few large ones.
constexpr double minShareOfMovable = 0.25;
// What is kept for components that can still go while others have most of the faces: so much of the share that their
// area has in the mesh's, less where the level would otherwise lack whole components.
constexpr double keptShare = 0.5;
constexpr double minKeptShare = 0.25;

void setCandidate(Simplifier& s, VertexHandle v, const Candidate& candidate) {
    Candidate& own = s.mesh->data(v).candidate;
    const bool before = own.harmless();
    own = candidate;
    if (s.components.empty() || candidate.harmless() == before) return;
    Component& component = s.componentAt(v);
    if (!before)
        ++component.harmless;
    else if (--component.harmless == 0)
        spend(s, v);
}

// Sets what the vertex waits for, in the queue once there is one.
void enqueue(Simplifier& s, VertexHandle v, const Candidate& candidate) {
    setCandidate(s, v, candidate);
    if (!s.queued) return;
    if (candidate.possible())
        s.queue.put(v, candidate.cost, candidate.fit == Fit::bad);
    else
        s.queue.take(v);
}

// Puts the vertex's cheapest collapse into the queue, unseen whether it is a good one.
void enqueueCheapest(Simplifier& s, VertexHandle v) {
    enqueue(s, v, s.modules->quadrics.cheapest(v));
}

// Puts the vertex's best collapse of those that are allowed into the queue; nothing if none is possible.
void enqueueBest(Simplifier& s, VertexHandle v) {
    Candidate best;
    best.fit = Fit::impossible;
    forEachSpoke(*s.mesh, v, [&](HalfedgeHandle spoke) {
        const Fit fit = judgeFaces(s, spoke);
        if (fit == Fit::impossible || (fit == Fit::bad && best.fit < Fit::bad)) return;
        const float cost = s.modules->quadrics.cost(spoke, std::numeric_limits<float>::infinity()) *
                           (fit == Fit::poor ? poorPenalty : 1);
        if (!(cost < best.cost) && (fit == Fit::bad || best.fit < Fit::bad)) return;
        if (!s.modules->shape.keepsTopology(spoke)) return;
        best = {spoke, cost, fit};
    });
    enqueue(s, v, best);
}

void fillQueue(Simplifier& s) {
    s.queued = true;
    s.queue.reset(s.mesh->n_vertices());
    forEachVertex(*s.mesh, [&](VertexHandle v) { enqueueCheapest(s, v); });
}

// From here on vertices wait in the queue for what they have waited for before.
void startQueue(Simplifier& s) {
    s.queued = true;
    s.queue.reset(s.mesh->n_vertices());
    forEachVertex(*s.mesh, [&](VertexHandle v) { enqueue(s, v, Candidate(s.mesh->data(v).candidate)); });
}

// The survivor, and its neighbours that would have collapsed onto it or onto what is gone, or not at all, look for
// their best anew. While faces are many, they do so when their turn comes: what they wait for has only become dearer,
// but for the few to which the survivor is nearer than what is gone.
void requeueAround(Simplifier& s, VertexHandle survivor) {
    SurfaceMesh& mesh = *s.mesh;
    const bool atOnce = s.liveFaces <= maxFacesToFollow;
    const auto outdate = [&](VertexHandle v) {
        Candidate& candidate = mesh.data(v).candidate;
        if (!atOnce && candidate.possible() && candidate.fit == Fit::good)
            candidate.outdated = true;
        else
            enqueueCheapest(s, v);
    };
    outdate(survivor);
    forEachSpoke(mesh, survivor, [&](HalfedgeHandle spoke) {
        const VertexHandle v = mesh.to_vertex_handle(spoke);
        const Candidate& candidate = mesh.data(v).candidate;
        // Half-edges that led to what is gone lead to the survivor now.
        const bool known =
            candidate.possible() && candidate.fit == Fit::good && mesh.to_vertex_handle(candidate.along) != survivor;
        if (!known) return outdate(v);
        if (!atOnce || candidate.outdated) return;
        const HalfedgeHandle back = mesh.opposite_halfedge_handle(spoke);
        if (const float cost = s.modules->quadrics.cost(back, candidate.cost); cost < candidate.cost)
            enqueue(s, v, {back, cost});
    });
}

void reportLoss(Simplifier& s) {
    s.facesAtReport = s.liveFaces - std::min(s.liveFaces, std::max(s.firstFaces / 100, minFacesToReport));
    s.lost(1 - static_cast<double>(s.liveFaces) / static_cast<double>(s.firstFaces));
}

void loseFace(Simplifier& s, VertexHandle v) {
    --s.liveFaces;
    if (s.liveFaces < s.facesAtReport) reportLoss(s);
    if (s.components.empty()) return;
    Component& component = s.componentAt(v);
    --component.faces;
    if (component.spent) --s.spentFaces;
}

// Applies the collapse that was judged last.
void collapse(Simplifier& s, HalfedgeHandle along) {
    const SurfaceMesh& mesh = *s.mesh;
    const VertexHandle from = mesh.from_vertex_handle(along);
    const VertexHandle to = mesh.to_vertex_handle(along);
    for (const HalfedgeHandle side : {along, mesh.opposite_halfedge_handle(along)})
        if (!mesh.is_boundary(side)) loseFace(s, from);
    collapseEdge(s, along);
    setCandidate(s, from, Candidate());
    requeueAround(s, to);
}

// Collapses in order of fit and cost until `floor` faces are left or nothing more is possible. `target` and `share`:
// see isKept.
void collapseTo(Simplifier& s, std::size_t floor, std::size_t target, double share) {
    bool collapsed = true;
    while (s.liveFaces > floor) {
        if (s.queue.empty()) {
            // A collapse may become possible by one two rings away, which nobody is told of: look once more everywhere.
            if (!collapsed) return;
            collapsed = false;
            fillQueue(s);
            continue;
        }
        const VertexHandle v = s.queue.takeBest();
        if (!s.queue.empty()) __builtin_prefetch(&s.mesh->data(s.queue.best()));
        const Candidate candidate = s.mesh->data(v).candidate;
        if (candidate.outdated) {
            enqueueCheapest(s, v);
            continue;
        }
        if (judgeCollapse(s, candidate.along, candidate.fit) > candidate.fit) {
            enqueueBest(s, v);
            continue;
        }
        if (isKept(s, v, candidate.fit, target, share)) continue;
        collapse(s, candidate.along);
        collapsed = true;
    }
}

// The cost that `rank` of the collapses that are not bad are cheaper than, about.
float costAtRank(const SurfaceMesh& mesh, std::size_t rank) {
    std::vector<float> costs;
    const std::size_t stride = 1 + mesh.n_vertices() / costSample;
    for (std::size_t v = 0; v < mesh.n_vertices(); v += stride)
        if (const Candidate& c = mesh.data(itemAt<VertexHandle>(v)).candidate; c.possible() && c.fit < Fit::bad)
            costs.push_back(c.cost);
    if (costs.size() <= rank / stride) return std::numeric_limits<float>::infinity();
    const auto place = costs.begin() + static_cast<std::ptrdiff_t>(rank / stride);
    std::nth_element(costs.begin(), place, costs.end());
    return *place;
}

// Makes the collapses that cost at most `most` and aren't bad, in the order of vertices, until `target` faces are left.
// Says whether there were any.
bool sweep(Simplifier& s, std::size_t target, float max) {
    if (s.mesh->n_vertices() == 0) return false;
    bool collapsed = false;
    const auto* const vertices = &s.mesh->data(VertexHandle(0));
    const auto count = static_cast<int>(s.mesh->n_vertices());
    for (int i = 0; i < count && s.liveFaces > target; ++i) {
        while (i < count && !(vertices[i].candidate.cost <= max)) ++i;  // most are too dear
        if (i == count) break;
        const VertexHandle v(i);
        const Candidate& candidate = vertices[i].candidate;
        const auto ready = [&] { return candidate.cost <= max && candidate.fit < Fit::bad && candidate.possible(); };
        if (!ready()) continue;
        if (candidate.outdated) enqueueCheapest(s, v);
        while (ready()) {
            if (judgeCollapse(s, candidate.along, candidate.fit) > candidate.fit) {
                enqueueBest(s, v);
                continue;
            }
            collapse(s, candidate.along);
            collapsed = true;
            break;
        }
    }
    return collapsed;
}

// The same as collapseTo, but for the order: while faces are many, vertices take turns as they lie in memory, sweep
// after sweep with a higher cost allowed. False if that leads no further.
bool sweepTo(Simplifier& s, std::size_t target) {
    while (s.liveFaces > target) {
        const std::size_t wanted = (s.liveFaces - target) / 2;
        const float max = costAtRank(*s.mesh, std::max(wanted / sweepsPerLevel, s.liveFaces / minSweepShare));
        if (!sweep(s, target, max) && !(max < std::numeric_limits<float>::infinity())) return false;
    }
    return true;
}

// Whether `least` is too near to so many faces for a level of its own.
bool isJustAbove(std::size_t faces, std::size_t min) {
    return faces > min && largestShare * static_cast<double>(faces) < static_cast<double>(min);
}

// How many faces the next level should have: half, or the least at once where half would come so near to it that no
// level fits between.
std::size_t nextTarget(const Simplifier& s, std::size_t minTriangles) {
    const std::size_t half = s.liveFaces / 2;
    return half <= minTriangles || isJustAbove(half, minTriangles) ? minTriangles : half;
}

// How many faces collapses should leave at least, of a level that should have `target`; `share`: see isKept.
std::size_t collapseFloor(const Simplifier& s, std::size_t target, double share) {
    const SurfaceMesh& mesh = *s.mesh;
    std::size_t stuck = 0;  // faces of whose vertices none can go: of tetrahedra, single triangles and the like
    Numbered<ComponentNumber, std::uint8_t> movable(s.components.size(), 0);  // has others
    forEachFace(mesh, [&](FaceHandle face) {
        const FaceCorners corners = cornersOf(mesh, face);
        const bool canGo = std::any_of(corners.begin(), corners.end(), [&](HalfedgeHandle corner) {
            return mesh.data(mesh.from_vertex_handle(corner)).candidate.possible();
        });
        if (!canGo)
            ++stuck;
        else if (!movable.empty())
            movable[mesh.data(mesh.from_vertex_handle(corners.at[0])).component] = 1;
    });
    const auto rest = static_cast<double>(s.liveFaces - stuck);
    double kept = minShareOfMovable * rest;
    if (movable.size() > 1) {
        double area = 0;
        for (const ComponentNumber c : movable.numbers()) area += movable[c] != 0 ? s.components[c].area : 0;
        kept = std::max(kept, std::min(rest, share * evenShare(s, area, target)));
    }
    return std::max(target, stuck + static_cast<std::size_t>(kept));
}

// Collapses until `target` faces are left, or somewhat more, up to `enough`, where the rest would be at the cost of the
// components that can still go.
void collapseToLevel(Simplifier& s, std::size_t target, std::size_t enough) {
    const std::size_t floor = collapseFloor(s, target, keptShare);
    s.queued = false;
    if (floor >= minFacesToSweep) sweepTo(s, floor);
    if (s.liveFaces <= floor) return;
    startQueue(s);
    collapseTo(s, floor, target, keptShare);
    if (s.liveFaces <= enough) return;
    startQueue(s);
    collapseTo(s, enough, target, minKeptShare);
}

// Why no level is tried from so many faces.
PyramidEnd endAt(std::size_t faces, const TriangleSet<MeshVertexNumber>& mesh, const SimplifyOptions& options) {
    if (faces == 0 && !mesh.indices.empty()) return PyramidEnd::noSurface;
    return faces <= options.minTriangles ? PyramidEnd::minTriangles : PyramidEnd::smallSaving;
}

std::size_t vertexCount(const SurfaceMesh& mesh) {
    std::size_t count = 0;
    forEachVertex(mesh, [&](VertexHandle) { ++count; });
    return count;
}

// Collapses until `wanted` vertices are left or nothing more is possible. A collapse takes one vertex, and one face or
// two.
void collapseToVertices(Simplifier& s, std::size_t wanted) {
    while (true) {
        const std::size_t vertices = vertexCount(*s.mesh);
        if (vertices <= wanted) return;
        const std::size_t before = s.liveFaces;
        const std::size_t target = before - std::min(before, vertices - wanted);
        s.queued = false;
        startQueue(s);
        collapseTo(s, target, target, keptShare);
        if (s.liveFaces == before) return;
    }
}

bool canCollapse(const Simplifier& s) {
    bool found = false;
    forEachVertex(*s.mesh, [&](VertexHandle v) { found = found || s.mesh->data(v).candidate.possible(); });
    return found;
}

}  // namespace

Simplification simplify(const Vertices& vertices, const WeldedPositions& positions, const VertexGroups& smoothing,
                        const TriangleSet<MeshVertexNumber>& triangles, const SimplifyOptions& options, Tasks& tasks,
                        const std::function<void(std::uint32_t, SimplifiedLevel)>& take) {
    Simplification result;
    Simplifier s;
    prepareSimplifier(s, vertices, positions, smoothing, triangles);
    result.repairedFaces = s.repairedFaces;
    if (options.lost) {
        s.lost = options.lost;
        s.firstFaces = s.facesAtReport = s.liveFaces;
    }

    const auto takePicture = [&] {
        compact(s);
        const auto picture = std::make_shared<Snapshot>(snapshot(s, triangles.primitiveIndexCounts.size()));
        tasks.add([origin = s.origin, picture, take, anchors = options.anchors, l = result.levelCount++] {
            SimplifiedLevel level = described(*origin, *picture, anchors);
            *picture = {};  // before what takes the most memory
            take(l, std::move(level));
        });
    };
    forEachVertex(*s.mesh, [&](VertexHandle v) { enqueueCheapest(s, v); });
    if (!options.vertexShares.empty()) {
        const auto all = static_cast<double>(vertexCount(*s.mesh));
        for (const double share : options.vertexShares) {
            const std::size_t before = s.liveFaces;
            collapseToVertices(s, static_cast<std::size_t>(std::ceil(share * all)));
            if (s.liveFaces == before || s.liveFaces == 0) {
                result.end = s.liveFaces == 0 ? PyramidEnd::noSurface : PyramidEnd::topology;
                break;
            }
            takePicture();
        }
        result.twins = s.twins;
        return result;
    }

    // Collapse, and take a picture whenever half of the triangles are gone.
    while (result.levelCount < static_cast<std::uint32_t>(std::max(0, options.maxLevels))) {
        const std::size_t target = nextTarget(s, options.minTriangles);
        const auto max = static_cast<std::size_t>(largestShare * static_cast<double>(s.liveFaces));
        if (target > max || s.liveFaces == 0) {
            result.end = endAt(s.liveFaces, triangles, options);
            break;
        }

        // Where parts that can be no smaller leave too little to the others, whole ones go; then collapses.
        if (s.liveFaces <= maxFacesToFollow && !isConnected(s)) findComponents(s, triangles);
        if (collapseFloor(s, target, minKeptShare) > max) {
            findComponents(s, triangles);
            s.grows = true;
            removeComponents(s, s.liveFaces - (collapseFloor(s, target, keptShare) - target));
        }
        if (collapseFloor(s, target, minKeptShare) <= max) collapseToLevel(s, target, max);

        // Where those came no further, whole parts go; where that isn't enough either, this is the end.
        const bool tooMany = s.liveFaces > max || isJustAbove(s.liveFaces, options.minTriangles);
        if (tooMany || manyAreSmallest(s)) {
            findComponents(s, triangles);
            s.grows = true;
        }
        if (tooMany) removeComponents(s, target);
        if (s.liveFaces > max) {
            result.end = s.components.size() > 1 && canCollapse(s) ? PyramidEnd::largestParts : PyramidEnd::topology;
            break;
        }
        takePicture();
    }
    result.twins = s.twins;
    return result;
}

}  // namespace defocus::engine
