// Copies a level between two edge collapses. The copy stores the mesh vertex at each triangle corner. Also finds an
// anchor for each mesh vertex, the closest point on the level's surface.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

#include "lod/simplify/state.h"
#include "lod/simplify/triangle.h"

namespace defocus::engine {

namespace {

// ---- split the two sides of thin plates

// When the rim of a thin plate such as a fin has collapsed, the faces of its two sides share wedges (vertices with
// attributes). A single normal would point sideways and darken both sides. Such a wedge is split into one wedge per
// side, as Hoppe 1998 allows at any corner. At a texture seam, each side may already have its own wedge, but both
// wedges share a normal. All wedges that share a normal are therefore examined together.

// Min length of the mean of the unit face normals around a wedge, weighted by corner angle. A wedge with a shorter mean
// is split. The tip of a cone with an apex angle of 60° or more is not split.
constexpr double minResultant = 0.5;
constexpr int rounds = 3;  // iterations of k-means with two clusters of face normals

struct CornerNormal {
    TriangleCorner corner;
    // Normal of the corner's face, by the winding order of the mesh. cornerNormal() sets its length to twice the face's
    // area, and weighByAngle() to the angle at the corner.
    glm::dvec3 normal;
};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Returns true if all face normals are within 60° of the first face normal. For any corner angles as weights, the mean
// of the unit normals is then at least minResultant long, so no split is needed.
bool surelyAgree(std::span<const CornerNormal> corners) {
    const glm::dvec3& first = corners[0].normal;
    const double limit = minResultant * minResultant * glm::dot(first, first);
    return std::all_of(corners.begin(), corners.end(), [&](const CornerNormal& c) {
        const double along = glm::dot(first, c.normal);
        return along > 0 && along * along > limit * glm::dot(c.normal, c.normal);
    });
}

// Positions of a corner, and of the next and the previous corner in the winding order of the face.
struct CornerPlaces {
    glm::dvec3 own, next, previous;
};

using Corners = Numbered<TriangleCorner, HalfedgeHandle>;

CornerPlaces placesAt(const SurfaceMesh& mesh, const Corners& corners, TriangleCorner corner) {
    const auto place = [&](TriangleCorner c) { return mesh.place(mesh.from_vertex_handle(corners[c])); };
    return {place(corner), place(nextCorner(corner)), place(previousCorner(corner))};
}

CornerNormal cornerNormal(const CornerPlaces& at, TriangleCorner corner) {
    return {corner, glm::cross(at.next - at.own, at.previous - at.own)};
}

void weighByAngle(const CornerPlaces& at, CornerNormal& c) {
    const double length = glm::length(c.normal);
    c.normal *= length > 0 ? angleBetween(at.next - at.own, at.previous - at.own) / length : 0;
}

// Divides the corners around a vertex into the two sides of a thin plate. Moves the corners of the back side to the end
// of `corners`, and returns the index of the first moved corner. Returns the number of corners if no split is needed.
// `own` is the vertex's normal.
std::size_t splitSides(std::span<CornerNormal> corners, const glm::dvec3& own) {
    glm::dvec3 sum(0);
    double angles = 0;
    for (const CornerNormal& c : corners) {
        sum += c.normal;
        angles += glm::length(c.normal);
    }
    if (glm::length(sum) >= minResultant * angles) return corners.size();

    // Divide the face normals by k-means with two clusters. Start from the normal with the largest corner angle and
    // from the normal that differs most from it.
    const auto longer = [](const CornerNormal& a, const CornerNormal& b) {
        return glm::dot(a.normal, a.normal) < glm::dot(b.normal, b.normal);
    };
    glm::dvec3 front = std::max_element(corners.begin(), corners.end(), longer)->normal;
    glm::dvec3 back =
        std::min_element(corners.begin(), corners.end(), [&](const CornerNormal& a, const CornerNormal& b) {
            return glm::dot(a.normal, front) < glm::dot(b.normal, front);
        })->normal;
    const auto isFront = [&](const CornerNormal& c) {
        return glm::dot(c.normal, front) * glm::length(back) >= glm::dot(c.normal, back) * glm::length(front);
    };
    for (int round = 0; round < rounds; ++round) {
        glm::dvec3 nextFront(0);
        glm::dvec3 nextBack(0);
        for (const CornerNormal& c : corners) (isFront(c) ? nextFront : nextBack) += c.normal;
        front = nextFront;
        back = nextBack;
    }
    // The side whose normal is closer to the vertex's normal becomes the front.
    if (glm::dot(front, own) * glm::length(back) < glm::dot(back, own) * glm::length(front)) std::swap(front, back);
    const auto border = std::stable_partition(corners.begin(), corners.end(), isFront);
    return static_cast<std::size_t>(border - corners.begin());
}

// Index of a group of face corners whose vertices share a normal, in order of first use.
using NormalGroup = Number<struct NormalGroupKind>;
using CornersByNormal = Buckets<NormalGroup, TriangleCorner>;

CornersByNormal groupCorners(const Simplifier& s, const Corners& corners) {
    const WedgeTable& wedges = s.mesh->wedges;
    Numbered<MeshVertexNumber, NormalGroup> numbers(s.origin->smoothing.size());
    Numbered<WedgeNumber, NormalGroup> groupOf;
    groupOf.reserve(wedges.size());
    std::uint32_t count = 0;
    for (const auto w : numbersBelow<WedgeNumber>(wedges.size())) {
        NormalGroup& number = numbers[s.origin->smoothing[wedges.source(w)]];
        if (!number.isValid()) number = {count++};
        groupOf.push_back(number);
    }
    return {count, corners.size(), [&](TriangleCorner corner) { return groupOf[s.mesh->wedge(corners[corner])]; }};
}

// The mesh vertex at each face corner. Faces that share a vertex normal but point in opposite directions are treated as
// the two sides of a thin plate. If both sides use a mesh vertex, the vertex is duplicated for the back side.
struct Creases {
    Numbered<TriangleCorner, MeshVertexNumber> drawn;
    std::vector<MeshVertexNumber> behind;  // mesh vertices that only back sides use; sorted
};

Creases creases(Simplifier& s, const Corners& corners) {
    const SurfaceMesh& mesh = *s.mesh;
    Creases result;
    Numbered<TriangleCorner, MeshVertexNumber>& drawn = result.drawn;
    drawn.reserve(corners.size());
    for (const HalfedgeHandle corner : corners) drawn.push_back(mesh.wedges.source(mesh.wedge(corner)));

    const CornersByNormal groups = groupCorners(s, corners);
    std::vector<CornerNormal> around;
    std::vector<MeshVertexNumber> inFront;
    for (const NormalGroup group : groups.keys()) {
        around.clear();
        for (const TriangleCorner corner : groups[group])
            around.push_back(cornerNormal(placesAt(mesh, corners, corner), corner));
        if (around.size() < 2 || surelyAgree(around)) continue;
        for (CornerNormal& c : around) weighByAngle(placesAt(mesh, corners, c.corner), c);
        const MeshVertexNumber leader = s.origin->smoothing[drawn[around[0].corner]];
        const std::size_t kept = splitSides(around, s.origin->vertices.normals[leader.value]);
        if (kept == around.size() || kept == 0) continue;
        inFront.clear();
        for (const CornerNormal& c : std::span(around).first(kept)) inFront.push_back(drawn[c.corner]);
        for (const CornerNormal& c : std::span(around).subspan(kept)) {
            const MeshVertexNumber v = drawn[c.corner];
            if (std::find(inFront.begin(), inFront.end(), v) == inFront.end()) {
                result.behind.push_back(v);  // no duplicate needed: the front side does not use this vertex
                continue;
            }
            const auto [twin, isNew] =
                s.twinOf.try_emplace(v, itemAt<MeshVertexNumber>(s.origin->firstVertex.size() + s.twins.size()));
            if (isNew) s.twins.push_back(v);
            drawn[c.corner] = twin->second;
        }
    }
    std::sort(result.behind.begin(), result.behind.end());
    return result;
}

// ---- find the anchor of each mesh vertex, the closest point on the level

// Finds, for each vertex of the mesh, the closest point (anchor) of the simplified surface. The search for the closest
// face starts at the vertex onto which a removed vertex has collapsed.

constexpr std::size_t maxSteps = 12;          // max number of vertices visited on the way to the closest face
constexpr std::size_t maxFacesAround = 1024;  // max number of faces around a visited vertex; other vertices are skipped
constexpr double noDistance = 1e-24;          // smaller squared distances are rounding errors on a mesh of size 1
// A point lies perpendicularly above a face if the squared cosine between the face's normal and the offset to the point
// exceeds this value.
constexpr double minUpright = 0.99;
// If many mesh vertices collapsed onto one vertex, the closest point on the level is found only for every second,
// fourth, … of these vertices, but for at least this number of vertices.
constexpr std::uint32_t enoughAnchors = 16;

// The level's faces, and the face corners around each vertex.
struct FaceRings {
    const Snapshot& level;
    Numbered<VertexHandle, glm::dvec3> points;     // positions on the mesh scaled to unit size
    Numbered<TriangleNumber, glm::dvec3> normals;  // face normals with twice the area as length
    Buckets<VertexHandle, TriangleCorner> around;

