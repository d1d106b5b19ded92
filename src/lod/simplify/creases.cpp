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
    glm::dvec3
        normal;  // of the face as the mesh winds it, as long as twice its area; then as long as the corner's angle
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

CornerNormal cornerNormal(const Simplifier& s, std::uint32_t corner) {
    const auto point = [&](std::uint32_t c) { return s.point(s.faces.corners[c].vertex); };
    const glm::dvec3 p = point(corner);
    const glm::dvec3 normal = glm::cross(point(nextCorner(corner)) - p, point(previousCorner(corner)) - p);
    return {corner, s.faces.turned[corner / 3] != 0 ? -normal : normal};
}

void weighByAngle(const Simplifier& s, CornerNormal& c) {
    const auto point = [&](std::uint32_t corner) { return s.point(s.faces.corners[corner].vertex); };
    const glm::dvec3 p = point(c.corner);
    const double length = glm::length(c.normal);
    c.normal *=
        length > 0 ? angleBetween(point(nextCorner(c.corner)) - p, point(previousCorner(c.corner)) - p) / length : 0;
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

CornerGroups groupCorners(const Simplifier& s) {
    // Number the groups that are left.
    std::vector<std::uint32_t> numbers(s.origin->smoothing.size(), Corner::none);
    std::vector<std::uint32_t> groupOf;  // of each wedge
    groupOf.reserve(s.faces.wedges.size());
    std::uint32_t count = 0;
    for (const Wedge& wedge : s.faces.wedges) {
        std::uint32_t& number = numbers[s.origin->smoothing[wedge.source]];
        if (number == Corner::none) number = count++;
        groupOf.push_back(number);
    }

    CornerGroups groups;
    groups.first.assign(std::size_t{count} + 1, 0);
    for (const Corner& corner : s.faces.corners) ++groups.first[groupOf[corner.wedge] + 1];
    std::partial_sum(groups.first.begin(), groups.first.end(), groups.first.begin());
    groups.corners.resize(s.faces.corners.size());
    std::vector<std::uint32_t> next(groups.first.begin(), groups.first.end() - 1);
    for (std::uint32_t corner = 0; corner < s.faces.corners.size(); ++corner)
        groups.corners[next[groupOf[s.faces.corners[corner].wedge]]++] = corner;
    return groups;
}

}  // namespace

Creases creases(Simplifier& s) {
    Creases result;
    std::vector<std::uint32_t>& wedges = result.wedges;
    wedges.reserve(s.faces.corners.size());
    for (const Corner& corner : s.faces.corners) wedges.push_back(s.faces.wedges[corner.wedge].source);

    const CornerGroups groups = groupCorners(s);
    const auto vertexCount = static_cast<std::uint32_t>(s.origin->firstVertex.size());
    std::vector<CornerNormal> around;
    std::vector<std::uint32_t> inFront;
    for (std::size_t group = 0; group + 1 < groups.first.size(); ++group) {
        around.clear();
        for (std::size_t i = groups.first[group]; i < groups.first[group + 1]; ++i)
            around.push_back(cornerNormal(s, groups.corners[i]));
        if (around.size() < 2 || surelyAgree(around)) continue;
        for (CornerNormal& c : around) weighByAngle(s, c);
        const std::uint32_t leader = s.origin->smoothing[wedges[around[0].corner]];
        const std::size_t kept = splitSides(around, s.origin->vertices.normals[leader]);
        if (kept == around.size() || kept == 0) continue;
        inFront.clear();
        for (const CornerNormal& c : std::span(around).first(kept)) inFront.push_back(wedges[c.corner]);
        for (const CornerNormal& c : std::span(around).subspan(kept)) {
            const std::uint32_t wedge = wedges[c.corner];
            if (std::find(inFront.begin(), inFront.end(), wedge) == inFront.end()) {
                result.behind.push_back(wedge);  // all of it: at a seam, each side has a wedge of its own
                continue;
            }
            const auto [twin, isNew] =
                s.twinOf.try_emplace(wedge, static_cast<std::uint32_t>(vertexCount + s.twins.size()));
            if (isNew) s.twins.push_back(wedge);
            wedges[c.corner] = twin->second;
        }
    }
    std::sort(result.behind.begin(), result.behind.end());
    return result;
}

}  // namespace defocus
