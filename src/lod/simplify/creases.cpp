// Where the two sides of a thin sheet meet after their rim has collapsed, one normal cannot serve both: it would point
// sideways and darken either side. Such a wedge is split, as Hoppe 1998 allows at any corner. At a seam of the texture
// each side may have a wedge of its own already; as they shared a normal before, they are looked at together.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

#include "lod/simplify/state.h"

namespace defocus {

namespace {

// Resultant of the unit normals around a wedge, as a share of their number (by angle), below which it is split: a cone
// of 60° at its tip is kept.
constexpr double leastAgreement = 0.5;
constexpr int rounds = 3;  // of two means

struct CornerNormal {
    std::uint32_t corner;
    // Of the face as the mesh winds it; as long as twice its area, then as long as the corner's angle.
    glm::dvec3 normal;
};

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Where all faces look within 60° of the first, their resultant is long enough whatever the angles are.
bool surelyAgree(std::span<const CornerNormal> corners) {
    const glm::dvec3& first = corners[0].normal;
    const double limit = leastAgreement * leastAgreement * glm::dot(first, first);
    return std::all_of(corners.begin(), corners.end(), [&](const CornerNormal& c) {
        const double along = glm::dot(first, c.normal);
        return along > 0 && along * along > limit * glm::dot(c.normal, c.normal);
    });
}

// The places of a corner and of the two beside it, as the mesh winds the face.
struct CornerPlaces {
    glm::dvec3 own, next, previous;
};

CornerPlaces placesAt(const SurfaceMesh& mesh, std::span<const HalfedgeHandle> corners, std::uint32_t corner) {
    const auto place = [&](std::uint32_t c) { return mesh.place(mesh.from_vertex_handle(corners[c])); };
    return {place(corner), place(nextCorner(corner)), place(previousCorner(corner))};
}

CornerNormal cornerNormal(const CornerPlaces& at, std::uint32_t corner) {
    return {corner, glm::cross(at.next - at.own, at.previous - at.own)};
}

void weighByAngle(const CornerPlaces& at, CornerNormal& c) {
    const double length = glm::length(c.normal);
    c.normal *= length > 0 ? angleBetween(at.next - at.own, at.previous - at.own) / length : 0;
}

// Moves the corners of one of the two sides behind the returned place; all stay before it where one side is enough.
std::size_t splitSides(std::span<CornerNormal> corners, const glm::dvec3& own) {
    glm::dvec3 sum(0);
    double angles = 0;
    for (const CornerNormal& c : corners) {
        sum += c.normal;
        angles += glm::length(c.normal);
    }
    if (glm::length(sum) >= leastAgreement * angles) return corners.size();

    // Two means, from the corner of the largest angle and the one that looks away from it most.
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
    // The side that the vertex's own normal agrees with better keeps it.
    if (glm::dot(front, own) * glm::length(back) < glm::dot(back, own) * glm::length(front)) std::swap(front, back);
    const auto border = std::stable_partition(corners.begin(), corners.end(), isFront);
    return static_cast<std::size_t>(border - corners.begin());
}

// Corners in groups of wedges that share a normal: group g has corners[first[g]] … corners[first[g + 1] − 1].
struct CornerGroups {
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> corners;
};

CornerGroups groupCorners(const Simplifier& s, std::span<const HalfedgeHandle> corners) {
    // Number the groups that are left.
    constexpr std::uint32_t unnumbered = 0xffffffffu;
    const WedgeTable& wedges = s.mesh->wedges;
    std::vector<std::uint32_t> numbers(s.origin->smoothing.size(), unnumbered);
    std::vector<std::uint32_t> groupOf;  // of each wedge
    groupOf.reserve(wedges.size());
    std::uint32_t count = 0;
    for (std::uint32_t w = 0; w < wedges.size(); ++w) {
        std::uint32_t& number = numbers[s.origin->smoothing[wedges.source({w})]];
        if (number == unnumbered) number = count++;
        groupOf.push_back(number);
    }

    CornerGroups groups;
    const auto groupAt = [&](HalfedgeHandle corner) { return groupOf[s.mesh->wedge(corner).value]; };
    groups.first.assign(std::size_t{count} + 1, 0);
    for (const HalfedgeHandle corner : corners) ++groups.first[groupAt(corner) + 1];
    std::partial_sum(groups.first.begin(), groups.first.end(), groups.first.begin());
    groups.corners.resize(corners.size());
    std::vector<std::uint32_t> next(groups.first.begin(), groups.first.end() - 1);
    for (std::uint32_t corner = 0; corner < corners.size(); ++corner)
        groups.corners[next[groupAt(corners[corner])]++] = corner;
    return groups;
}

}  // namespace

Creases creases(Simplifier& s, std::span<const HalfedgeHandle> corners) {
    const SurfaceMesh& mesh = *s.mesh;
    Creases result;
    std::vector<std::uint32_t>& drawn = result.drawn;
    drawn.reserve(corners.size());
    for (const HalfedgeHandle corner : corners) drawn.push_back(mesh.wedges.source(mesh.wedge(corner)));

    const CornerGroups groups = groupCorners(s, corners);
    const auto vertexCount = static_cast<std::uint32_t>(s.origin->firstVertex.size());
    std::vector<CornerNormal> around;
    std::vector<std::uint32_t> inFront;
    for (std::size_t group = 0; group + 1 < groups.first.size(); ++group) {
        around.clear();
        for (std::size_t i = groups.first[group]; i < groups.first[group + 1]; ++i)
            around.push_back(cornerNormal(placesAt(mesh, corners, groups.corners[i]), groups.corners[i]));
        if (around.size() < 2 || surelyAgree(around)) continue;
        for (CornerNormal& c : around) weighByAngle(placesAt(mesh, corners, c.corner), c);
        const std::uint32_t leader = s.origin->smoothing[drawn[around[0].corner]];
        const std::size_t kept = splitSides(around, s.origin->vertices.normals[leader]);
        if (kept == around.size() || kept == 0) continue;
        inFront.clear();
        for (const CornerNormal& c : std::span(around).first(kept)) inFront.push_back(drawn[c.corner]);
        for (const CornerNormal& c : std::span(around).subspan(kept)) {
            const std::uint32_t v = drawn[c.corner];
            if (std::find(inFront.begin(), inFront.end(), v) == inFront.end()) {
                result.behind.push_back(v);  // all of it: at a seam, each side has a wedge of its own
                continue;
            }
            const auto [twin, isNew] =
                s.twinOf.try_emplace(v, static_cast<std::uint32_t>(vertexCount + s.twins.size()));
            if (isNew) s.twins.push_back(v);
            drawn[c.corner] = twin->second;
        }
    }
    std::sort(result.behind.begin(), result.behind.end());
    return result;
}

}  // namespace defocus