    [[nodiscard]] const glm::dvec3& point(VertexHandle v) const { return points[v]; }
    [[nodiscard]] const glm::dvec3& point(TriangleCorner corner) const { return point(level.corners[corner]); }
};

FaceRings faceRings(const Snapshot& level, const Frame& frame) {
    FaceRings rings{level, {}, {}, {level.positions.size(), level.corners.size(), [&](TriangleCorner corner) {
                                        return level.corners[corner];
                                    }}};
    rings.points.reserve(level.positions.size());
    for (const glm::vec3& position : level.positions) rings.points.push_back(frame.point(position));
    rings.normals.reserve(level.drawn.count());
    for (const TriangleNumber face : level.drawn.numbers()) {
        const glm::dvec3& a = rings.point(cornerAt(face, 0));
        rings.normals.push_back(glm::cross(rings.point(cornerAt(face, 1)) - a, rings.point(cornerAt(face, 2)) - a));
    }
    return rings;
}

struct Closest {
    double squaredDistance = 0;
    TriangleCorner corner;  // corner of the closest face; invalid: the start vertex is the closest point
    // Barycentric weights, at the closest point, of the corners after and before `corner` in the face.
    glm::dvec2 along{0};
};

// Returns the vertex of `face` nearest to `p` that is not in `seen` and has at most maxFacesAround faces around it;
// invalid if there is none.
VertexHandle nearestUnseen(const FaceRings& rings, TriangleNumber face, const glm::dvec3& p,
                           std::span<const VertexHandle> seen) {
    VertexHandle nearest;
    double min = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < 3; ++i) {
        const VertexHandle v = rings.level.corners[cornerAt(face, i)];
        if (rings.around[v].size() > maxFacesAround || std::find(seen.begin(), seen.end(), v) != seen.end()) continue;
        const glm::dvec3 offset = p - rings.point(v);
        if (const double distance = glm::dot(offset, offset); distance < min) {
            min = distance;
            nearest = v;
        }
    }
    return nearest;
}

// Returns whether a query point lies perpendicularly above the interior of the face. `along` are the barycentric
// coordinates (Closest::along) of the face point closest to the query point. `offset` leads from the face point to the
// query point. `offset` is tested in addition to `along`, because rounding makes `along` unreliable for slivers.
bool liesBelow(const FaceRings& rings, TriangleNumber face, const glm::dvec2& along, const glm::dvec3& offset) {
    if (!(along.x > 0 && along.y > 0 && along.x + along.y < 1)) return false;
    const glm::dvec3& normal = rings.normals[face];
    const double height = glm::dot(offset, normal);
    return height * height >= minUpright * glm::dot(offset, offset) * glm::dot(normal, normal);
}

// Returns the point of the level's surface closest to `p`, starting near the vertex `start`. The search moves from the
// faces around one vertex to the faces around the corners of the closest face. It stops when the distance no longer
// decreases or `p` lies perpendicularly above a face. Only faces oriented towards `side` count, because both sides of a
// thin fin are at nearly the same position.
Closest closestTo(const FaceRings& rings, const glm::dvec3& p, VertexHandle start, const glm::dvec3& side) {
    Closest result;
    VertexHandle nearest = start;
    const glm::dvec3 away = p - rings.point(start);
    bool below = false;
    double min = glm::dot(away, away);
    std::array<VertexHandle, maxSteps> seen;
    for (std::size_t step = 0; step < maxSteps && nearest.is_valid(); ++step) {
        if (min <= (result.corner.isValid() ? noDistance : 0)) break;
        seen[step] = nearest;
        const glm::dvec3& a = rings.point(nearest);
        const glm::dvec3 fromA = p - a;
        for (const TriangleCorner corner : rings.around[nearest]) {
            const glm::dvec3& b = rings.point(nextCorner(corner));
            const glm::dvec3& c = rings.point(previousCorner(corner));
            if (glm::dot(b - a, fromA) <= 0 && glm::dot(c - a, fromA) <= 0) continue;  // the vertex itself is closest
            const TriangleNumber face = faceOf(corner);
            if (!(glm::dot(rings.normals[face], side) > 0)) continue;
            const glm::dvec2 along = closestCoordinates(p, a, b, c);
            const glm::dvec3 offset = fromA - along.x * (b - a) - along.y * (c - a);
            const double distance = glm::dot(offset, offset);
            if (!(distance < min)) continue;  // also skips NaN of degenerate faces
            min = distance;
            result.along = along;
            result.corner = corner;
            below = liesBelow(rings, face, along, offset);
            if (below) break;
        }
        if (!result.corner.isValid() || below) break;
        nearest = nearestUnseen(rings, faceOf(result.corner), p, std::span(seen.data(), step + 1));
    }
    result.squaredDistance = min;
    return result;
}

// Returns a stride n for each vertex of the level. Of the mesh vertices that collapsed onto the level's vertex, every
// n-th gets its own anchor (closest point on the level).
Numbered<VertexHandle, std::uint32_t> anchorStrides(const Origin& origin, const Snapshot& level) {
    Numbered<VertexHandle, std::uint32_t> strides(level.positions.size(), 0);
    for (const SurfaceVertexNumber v : origin.firstVertex)
        if (v.isValid() && level.nearest[v].is_valid()) ++strides[level.nearest[v]];
    for (std::uint32_t& stride : strides) stride = std::bit_floor(std::max(1u, stride / enoughAnchors));
    return strides;
}

// Returns the anchor of each mesh vertex: the closest point on the level, if it is on a face of the vertex's primitive.
// If many vertices collapsed onto one vertex, some share the anchor of another vertex. A vertex that no face uses has
// no anchor.
Numbered<MeshVertexNumber, Anchor> anchors(const Origin& origin, const Snapshot& level) {
    const FaceRings rings = faceRings(level, origin.frame);
    Numbered<MeshVertexNumber, TriangleCorner> cornerOf(origin.firstVertex.size() + level.twins.size());
    for (const TriangleCorner corner : level.drawn.indices.numbers()) cornerOf[level.drawn.indices[corner]] = corner;
    const Numbered<TriangleNumber, PrimitiveNumber> primitives = primitivesOf(level.drawn);

    Numbered<MeshVertexNumber, Anchor> result(origin.firstVertex.size());
    const Numbered<VertexHandle, std::uint32_t> strides = anchorStrides(origin, level);
    Numbered<VertexHandle, std::uint32_t> waiting(strides.size(), 0);
    // For each level vertex, the last mesh vertex that collapsed onto it and for which an anchor (point on the level)
    // was searched.
    Numbered<VertexHandle, MeshVertexNumber> lastOf(strides.size());
    for (const MeshVertexNumber own : result.numbers()) {
        const SurfaceVertexNumber v = origin.firstVertex[own];
        if (!v.isValid()) continue;
        Anchor& anchor = result[own];
        const VertexHandle survivor = level.nearest[v];
        if (!survivor.is_valid()) continue;
        const std::uint32_t stride = strides[survivor];
        if (waiting[survivor]++ % stride != 0) {
            anchor = Anchor::sharedWith(lastOf[survivor]);
            continue;
        }
        lastOf[survivor] = own;
        const glm::dvec3 side = origin.vertices.normals[own.value];
        const glm::dvec3 point = origin.frame.point(origin.vertices.positions[own.value]);
        const Closest closest = closestTo(rings, point, survivor, side);
        if (!closest.corner.isValid()) {
            const TriangleCorner corner = cornerOf[own];
            if (closest.squaredDistance != 0 || !corner.isValid()) continue;
            anchor.triangle = faceOf(corner);
            anchor.weight[corner.value % 3] = 1;
            continue;
        }
        if (primitives[faceOf(closest.corner)] != origin.firstPrimitive[own]) continue;
        anchor.triangle = faceOf(closest.corner);
        anchor.weight[closest.corner.value % 3] = static_cast<float>(1 - closest.along.x - closest.along.y);
        anchor.weight[nextCorner(closest.corner).value % 3] = static_cast<float>(closest.along.x);
        anchor.weight[previousCorner(closest.corner).value % 3] = static_cast<float>(closest.along.y);
    }
    return result;
}

// Records in `level` the removed components (connected parts) and the enlargement of the remaining ones. Does nothing
// unless components are enlarged to make up for lost area (Simplifier::grows).
void noteComponents(const Simplifier& s, Snapshot& level) {
    if (!s.grows) return;
    level.removed = removedBalls(s);
    level.growths = growths(s);
    level.growthsOf.reserve(s.mesh->n_vertices());
    forEachVertex(*s.mesh, [&](VertexHandle v) { level.growthsOf.push_back(s.mesh->data(v).component); });
}

}  // namespace

