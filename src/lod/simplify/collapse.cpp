// The half-edge collapse on corners: two faces go, and the half-edges beyond them become each other's twins. And the
// clearing away of what is gone.

#include <utility>

#include "lod/simplify/state.h"

namespace defocus {

namespace {

// The face along `halfEdge` goes: what lies beyond its other two edges is joined.
void removeFace(Simplifier& s, std::uint32_t halfEdge) {
    if (halfEdge == Corner::none) return;
    LargeVector<Corner>& corners = s.faces.corners;
    const std::uint32_t a = corners[nextCorner(halfEdge)].twin;
    const std::uint32_t b = corners[previousCorner(halfEdge)].twin;
    if (a != Corner::none) corners[a].twin = b;
    if (b != Corner::none) corners[b].twin = a;
    corners[halfEdge / 3 * 3].vertex = Corner::none;
}

// The vertex across `halfEdge` is told of another corner if its first is in the face that goes.
void moveThird(Simplifier& s, std::uint32_t halfEdge) {
    if (halfEdge == Corner::none) return;
    const std::uint32_t third = previousCorner(halfEdge);
    SurfaceVertex& vertex = s.vertices[s.faces.corners[third].vertex];
    if (vertex.corner == third) vertex.corner = s.faces.corners[nextCorner(halfEdge)].twin;
}

// The first corner of the survivor, read before the faces go. Where either vertex is on a border, so is the survivor,
// and it begins where that border does.
std::uint32_t survivorsCorner(const Simplifier& s, const Edge& edge, std::uint32_t from, std::uint32_t to) {
    const LargeVector<Corner>& corners = s.faces.corners;
    const std::uint32_t firstFrom = s.vertices[from].corner;
    const std::uint32_t firstTo = s.vertices[to].corner;
    const bool fromBorder = corners[firstFrom].twin == Corner::none;
    const bool toBorder = corners[firstTo].twin == Corner::none;
    const bool fromsOwn = fromBorder && (!toBorder || edge.along == Corner::none);
    const std::uint32_t first = fromsOwn ? firstFrom : firstTo;

    // In a face that goes: the same edge's half-edge on the far side of the face.
    if (edge.along != Corner::none && first == nextCorner(edge.along)) return corners[previousCorner(edge.along)].twin;
    if (edge.back != Corner::none && (first == edge.back || first == nextCorner(edge.back)))
        return corners[previousCorner(edge.back)].twin;
    return first;
}

// The new number of each vertex that lives; none for others.
std::vector<std::uint32_t> compactVertices(Simplifier& s) {
    std::vector<std::uint32_t> numbers(s.vertexCount(), Corner::none);
    std::uint32_t count = 0;
    for (std::uint32_t v = 0; v < numbers.size(); ++v)
        if (s.isAlive(v)) numbers[v] = count++;
    const auto numberOf = [&](std::uint32_t v) {
        const std::uint32_t survivor = v == Corner::none ? v : survivorOf(s, v);
        return survivor == Corner::none ? survivor : numbers[survivor];
    };
    for (std::uint32_t& v : s.current) v = numberOf(v);
    for (std::uint32_t v = 0; v < numbers.size(); ++v) {
        if (numbers[v] == Corner::none) continue;
        Candidate candidate = s.candidates[v];
        candidate.to = numberOf(candidate.to);  // of an outdated one, what it stood for may be gone
        s.candidates[numbers[v]] = candidate;
        s.vertices[numbers[v]] = s.vertices[v];
        if (!s.componentOf.empty()) s.componentOf[numbers[v]] = s.componentOf[v];
    }
    for (std::uint32_t v = 0; v < count; ++v) s.survivors[v] = v;
    s.survivors.resize(count);
    s.candidates.resize(count);
    s.vertices.resize(count);
    if (!s.componentOf.empty()) s.componentOf.resize(count);
    return numbers;
}

void compactFaces(Simplifier& s, const std::vector<std::uint32_t>& vertexNumbers) {
    Faces& faces = s.faces;
    std::vector<std::uint32_t> numbers(faces.count(), Corner::none);
    std::uint32_t count = 0;
    forEachLiveFace(s, [&](std::uint32_t face) { numbers[face] = count++; });
    const auto numberOf = [&](std::uint32_t corner) {
        return corner == Corner::none ? corner : 3 * numbers[corner / 3] + corner % 3;
    };
    for (SurfaceVertex& vertex : s.vertices) vertex.corner = numberOf(vertex.corner);
    for (std::uint32_t face = 0; face < numbers.size(); ++face) {
        if (numbers[face] == Corner::none) continue;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Corner& corner = faces.corners[3 * face + i];
            faces.corners[3 * numbers[face] + i] = {vertexNumbers[corner.vertex], numberOf(corner.twin), corner.wedge};
        }
        faces.primitives[numbers[face]] = faces.primitives[face];
        faces.turned[numbers[face]] = faces.turned[face];
    }
    faces.corners.resize(3 * std::size_t{count});
    faces.primitives.resize(count);
    faces.turned.resize(count);
}

void compactWedges(Simplifier& s) {
    Faces& faces = s.faces;
    std::vector<std::uint32_t> numbers(faces.wedges.size(), Corner::none);
    for (const Corner& corner : faces.corners) numbers[corner.wedge] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t w = 0; w < numbers.size(); ++w) {
        if (numbers[w] == Corner::none) continue;
        numbers[w] = count++;
        faces.wedges[numbers[w]] = faces.wedges[w];
        s.attributeQuadrics[numbers[w]] = s.attributeQuadrics[w];
    }
    for (Corner& corner : faces.corners) corner.wedge = numbers[corner.wedge];
    faces.wedges.resize(count);
    s.attributeQuadrics.resize(count);
}

}  // namespace

void removeEdge(Simplifier& s, const Edge& edge, std::uint32_t from, std::uint32_t to) {
    s.vertices[to].corner = survivorsCorner(s, edge, from, to);
    s.vertices[from].corner = Corner::none;
    s.survivors[from] = to;
    for (const std::uint32_t side : {edge.along, edge.back}) {
        moveThird(s, side);
        removeFace(s, side);
    }
}

std::uint32_t survivorOf(Simplifier& s, std::uint32_t v) {
    while (v != Corner::none && s.survivors[v] != v) {
        const std::uint32_t next = s.survivors[v];
        if (next != Corner::none) s.survivors[v] = s.survivors[next];
        v = next;
    }
    return v;
}

void compact(Simplifier& s) {
    compactFaces(s, compactVertices(s));
    compactWedges(s);

    s.survivors.shrink_to_fit();
    s.componentOf.shrink_to_fit();
    s.faces.turned.shrink_to_fit();
    s.faces.primitives.shrink_to_fit();
    giveBackRoom(s.candidates);
    giveBackRoom(s.faces.wedges);
    giveBackRoom(s.vertices);
    giveBackRoom(s.faces.corners);
    giveBackRoom(s.attributeQuadrics);
}

}  // namespace defocus
