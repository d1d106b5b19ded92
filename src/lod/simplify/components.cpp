// Parts of a mesh that touch nothing else: stones of a heap, leaves of a tree. Each can become no smaller than a
// tetrahedron or a triangle; from there on whole ones go, the smallest first, and their neighbours grow so that as much
// surface is seen as before (Cook, Halstead, Planck and Ryu 2007, Stochastic Simplification of Aggregate Detail).

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "lod/simplify/centre_tree.h"
#include "lod/simplify/state.h"

namespace defocus {

namespace {

constexpr double largestRatio = 1.2;      // of sizes that count as equal when the smallest go first
constexpr double mostLarger = 4;          // a neighbour this many times as large stands in for nothing: it would swell
constexpr double manyShare = 0.25;        // of the faces
constexpr std::uint32_t fewestFaces = 4;  // of what collapses can't make smaller: a tetrahedron
constexpr std::uint32_t noComponent = Corner::none;

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t v) {
    while (parents[v] != v) v = parents[v] = parents[parents[v]];
    return v;
}

void join(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
    parents[rootOf(parents, a)] = rootOf(parents, b);
}

// Which vertices hang together by faces: a forest.
std::vector<std::uint32_t> joinedByFaces(const Simplifier& s) {
    std::vector<std::uint32_t> parents(s.vertexCount());
    std::iota(parents.begin(), parents.end(), 0u);
    forEachLiveFace(s, [&](std::uint32_t face) {
        join(parents, s.faces.corners[3 * face].vertex, s.faces.corners[3 * face + 1].vertex);
        join(parents, s.faces.corners[3 * face].vertex, s.faces.corners[3 * face + 2].vertex);
    });
    return parents;
}

// Which vertices hang together, by faces, collapses or an equal position: the root of each.
std::vector<std::uint32_t> joinedVertices(const Simplifier& s) {
    std::vector<std::uint32_t> parents = joinedByFaces(s);
    for (std::uint32_t v = 0; v < parents.size(); ++v) join(parents, v, s.survivors[v]);
    // Cuts of the manifold leave several vertices at one position.
    const std::vector<std::uint32_t>& places = s.origin->places;
    std::vector<std::uint32_t> seen(places.empty() ? 0 : 1 + *std::max_element(places.begin(), places.end()),
                                    noComponent);  // a vertex that was at each position
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (seen[places[v]] == noComponent) seen[places[v]] = s.current[v];
        join(parents, s.current[v], seen[places[v]]);
    }
    for (std::uint32_t v = 0; v < parents.size(); ++v) parents[v] = rootOf(parents, v);
    return parents;
}

double areaOf(const Vertices& vertices, const std::uint32_t* corner) {
    const glm::dvec3 a = vertices.positions[corner[0]];
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(vertices.positions[corner[1]]) - a,
                                                     glm::dvec3(vertices.positions[corner[2]]) - a));
    return std::isfinite(area) ? area : 0;
}

// Of all that the mesh had of them, whatever is left.
void measureComponents(Simplifier& s, const LevelTriangles& triangles) {
    const Vertices& vertices = s.origin->vertices;
    const std::vector<std::uint32_t>& firstVertex = s.origin->firstVertex;
    const auto componentAt = [&](std::uint32_t v) {
        return firstVertex[v] == Corner::none ? noComponent : s.componentOf[s.current[firstVertex[v]]];
    };
    std::vector<Bounds> boxes(s.components.size());
    for (std::uint32_t v = 0; v < firstVertex.size(); ++v)
        if (const std::uint32_t c = componentAt(v); c != noComponent)
            boxes[c].extend(glm::dvec3(vertices.positions[v]));
    for (std::size_t c = 0; c < boxes.size(); ++c) s.components[c].ball.centre = boxes[c].centre();
    for (std::uint32_t v = 0; v < firstVertex.size(); ++v) {
        const std::uint32_t c = componentAt(v);
        if (c == noComponent) continue;
        Ball& ball = s.components[c].ball;
        ball.radius = std::max(ball.radius, glm::distance(glm::dvec3(vertices.positions[v]), ball.centre));
    }
    for (std::size_t i = 0; i + 2 < triangles.indices.size(); i += 3)
        if (const std::uint32_t c = componentAt(triangles.indices[i]); c != noComponent)
            s.components[c].area += areaOf(vertices, &triangles.indices[i]);
    for (const Component& component : s.components) s.area += component.area;
}

