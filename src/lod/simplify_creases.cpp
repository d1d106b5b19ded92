// Where the two sides of a thin sheet meet after their rim has collapsed, one normal cannot serve both: it would point
// sideways and darken either side. Such a wedge is split, as Hoppe 1998 allows at any corner. At a seam of the texture
// each side may have a wedge of its own already; as they shared a normal before, they are looked at together.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "lod/simplify_state.h"

namespace defocus {

namespace {

// Resultant of the unit normals around a wedge, as a share of their number (by angle), below which it is split: a cone
// of 60° at its tip is kept.
constexpr double leastAgreement = 0.5;
constexpr int rounds = 3;  // of two means

struct CornerNormal {
    std::uint32_t corner;
    glm::dvec3 normal;  // of the face, as long as twice its area; then as long as the corner's angle
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

void weighByAngle(const Simplifier& s, CornerNormal& c) {
    const std::uint32_t first = c.corner / 3 * 3;
    const glm::dvec3& p = s.points[s.corners.vertex[c.corner]];
    const glm::dvec3 a = s.points[s.corners.vertex[first + (c.corner + 1 - first) % 3]] - p;
    const glm::dvec3 b = s.points[s.corners.vertex[first + (c.corner + 2 - first) % 3]] - p;
    const double length = glm::length(c.normal);
    c.normal *= length > 0 ? angleBetween(a, b) / length : 0;
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

}  // namespace

Creases creases(Simplifier& s) {
    Creases result;
    result.wedges = s.corners.wedge;
    std::vector<std::uint32_t>& wedges = result.wedges;

    // The live corners of each group of wedges that share a normal, one group after the other.
    std::vector<std::uint32_t> first(s.firstCorner.size() + 1, 0);
    const auto forEachCorner = [&](const auto& visit) {
        for (std::uint32_t face = 0; face < s.corners.primitive.size(); ++face)
            if (isAlive(s, face))
                for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner) visit(corner);
    };
    forEachCorner([&](std::uint32_t corner) { ++first[s.smoothing[wedges[corner]] + 1]; });
    for (std::size_t g = 1; g < first.size(); ++g) first[g] += first[g - 1];
    std::vector<CornerNormal> corners(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t face = 0; face < s.corners.primitive.size(); ++face) {
        if (!isAlive(s, face)) continue;
        const glm::dvec3& p = s.points[s.corners.vertex[3 * face]];
        const glm::dvec3 normal =
            glm::cross(s.points[s.corners.vertex[3 * face + 1]] - p, s.points[s.corners.vertex[3 * face + 2]] - p);
        for (std::uint32_t corner = 3 * face; corner < 3 * face + 3; ++corner)
            corners[next[s.smoothing[wedges[corner]]]++] = {corner, normal};
    }

    std::vector<std::uint32_t> inFront;
    for (std::uint32_t group = 0; group + 1 < first.size(); ++group) {
        const std::span<CornerNormal> around(corners.data() + first[group], corners.data() + first[group + 1]);
        if (around.size() < 2 || surelyAgree(around)) continue;
        for (CornerNormal& c : around) weighByAngle(s, c);
        const std::size_t kept = splitSides(around, s.corners.attributes[group].normal);
        if (kept == around.size() || kept == 0) continue;
        inFront.clear();
        for (const CornerNormal& c : around.first(kept)) inFront.push_back(wedges[c.corner]);
        for (const CornerNormal& c : around.subspan(kept)) {
            const std::uint32_t wedge = wedges[c.corner];
            if (std::find(inFront.begin(), inFront.end(), wedge) == inFront.end()) {
                result.behind.push_back(wedge);  // all of it: at a seam, each side has a wedge of its own
                continue;
            }
            const auto [twin, isNew] =
                s.twinOf.try_emplace(wedge, static_cast<std::uint32_t>(s.firstCorner.size() + s.twins.size()));
            if (isNew) s.twins.push_back(wedge);
            wedges[c.corner] = twin->second;
        }
    }
    std::sort(result.behind.begin(), result.behind.end());
    return result;
}

}  // namespace defocus
