// Simplifies a mesh by edge collapses (Garland and Heckbert 1997, Surface Simplification Using Quadric Error Metrics).
// Each vertex has a candidate: its cheapest collapse. Whether a candidate is allowed is tested only immediately before
// its collapse is performed. Meshes with many faces are swept in memory order, with an increasing limit for the cost of
// collapses. With fewer faces, a priority queue orders the collapses. Deleted elements are removed at each level.

#include "lod/simplify/simplify.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lod/simplify/state.h"

namespace defocus::engine {

namespace {

// Factor on the cost of poor collapses, which make a sliver or pull the surface away from a seam or border
// (simplify.h).
constexpr float poorPenalty = 10;
constexpr std::size_t minFacesToReport = 1000;  // meshes with fewer faces report no progress
// Up to this number of faces, the costs of all candidates (planned collapses) are updated after every collapse. Levels
// with so few faces are coarse, and errors are most visible at coarse levels.
constexpr std::size_t maxFacesToFollow = 8192;
// Levels with at least this many faces are made by sweeps over all vertices, which are faster than a queue.
constexpr std::size_t minFacesToSweep = 16'384;
constexpr std::size_t sweepsPerLevel = 8;   // one sweep makes about 1/8 of the collapses that a level still needs
constexpr std::size_t minSweepShare = 128;  // one sweep makes at least one collapse per 128 faces, if possible
constexpr std::size_t costSample = 8192;    // number of vertices sampled to estimate the distribution of costs
// Max ratio between the triangle counts of a level and of the next finer level: each level must save a quarter of the
// triangles.
constexpr double largestShare = 0.75;
// At each level, the components (connected parts) that can still be simplified must together keep at least this
// fraction of their faces. If many components are already as small as possible, halving the total would otherwise take
// too many faces from the few large components.
constexpr double minShareOfMovable = 0.25;
// The same components must together keep at least this fraction of their even share of the faces. The even share
// distributes the faces of a level in proportion to area (evenShare). `keptShare` is preferred; `minKeptShare` applies
// if components would otherwise have to be removed.
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

// Sets the candidate (planned collapse) of a vertex, and updates the queue if the queue is in use.
void enqueue(Simplifier& s, VertexHandle v, const Candidate& candidate) {
    setCandidate(s, v, candidate);
    if (!s.queued) return;
    if (candidate.possible())
        s.queue.put(v, candidate.cost, candidate.fit == Fit::bad);
    else
        s.queue.take(v);
}

// Sets the vertex's candidate (planned collapse) to its cheapest collapse, without testing whether it is allowed.
void enqueueCheapest(Simplifier& s, VertexHandle v) {
    enqueue(s, v, s.modules->quadrics.cheapest(v));
}

// Sets the vertex's candidate (planned collapse) to its best allowed collapse; invalid if none is possible.
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

// Fills the queue with the candidates (planned collapses) of all vertices.
void startQueue(Simplifier& s) {
    s.queued = true;
    s.queue.reset(s.mesh->n_vertices());
    forEachVertex(*s.mesh, [&](VertexHandle v) { enqueue(s, v, Candidate(s.mesh->data(v).candidate)); });
}

// After a collapse, updates the candidates (planned collapses) of the surviving vertex and of affected neighbours. A
// neighbour is affected if its candidate led to the surviving or the removed vertex, or if it had no good candidate.
// While the mesh has many faces, affected candidates are only marked as outdated, and updated when their turn comes. A
// collapse raises most costs, and a raised cost is updated before it is used. Costs fall only for the few neighbours
// that are closer to the surviving vertex than to the removed vertex; their collapses may come late.
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
        // The candidate's cost is unchanged unless its half-edge leads to the surviving vertex. Half-edges that led to
        // the removed vertex now lead there, too.
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

// Performs the collapse of half-edge `along`, which must be the collapse that was evaluated last.
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

// Performs collapses in order of cost, with bad collapses (simplify.h) last, until `floor` faces are left or no
// collapse is possible. See isKept for `target` and `share`.
void collapseTo(Simplifier& s, std::size_t floor, std::size_t target, double share) {
    bool collapsed = true;
    while (s.liveFaces > floor) {
        if (s.queue.empty()) {
            // A collapse can make another collapse possible two edges away, where candidates (planned collapses) are
            // not updated. Retry all vertices once.
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

// Returns the approximate cost of the `rank`-th cheapest collapse among those rated good or poor (simplify.h).
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

// Performs good and poor collapses (as defined in simplify.h) with a cost of at most `max`, in vertex order, until
// `target` faces are left. Returns true if any collapse was performed.
bool sweep(Simplifier& s, std::size_t target, float max) {
    if (s.mesh->n_vertices() == 0) return false;
    bool collapsed = false;
    const auto* const vertices = &s.mesh->data(VertexHandle(0));
    const auto count = static_cast<int>(s.mesh->n_vertices());
    for (int i = 0; i < count && s.liveFaces > target; ++i) {
        // Skip all vertices whose candidates (planned collapses) are too expensive.
        while (i < count && !(vertices[i].candidate.cost <= max)) ++i;
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

// Performs collapses until `target` faces are left, as collapseTo does, but faster for many faces: sweeps visit the
// vertices in memory order, with an increasing cost limit. Returns false if no further collapse is possible.
bool sweepTo(Simplifier& s, std::size_t target) {
    while (s.liveFaces > target) {
        const std::size_t wanted = (s.liveFaces - target) / 2;
        const float max = costAtRank(*s.mesh, std::max(wanted / sweepsPerLevel, s.liveFaces / minSweepShare));
        if (!sweep(s, target, max) && !(max < std::numeric_limits<float>::infinity())) return false;
    }
    return true;
}

// Returns whether `faces` exceeds `min` by so little that a level with `min` faces would save less than a quarter of
// the faces.
bool isJustAbove(std::size_t faces, std::size_t min) {
    return faces > min && largestShare * static_cast<double>(faces) < static_cast<double>(min);
}

// Returns the target number of faces of the next level: half of the current number. Returns `minTriangles` if half of
// the number is below this minimum, or so little above it that no further level fits in between.
std::size_t nextTarget(const Simplifier& s, std::size_t minTriangles) {
    const std::size_t half = s.liveFaces / 2;
    return half <= minTriangles || isJustAbove(half, minTriangles) ? minTriangles : half;
}

// Returns the number of faces that collapses must leave for a level with `target` faces. See isKept for `share`.
std::size_t collapseFloor(const Simplifier& s, std::size_t target, double share) {
    const SurfaceMesh& mesh = *s.mesh;
    std::size_t stuck = 0;  // number of faces without a collapsible vertex, as in tetrahedra or isolated triangles
    Numbered<ComponentNumber, std::uint8_t> movable(s.components.size(), 0);  // 1: the component can be simplified
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

// Collapses edges until `target` faces are left. Stops earlier, at `enough` faces or fewer, if reaching `target` would
// take too many faces from the components that can still be simplified.
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

// Returns the reason why no further level is made from a mesh with this number of faces.
PyramidEnd endAt(std::size_t faces, const TriangleSet<MeshVertexNumber>& mesh, const SimplifyOptions& options) {
    if (faces == 0 && !mesh.indices.empty()) return PyramidEnd::noSurface;
    return faces <= options.minTriangles ? PyramidEnd::minTriangles : PyramidEnd::smallSaving;
}

std::size_t vertexCount(const SurfaceMesh& mesh) {
    std::size_t count = 0;
    forEachVertex(mesh, [&](VertexHandle) { ++count; });
    return count;
}

// Collapses edges until `wanted` vertices are left or no collapse is possible. A collapse removes one vertex and one or
// two faces.
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
            *picture = {};  // free the snapshot before the largest allocations
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

    // Collapse edges, and copy a level each time the number of triangles has halved.
    while (result.levelCount < static_cast<std::uint32_t>(std::max(0, options.maxLevels))) {
        const std::size_t target = nextTarget(s, options.minTriangles);
        const auto max = static_cast<std::size_t>(largestShare * static_cast<double>(s.liveFaces));
        if (target > max || s.liveFaces == 0) {
            result.end = endAt(s.liveFaces, triangles, options);
            break;
        }

        // If many components (connected parts) are already as small as possible, too few faces may be left for the
        // other components. In that case, remove complete components before collapsing.
        if (s.liveFaces <= maxFacesToFollow && !isConnected(s)) findComponents(s, triangles);
        if (collapseFloor(s, target, minKeptShare) > max) {
            findComponents(s, triangles);
            s.grows = true;
            removeComponents(s, s.liveFaces - (collapseFloor(s, target, keptShare) - target));
        }
        if (collapseFloor(s, target, minKeptShare) <= max) collapseToLevel(s, target, max);

        // If collapses did not reach the target, remove complete components; if removals do not suffice, end the
        // pyramid.
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