// What lives of them.
void countComponents(Simplifier& s) {
    forEachLiveFace(s,
                    [&](std::uint32_t face) { ++s.components[s.componentOf[s.faces.corners[3 * face].vertex]].faces; });
    for (std::uint32_t v = 0; v < s.vertexCount(); ++v)
        if (s.isAlive(v) && s.candidates[v].harmless()) ++s.components[s.componentOf[v]].harmless;
    for (std::uint32_t v = 0; v < s.vertexCount(); ++v)
        if (s.isAlive(v) && s.components[s.componentOf[v]].harmless == 0) spend(s, v);
}

// Spreads equal sizes over the mesh, whatever order they come in.
std::uint32_t scattered(std::uint32_t c) {
    c = (c ^ (c >> 16)) * 0x7feb352du;
    c = (c ^ (c >> 15)) * 0x846ca68bu;
    return c ^ (c >> 16);
}

// What may go, smallest first: all but the largest component and those that collapses can still make smaller.
struct Removable {
    std::uint32_t component = 0;
    std::size_t size = 0;  // class; grows
    std::vector<std::uint32_t> faces;
};

std::vector<Removable> removableComponents(const Simplifier& s) {
    std::vector<Removable> all(s.components.size());
    std::vector<std::uint8_t> movable(s.components.size(), 0);
    forEachLiveFace(s, [&](std::uint32_t face) {
        const std::uint32_t c = s.componentOf[s.faces.corners[3 * face].vertex];
        all[c].faces.push_back(face);
        for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner)
            if (s.candidates[s.faces.corners[corner].vertex].possible()) movable[c] = 1;
    });
    std::uint32_t largest = 0;
    for (std::uint32_t c = 1; c < s.components.size(); ++c)
        if (s.components[c].ball.radius > s.components[largest].ball.radius) largest = c;

    std::vector<Removable> removable;
    for (std::uint32_t c = 0; c < all.size(); ++c) {
        if (c == largest || movable[c] != 0 || s.components[c].removed) continue;
        all[c].component = c;
        removable.push_back(std::move(all[c]));
    }
    const auto radius = [&](const Removable& r) { return s.components[r.component].ball.radius; };
    std::sort(removable.begin(), removable.end(),
              [&](const Removable& a, const Removable& b) { return radius(a) < radius(b); });
    for (auto begin = removable.begin(); begin != removable.end();) {
        const auto end = std::find_if(begin, removable.end(),
                                      [&](const Removable& r) { return radius(r) > largestRatio * radius(*begin); });
        std::sort(begin, end, [](const Removable& a, const Removable& b) {
            return scattered(a.component) < scattered(b.component);
        });
        const auto size = static_cast<std::size_t>(begin - removable.begin());
        std::for_each(begin, end, [&](Removable& r) { r.size = size; });
        begin = end;
    }
    return removable;
}

// The vertex across the half-edge from its face; none at a border.
std::uint32_t vertexBeyond(const Simplifier& s, std::uint32_t halfEdge) {
    const std::uint32_t twin = s.faces.corners[halfEdge].twin;
    return twin == Corner::none ? Corner::none : s.faces.corners[previousCorner(twin)].vertex;
}

// Is the face a triangle of its own, or one of a tetrahedron?
bool isSmallest(const Simplifier& s, std::uint32_t face) {
    const std::uint32_t apex = vertexBeyond(s, 3 * face);
    return vertexBeyond(s, 3 * face + 1) == apex && vertexBeyond(s, 3 * face + 2) == apex;
}

void removeComponent(Simplifier& s, const Removable& removable) {
    for (const std::uint32_t face : removable.faces) {
        for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner)
            s.survivors[s.faces.corners[corner].vertex] = Corner::none;
        s.faces.corners[3 * face].vertex = Corner::none;
    }
    s.liveFaces -= removable.faces.size();
    Component& component = s.components[removable.component];
    if (component.spent) {
        s.spentFaces -= component.faces;
        s.spentArea -= component.area;
    }
    component.faces = 0;
    component.removed = true;
}

}  // namespace

bool isConnected(const Simplifier& s) {
    std::vector<std::uint32_t> parents = joinedByFaces(s);
    std::uint32_t first = noComponent;
    bool connected = true;
    forEachLiveFace(s, [&](std::uint32_t face) {
        const std::uint32_t root = rootOf(parents, s.faces.corners[3 * face].vertex);
        if (first == noComponent) first = root;
        connected = connected && root == first;
    });
    return connected;
}

