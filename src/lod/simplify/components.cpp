// Removes small components from a mesh that edge collapses cannot simplify further. A component shares no vertex
// position with the rest, like a stone in a heap or a leaf on a tree. Edge collapses reduce a component at best to a
// tetrahedron or a triangle. If a level still has too many faces, complete components are removed, the smallest first.
// A neighbour of each removed component grows to preserve the visible area (Cook, Halstead, Planck and Ryu 2007,
// Stochastic Simplification of Aggregate Detail).

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <nanoflann.hpp>
#include <numeric>
#include <span>

#include "core/hash.h"
#include "lod/simplify/state.h"

namespace defocus::engine {

namespace {

constexpr double largestRatio = 1.2;  // components with radii within this ratio are removed in random order
// Max radius of the neighbour that grows to make up for a removed component, relative to the removed component.
constexpr double maxEnlargement = 4;
// manyAreSmallest() returns true if more than this fraction of the faces are in tetrahedra or isolated triangles.
constexpr double manyShare = 0.25;
constexpr std::uint32_t fewestFaces = 4;  // min number of faces of a closed component: a tetrahedron

// Disjoint sets of vertices (union-find).
class Forest {
public:
    explicit Forest(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

    [[nodiscard]] VertexHandle root(VertexHandle v) {
        int i = v.idx();
        while (parent(i) != i) i = parent(i) = parent(parent(i));
        return VertexHandle(i);
    }
    void join(VertexHandle a, VertexHandle b) {
        const int rootOfA = root(a).idx();
        parent(rootOfA) = root(b).idx();
    }

private:
    [[nodiscard]] int& parent(int i) { return parents_[static_cast<std::size_t>(i)]; }

    std::vector<int> parents_;
};

VertexHandle firstVertexOf(const SurfaceMesh& mesh, FaceHandle face) {
    return mesh.from_vertex_handle(mesh.halfedge_handle(face));
}

Forest joinedByFaces(const SurfaceMesh& mesh) {
    Forest forest(mesh.n_vertices());
    forEachFace(mesh, [&](FaceHandle face) {
        const FaceCorners corners = cornersOf(mesh, face);
        const VertexHandle first = mesh.from_vertex_handle(corners.at[0]);
        forest.join(first, mesh.from_vertex_handle(corners.at[1]));
        forest.join(first, mesh.from_vertex_handle(corners.at[2]));
    });
    return forest;
}

// Returns the sets of vertices that are connected by faces, by collapses or by equal positions.
Forest joinedVertices(const Simplifier& s) {
    Forest forest = joinedByFaces(*s.mesh);
    for (const VertexHandle v : s.survivors.numbers()) forest.join(v, s.survivors[v]);
    // Join vertices at the same position. Cutting non-manifold edges has separated such vertices.
    const Numbered<SurfaceVertexNumber, PositionNumber>& places = s.origin->places;
    const std::size_t placeCount = places.empty() ? 0 : 1 + indexOf(*std::max_element(places.begin(), places.end()));
    Numbered<PositionNumber, VertexHandle> seen(placeCount);
    for (const SurfaceVertexNumber v : places.numbers()) {
        VertexHandle& first = seen[places[v]];
        if (!first.is_valid()) first = s.current[v];
        forest.join(s.current[v], first);
    }
    return forest;
}

double areaOf(const Vertices& vertices, std::span<const MeshVertexNumber, 3> corners) {
    const auto position = [&](std::size_t i) { return glm::dvec3(vertices.positions[corners[i].value]); };
    const double area = 0.5 * glm::length(glm::cross(position(1) - position(0), position(2) - position(0)));
    return std::isfinite(area) ? area : 0;
}

// Measures the bounding sphere and the area of each component (connected part) in the original mesh, before any
// collapse.
void measureComponents(Simplifier& s, const TriangleSet<MeshVertexNumber>& triangles) {
    const Vertices& vertices = s.origin->vertices;
    const Numbered<MeshVertexNumber, SurfaceVertexNumber>& firstVertex = s.origin->firstVertex;
    const auto componentOf = [&](MeshVertexNumber v) {
        return firstVertex[v].isValid() ? s.mesh->data(s.current[firstVertex[v]]).component : ComponentNumber();
    };
    Numbered<ComponentNumber, Bounds> boxes(s.components.size());
    for (const MeshVertexNumber v : firstVertex.numbers())
        if (const ComponentNumber c = componentOf(v); c.isValid())
            boxes[c].extend(glm::dvec3(vertices.positions[v.value]));
    for (const ComponentNumber c : boxes.numbers()) s.components[c].ball.centre = boxes[c].centre();
    for (const MeshVertexNumber v : firstVertex.numbers()) {
        const ComponentNumber c = componentOf(v);
        if (!c.isValid()) continue;
        Ball& ball = s.components[c].ball;
        ball.radius = std::max(ball.radius, glm::distance(glm::dvec3(vertices.positions[v.value]), ball.centre));
    }
    for (const TriangleNumber t : triangles.numbers())
        if (const ComponentNumber c = componentOf(triangles.corners(t)[0]); c.isValid())
            s.components[c].area += areaOf(vertices, triangles.corners(t));
    for (const Component& component : s.components) s.area += component.area;
}

// For each component, counts the remaining faces and the vertices whose planned collapse is good or poor (simplify.h).
void countComponents(Simplifier& s) {
    const SurfaceMesh& mesh = *s.mesh;
    forEachFace(mesh, [&](FaceHandle face) { ++s.componentAt(firstVertexOf(mesh, face)).faces; });
    forEachVertex(mesh, [&](VertexHandle v) {
        if (mesh.data(v).candidate.harmless()) ++s.componentAt(v).harmless;
    });
    forEachVertex(mesh, [&](VertexHandle v) {
        if (s.componentAt(v).harmless == 0) spend(s, v);
    });
}

// A component (connected part of the mesh) that may be removed.
struct Removable {
    ComponentNumber component;
    std::size_t size = 0;  // rank by size, ascending; equal for components of similar size
    std::vector<FaceHandle> faces;
};

// Returns the components that may be removed, smallest first. The largest component and components that edge collapses
// can still simplify must stay.
std::vector<Removable> removableComponents(const Simplifier& s) {
    const SurfaceMesh& mesh = *s.mesh;
    Numbered<ComponentNumber, Removable> all(s.components.size());
    Numbered<ComponentNumber, std::uint8_t> movable(s.components.size(), 0);
    forEachFace(mesh, [&](FaceHandle face) {
        const ComponentNumber c = mesh.data(firstVertexOf(mesh, face)).component;
        all[c].faces.push_back(face);
        for (const HalfedgeHandle corner : cornersOf(mesh, face))
            if (mesh.data(mesh.from_vertex_handle(corner)).candidate.possible()) movable[c] = 1;
    });
    ComponentNumber largest{0};
    for (const ComponentNumber c : s.components.numbers())
        if (s.components[c].ball.radius > s.components[largest].ball.radius) largest = c;

    std::vector<Removable> removable;
    for (const ComponentNumber c : all.numbers()) {
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
        // Shuffle components of similar size, so that removals are spread over the mesh.
        std::sort(begin, end, [](const Removable& a, const Removable& b) {
            return lowbias32(a.component.value) < lowbias32(b.component.value);
        });
        const auto size = static_cast<std::size_t>(begin - removable.begin());
        std::for_each(begin, end, [&](Removable& r) { r.size = size; });
        begin = end;
    }
    return removable;
}

// Returns the third vertex of the face on the other side of the half-edge; invalid at a border.
VertexHandle vertexBeyond(const SurfaceMesh& mesh, HalfedgeHandle halfedge) {
    return mesh.opposite_he_opposite_vh(halfedge);
}

// Returns whether the face is an isolated triangle or belongs to a tetrahedron.
bool isSmallest(const SurfaceMesh& mesh, FaceHandle face) {
    const FaceCorners corners = cornersOf(mesh, face);
    const VertexHandle apex = vertexBeyond(mesh, corners.at[0]);
    return vertexBeyond(mesh, corners.at[1]) == apex && vertexBeyond(mesh, corners.at[2]) == apex;
}

void removeComponent(Simplifier& s, const Removable& removable) {
    SurfaceMesh& mesh = *s.mesh;
    for (const FaceHandle face : removable.faces) {
        for (const HalfedgeHandle corner : cornersOf(mesh, face)) {
            const VertexHandle v = mesh.from_vertex_handle(corner);
            s.survivor(v) = VertexHandle();
            mesh.status(v).set_deleted(true);
            mesh.status(mesh.edge_handle(corner)).set_deleted(true);
        }
        mesh.status(face).set_deleted(true);
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

// k-d tree of component centres that finds the nearest component which meets a condition. For 50,000 centres, nanoflann
// takes two thirds of the time of a simple median-split tree.
class CentreTree {
public:
    // Builds the tree of all components that have not been removed. Keeps a reference to `components`.
    explicit CentreTree(const Numbered<ComponentNumber, Component>& components)
        : centres_(components), tree_(3, centres_) {}
    CentreTree(const CentreTree&) = delete;
    CentreTree& operator=(const CentreTree&) = delete;

    // Returns the component with the nearest centre for which counts(component) is true; invalid if none is found.
    // `point` is in object units. The search ends after maxVisits components, even if none of them meets the condition.
    template <typename Counts>
    [[nodiscard]] ComponentNumber nearest(const glm::dvec3& point, const Counts& counts) const {
        Search<Counts> search(centres_.numbers, counts);
        tree_.findNeighbors(search, &point.x, nanoflann::SearchParams());
        return search.best;
    }

private:
    static constexpr std::uint32_t maxVisits = 4096;

    // Adapter that gives nanoflann access to the component centres.
    struct Centres {
        const Numbered<ComponentNumber, Component>& components;
        std::vector<ComponentNumber> numbers;

        explicit Centres(const Numbered<ComponentNumber, Component>& all) : components(all) {
            for (const ComponentNumber c : all.numbers())
                if (!all[c].removed) numbers.push_back(c);
        }
        [[nodiscard]] std::size_t kdtree_get_point_count() const { return numbers.size(); }
        [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
            return components[numbers[i]].ball.centre[static_cast<glm::length_t>(axis)];
        }
        template <typename Box>
        bool kdtree_get_bbox(Box&) const {
            return false;  // false: nanoflann computes the bounding box
        }
    };

    // Result set of a nanoflann search. nanoflann passes it the points that are closer than the best point so far.
    template <typename Counts>
    struct Search {
        const std::vector<ComponentNumber>& numbers;
        const Counts& counts;
        double minSquared = std::numeric_limits<double>::infinity();
        ComponentNumber best;
        std::uint32_t visits = 0;

        Search(const std::vector<ComponentNumber>& numbered, const Counts& counted)
            : numbers(numbered), counts(counted) {}
        [[nodiscard]] double worstDist() const { return minSquared; }
        [[nodiscard]] bool full() const { return best.isValid(); }
        // Stores the point if it is the nearest so far and its component meets the condition. Returns false, which ends
        // the search, after maxVisits points.
        bool addPoint(double squared, std::size_t i) {
            if (squared < minSquared && counts(numbers[i])) {
                minSquared = squared;
                best = numbers[i];
            }
            return ++visits < maxVisits;
        }
    };

    Centres centres_;
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Centres>, Centres, 3, std::uint32_t> tree_;
};

}  // namespace

bool isConnected(const Simplifier& s) {
    Forest forest = joinedByFaces(*s.mesh);
    VertexHandle first;
    bool connected = true;
    forEachFace(*s.mesh, [&](FaceHandle face) {
        const VertexHandle root = forest.root(firstVertexOf(*s.mesh, face));
        if (!first.is_valid()) first = root;
        connected = connected && root == first;
    });
    return connected;
}

bool manyAreSmallest(const Simplifier& s) {
    std::size_t count = 0;
    forEachFace(*s.mesh, [&](FaceHandle face) { count += isSmallest(*s.mesh, face) ? 1 : 0; });
    return static_cast<double>(count) > manyShare * static_cast<double>(s.liveFaces);
}

void findComponents(Simplifier& s, const TriangleSet<MeshVertexNumber>& triangles) {
    if (!s.components.empty()) return;
    SurfaceMesh& mesh = *s.mesh;
    Forest forest = joinedVertices(s);
    // Component number of each tree in `forest`, stored at the tree's root vertex.
    Numbered<VertexHandle, ComponentNumber> numbers(mesh.n_vertices());
    forEachFace(mesh, [&](FaceHandle face) {
        ComponentNumber& number = numbers[forest.root(firstVertexOf(mesh, face))];
        if (number.isValid()) return;
        number = s.components.next();
        s.components.emplace_back().primitive = mesh.primitive(face);
    });
    for (const VertexHandle v : numbers.numbers()) mesh.data(v).component = numbers[forest.root(v)];
    measureComponents(s, triangles);
    countComponents(s);
}

void spend(Simplifier& s, VertexHandle v) {
    Component& component = s.componentAt(v);
    if (component.spent) return;
    component.spent = true;
    s.spentFaces += component.faces;
    s.spentArea += component.area;
}

double evenShare(const Simplifier& s, double area, std::size_t faces) {
    return area / s.area * static_cast<double>(faces);
}

bool isKept(const Simplifier& s, VertexHandle v, Fit fit, std::size_t target, double share) {
    if (s.components.empty()) return false;
    const Component& component = s.componentAt(v);
    if (fit == Fit::bad) return static_cast<double>(component.faces) <= evenShare(s, component.area, target);
    if (component.spent || 2 * s.spentFaces <= target) return false;
    const auto rest = static_cast<double>(s.liveFaces - s.spentFaces);
    return rest <= share * evenShare(s, s.area - s.spentArea, target);
}

void removeComponents(Simplifier& s, std::size_t target) {
    std::vector<Removable> rest = removableComponents(s);
    const CentreTree tree(s.components);

    // Remove components of similar size together, the smallest first. When a component is removed, a neighbour grows to
    // replace it. This neighbour is not removed until all other components of similar size have been considered, so
    // that removals are spread evenly.
    for (std::size_t begin = 0; begin < rest.size() && s.liveFaces > target;) {
        std::size_t end = begin;
        while (end < rest.size() && rest[end].size == rest[begin].size) ++end;
        std::vector<std::uint32_t> turn;
        for (std::size_t i = begin; i < end; ++i) turn.push_back(static_cast<std::uint32_t>(i));
        while (!turn.empty() && s.liveFaces > target) {
            Numbered<ComponentNumber, std::uint8_t> stays(s.components.size(), 0);
            std::vector<std::uint32_t> later;
            for (const std::uint32_t i : turn) {
                if (s.liveFaces <= target) break;
                Component& gone = s.components[rest[i].component];
                if (stays[rest[i].component] != 0) {
                    later.push_back(i);
                    continue;
                }
                removeComponent(s, rest[i]);
                const ComponentNumber heir = tree.nearest(gone.ball.centre, [&](ComponentNumber c) {
                    const Component& other = s.components[c];
                    return !other.removed && other.primitive == gone.primitive &&
                           other.ball.radius <= maxEnlargement * gone.ball.radius;
                });
                if (!heir.isValid()) continue;
                Component& next = s.components[heir];
                next.area += gone.area;
                if (next.spent) s.spentArea += gone.area;
                next.standsIn = true;
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

Numbered<ComponentNumber, Growth> growths(const Simplifier& s) {
    const CentreTree tree(s.components);
    Numbered<ComponentNumber, Growth> result(s.components.size());
    for (const ComponentNumber c : result.numbers()) {
        const Component& own = s.components[c];
        if (own.removed || !(own.standsIn || own.faces <= fewestFaces) || !(own.ball.radius > 0)) continue;
        const ComponentNumber next = tree.nearest(own.ball.centre, [&](ComponentNumber other) { return other != c; });
        if (!next.isValid()) continue;
        const double reach = glm::distance(own.ball.centre, s.components[next].ball.centre);
        result[c] = {own.ball.centre, own.area, std::max(1.0, reach / own.ball.radius)};
    }
    return result;
}

}  // namespace defocus::engine
