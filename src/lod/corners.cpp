// Hoppe 1998, Efficient Implementation of Progressive Meshes: wedges and how a half-edge collapse hands them over.

#include "lod/corners.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace defocus {

namespace {

// Texture space may be this much denser than on the mesh's average before a step through it counts as a jump over a
// seam.
constexpr double longestUvStep = 4;

double difference(const WedgeAttributes& a, const WedgeAttributes& b) {
    return shadingDifference(a, b) + uvDifference(a, b);
}

// The wedge of the survivor that is most like `wedge`, among those that `admitted(face, wedge)` lets in; none if there
// is none.
template <typename Admitted>
std::uint32_t nearestWedge(const Corners& corners, const WedgeQuestion& question, std::uint32_t wedge,
                           const Admitted& admitted) {
    std::uint32_t nearest = EdgeSide::none;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t face : question.facesTo) {
        const std::uint32_t candidate = corners.wedge[corners.at(face, question.to)];
        if (candidate == nearest || !admitted(face, candidate)) continue;
        const double distance = difference(corners.attributes[wedge], corners.attributes[candidate]);
        if (nearest == EdgeSide::none || distance < least) {
            nearest = candidate;
            least = distance;
        }
    }
    return nearest;
}

bool jumps(const Corners& corners, const WedgeQuestion& question, std::uint32_t from, std::uint32_t to) {
    const double longest = longestUvStep * question.edgeLength;
    return uvDifference(corners.attributes[from], corners.attributes[to]) > longest * longest;
}

struct Choice {
    std::uint32_t wedge = EdgeSide::none;
    Fit fit = Fit::good;
};

Choice chooseWedge(const Corners& corners, const WedgeQuestion& question, std::uint32_t wedge,
                   std::uint32_t primitive) {
    const auto& attributes = corners.attributes;
    const auto inPrimitive = [&](std::uint32_t face, std::uint32_t) { return corners.primitive[face] == primitive; };

    // The survivor's wedges across the edge in the corner's chart. `exact` is on the same side of every crease as well.
    std::uint32_t across = EdgeSide::none;
    std::uint32_t exact = EdgeSide::none;
    bool torn = false;     // a seam lies across the edge at the survivor
    bool creased = false;  // a crease does
    for (const EdgeSide& side : question.sides) {
        if (side.face == EdgeSide::none || corners.primitive[side.face] != primitive) continue;
        if (!sameChart(attributes[side.from], attributes[wedge])) continue;
        torn = torn || (across != EdgeSide::none && !sameChart(attributes[across], attributes[side.to]));
        across = side.to;
        if (side.from != wedge) continue;
        creased = creased || (exact != EdgeSide::none && exact != side.to);
        exact = side.to;
    }
    if (across != EdgeSide::none && !torn) {
        if (exact != EdgeSide::none && !creased) return {exact, Fit::good};
        const auto inChart = [&](std::uint32_t face, std::uint32_t candidate) {
            return inPrimitive(face, candidate) && sameChart(attributes[candidate], attributes[across]);
        };
        return {nearestWedge(corners, question, wedge, inChart), Fit::good};
    }

    // A seam ends here (it lies across the edge) or begins (the corner's chart isn't at the edge): take what is most
    // similar, if it is near enough in texture.
    const std::uint32_t nearest = nearestWedge(corners, question, wedge, inPrimitive);
    if (nearest != EdgeSide::none) {
        bool leaves = jumps(corners, question, wedge, nearest);
        for (const EdgeSide& side : question.sides)
            leaves = leaves || (torn && side.face != EdgeSide::none && jumps(corners, question, wedge, side.to));
        return {nearest, leaves ? Fit::poor : Fit::good};
    }
    return {nearestWedge(corners, question, wedge, [](std::uint32_t, std::uint32_t) { return true; }), Fit::bad};
}

}  // namespace

Fit retargetWedges(const Corners& corners, const WedgeQuestion& question, std::vector<Retarget>& result) {
    result.clear();
    Fit worst = Fit::good;
    Choice choice;
    std::uint32_t lastWedge = EdgeSide::none;
    std::uint32_t lastPrimitive = EdgeSide::none;
    for (const std::uint32_t face : question.facesFrom) {
        if (face == question.sides[0].face || face == question.sides[1].face) continue;
        const std::uint32_t corner = corners.at(face, question.from);
        const std::uint32_t wedge = corners.wedge[corner];
        const std::uint32_t primitive = corners.primitive[face];
        if (wedge != lastWedge || primitive != lastPrimitive) choice = chooseWedge(corners, question, wedge, primitive);
        lastWedge = wedge;
        lastPrimitive = primitive;
        worst = std::max(worst, choice.fit);
        result.push_back({corner, choice.wedge});
    }
    return worst;
}

}  // namespace defocus