Snapshot snapshot(Simplifier& s, std::size_t primitiveCount) {
    const SurfaceMesh& mesh = *s.mesh;
    Snapshot level;
    level.positions.reserve(mesh.n_vertices());
    forEachVertex(mesh, [&](VertexHandle v) { level.positions.push_back(mesh.position(v)); });
    level.nearest = s.current;
    Numbered<TriangleCorner, HalfedgeHandle> corners;
    corners.reserve(3 * mesh.n_faces());
    level.drawn.primitiveIndexCounts.assign(primitiveCount, 0);
    forEachFace(mesh, [&](FaceHandle face) {
        level.drawn.primitiveIndexCounts[mesh.primitive(face)] += 3;
        const FaceCorners around = cornersOf(mesh, face);
        corners.insert(corners.end(), around.begin(), around.end());
        if (mesh.data(face).isTurned()) std::swap(corners.end()[-1], corners.end()[-2]);
    });
    Creases found = creases(s, corners);
    level.drawn.indices = std::move(found.drawn);
    level.behind = std::move(found.behind);
    level.corners.reserve(corners.size());
    for (const HalfedgeHandle corner : corners) level.corners.push_back(mesh.from_vertex_handle(corner));
    level.twins = s.twins;
    noteComponents(s, level);
    return level;
}