bool manyAreSmallest(const Simplifier& s) {
    std::size_t count = 0;
    forEachLiveFace(s, [&](std::uint32_t face) { count += isSmallest(s, face) ? 1 : 0; });
    return static_cast<double>(count) > manyShare * static_cast<double>(s.liveFaces);
}

void findComponents(Simplifier& s, const LevelTriangles& triangles) {
    if (!s.components.empty()) return;
    const std::vector<std::uint32_t> roots = joinedVertices(s);
    std::vector<std::uint32_t> numbers(roots.size(), noComponent);
    forEachLiveFace(s, [&](std::uint32_t face) {
        std::uint32_t& number = numbers[roots[s.faces.corners[3 * face].vertex]];
        if (number != noComponent) return;
        number = static_cast<std::uint32_t>(s.components.size());
        s.components.emplace_back().primitive = s.faces.primitives[face];
    });
    s.componentOf.reserve(roots.size());
    for (const std::uint32_t root : roots) s.componentOf.push_back(numbers[root]);
    measureComponents(s, triangles);
    countComponents(s);
}

void spend(Simplifier& s, std::uint32_t v) {
    Component& component = s.components[s.componentOf[v]];
    if (component.spent) return;
    component.spent = true;
    s.spentFaces += component.faces;
    s.spentArea += component.area;
}

double evenShare(const Simplifier& s, double area, std::size_t faces) {
    return area / s.area * static_cast<double>(faces);
}

bool isKept(const Simplifier& s, std::uint32_t v, Fit fit, std::size_t target, double share) {
    if (s.components.empty()) return false;
    const Component& component = s.components[s.componentOf[v]];
    if (fit == Fit::bad) return static_cast<double>(component.faces) <= evenShare(s, component.area, target);
    if (component.spent || 2 * s.spentFaces <= target) return false;
    const auto rest = static_cast<double>(s.liveFaces - s.spentFaces);
    return rest <= share * evenShare(s, s.area - s.spentArea, target);
}

void removeComponents(Simplifier& s, std::size_t target) {
    std::vector<Removable> rest = removableComponents(s);
    const CentreTree tree(s.components);

    // A class of sizes after the other. What has taken another's place stays until all of its class have had their
    // turn, so that they thin out evenly.
    for (std::size_t begin = 0; begin < rest.size() && s.liveFaces > target;) {
        std::size_t end = begin;
        while (end < rest.size() && rest[end].size == rest[begin].size) ++end;
        std::vector<std::uint32_t> turn;
        for (std::size_t i = begin; i < end; ++i) turn.push_back(static_cast<std::uint32_t>(i));
        while (!turn.empty() && s.liveFaces > target) {
            std::vector<std::uint8_t> stays(s.components.size(), 0);
            std::vector<std::uint32_t> later;
            for (const std::uint32_t i : turn) {
                if (s.liveFaces <= target) break;
                Component& gone = s.components[rest[i].component];
                if (stays[rest[i].component] != 0) {
                    later.push_back(i);
                    continue;
                }
                removeComponent(s, rest[i]);
                const std::uint32_t heir = tree.nearest(gone.ball.centre, [&](std::uint32_t c) {
                    const Component& other = s.components[c];
                    return !other.removed && other.primitive == gone.primitive &&
                           other.ball.radius <= mostLarger * gone.ball.radius;
                });
                if (heir == noComponent) continue;
                s.components[heir].area += gone.area;
                if (s.components[heir].spent) s.spentArea += gone.area;
                s.components[heir].standsIn = true;
                stays[heir] = 1;
            }
            turn = std::move(later);
        }
        begin = end;
    }
}

std::vector<Ball> removedBalls(const Simplifier& s) {
    std::vector<Ball> balls;
    for (const Component& component : s.components)
        if (component.removed) balls.push_back(component.ball);
    return balls;
}

std::vector<Growth> growths(const Simplifier& s) {
    const CentreTree tree(s.components);
    std::vector<Growth> result(s.components.size());
    for (std::uint32_t c = 0; c < result.size(); ++c) {
        const Component& own = s.components[c];
        if (own.removed || !(own.standsIn || own.faces <= fewestFaces) || !(own.ball.radius > 0)) continue;
        const std::uint32_t next = tree.nearest(own.ball.centre, [&](std::uint32_t other) { return other != c; });
        if (next == noComponent) continue;
        const double reach = glm::distance(own.ball.centre, s.components[next].ball.centre);
        result[c] = {own.ball.centre, own.area, std::max(1.0, reach / own.ball.radius)};
    }
    return result;
}

}  // namespace defocus