SimplifiedLevel described(const Origin& origin, const Snapshot& picture, bool withAnchors) {
    SimplifiedLevel level;
    if (withAnchors) level.anchors = anchors(origin, picture);
    level.mesh.triangles.primitiveIndexCounts = picture.drawn.primitiveIndexCounts;
    const std::size_t vertexCount = origin.firstVertex.size();
    Numbered<MeshVertexNumber, LevelVertexNumber> local(vertexCount + picture.twins.size());
    level.mesh.triangles.indices.reserve(picture.drawn.indices.size());
    level.removed = picture.removed;
    level.mesh.growths = picture.growths;
    for (const TriangleCorner corner : picture.drawn.indices.numbers()) {
        const MeshVertexNumber v = picture.drawn.indices[corner];
        if (!local[v].isValid()) {
            local[v] = level.numbers.next();
            const bool twin = indexOf(v) >= vertexCount;
            level.numbers.push_back(v);
            level.mesh.sources.push_back(twin ? picture.twins[indexOf(v) - vertexCount] : v);
            const bool behind = std::binary_search(picture.behind.begin(), picture.behind.end(), v);
            level.mesh.apart.push_back(twin || behind ? 1 : 0);
            if (!picture.growthsOf.empty()) level.mesh.growthsOf.push_back(picture.growthsOf[picture.corners[corner]]);
        }
        level.mesh.triangles.indices.push_back(local[v]);
    }
    return level;
}

}  // namespace defocus::engine
