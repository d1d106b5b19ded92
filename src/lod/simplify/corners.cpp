// Hoppe 1998, Efficient Implementation of Progressive Meshes: wedges and how a half-edge collapse hands them over.

#include "lod/simplify/corners.h"

#include <algorithm>
#include <limits>

namespace defocus {

namespace {

// Texture space may be this much denser than on the mesh's average before a step through it counts as a jump over a
// seam.
constexpr double longestUvStep = 4;

// Squares of what attributes [first, last) differ by, as weighed in rows.
float squares(const AttributeRow& a, const AttributeRow& b, std::size_t first, std::size_t last) {
    float sum = 0;
    for (std::size_t j = first; j < last; ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
    return sum;
}

double uvDifference(const AttributeRow& a, const AttributeRow& b) {
    return double{squares(a, b, 6, 8)} / double{uvWeight * uvWeight};
}

// Of normals and (weighted 4) colours, and of uv as a length.
double difference(const AttributeRow& a, const AttributeRow& b) {
    return double{squares(a, b, 0, 3)} / double{normalWeight * normalWeight} +
           4 * double{squares(a, b, 3, 6)} / double{colorWeight * colorWeight} + uvDifference(a, b);
}

// One side of the edge that collapses: its face (or none) and the wedges of the vertex that goes and the one that
// stays.
struct EdgeSide {
    std::uint32_t face = Corner::none;
    std::uint32_t from = Corner::none;
    std::uint32_t to = Corner::none;
};

struct Sides {
    const Faces& faces;
    const WedgeQuestion& question;
    EdgeSide both[2];

    [[nodiscard]] const AttributeRow& row(std::uint32_t wedge) const { return faces.wedges[wedge].row; }
    [[nodiscard]] bool jumps(std::uint32_t from, std::uint32_t to) const {
        const double longest = longestUvStep * question.edgeLength;
        return uvDifference(row(from), row(to)) > longest * longest;
    }
};

Sides sidesOf(const Faces& faces, const WedgeQuestion& question) {
    Sides sides{faces, question, {}};
    const auto wedge = [&](std::uint32_t corner) { return faces.corners[corner].wedge; };
    if (const std::uint32_t e = question.edge.along; e != Corner::none)
        sides.both[0] = {e / 3, wedge(e), wedge(nextCorner(e))};
    if (const std::uint32_t e = question.edge.back; e != Corner::none)
        sides.both[1] = {e / 3, wedge(nextCorner(e)), wedge(e)};
    return sides;
}

// The wedge of the survivor that is most like `wedge`, among those that `admitted(face, wedge)` lets in; none if there
// is none.
template <typename Admitted>
std::uint32_t nearestWedge(const Sides& sides, std::uint32_t wedge, const Admitted& admitted) {
    std::uint32_t nearest = Corner::none;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : sides.question.to) {
        const std::uint32_t candidate = sides.faces.corners[corner].wedge;
        if (candidate == nearest || !admitted(corner / 3, candidate)) continue;
        const double distance = difference(sides.row(wedge), sides.row(candidate));
        if (nearest == Corner::none || distance < least) {
            nearest = candidate;
            least = distance;
        }
    }
    return nearest;
}

struct Choice {
    std::uint32_t wedge = Corner::none;
    Fit fit = Fit::good;
};

Choice chooseWedge(const Sides& sides, std::uint32_t wedge, std::uint32_t primitive) {
    const auto& primitives = sides.faces.primitives;
    const auto inPrimitive = [&](std::uint32_t face, std::uint32_t) { return primitives[face] == primitive; };

    // The survivor's wedges across the edge in the corner's chart. `exact` is on the same side of every crease as well.
    std::uint32_t across = Corner::none;
    std::uint32_t exact = Corner::none;
    bool torn = false;     // a seam lies across the edge at the survivor
    bool creased = false;  // a crease does
    for (const EdgeSide& side : sides.both) {
        if (side.face == Corner::none || primitives[side.face] != primitive) continue;
        if (!sameChart(sides.row(side.from), sides.row(wedge))) continue;
        torn = torn || (across != Corner::none && !sameChart(sides.row(across), sides.row(side.to)));
        across = side.to;
        if (side.from != wedge) continue;
        creased = creased || (exact != Corner::none && exact != side.to);
        exact = side.to;
    }
    if (across != Corner::none && !torn) {
        if (exact != Corner::none && !creased) return {exact, Fit::good};
        const auto inChart = [&](std::uint32_t face, std::uint32_t candidate) {
            return inPrimitive(face, candidate) && sameChart(sides.row(candidate), sides.row(across));
        };
        return {nearestWedge(sides, wedge, inChart), Fit::good};
    }

    // A seam ends here (it lies across the edge) or begins (the corner's chart isn't at the edge): take what is most
    // similar, if it is near enough in texture.
    const std::uint32_t nearest = nearestWedge(sides, wedge, inPrimitive);
    if (nearest != Corner::none) {
        bool leaves = sides.jumps(wedge, nearest);
        for (const EdgeSide& side : sides.both)
            leaves = leaves || (torn && side.face != Corner::none && sides.jumps(wedge, side.to));
        return {nearest, leaves ? Fit::poor : Fit::good};
    }
    return {nearestWedge(sides, wedge, [](std::uint32_t, std::uint32_t) { return true; }), Fit::bad};
}

}  // namespace

Fit retargetWedges(const Faces& faces, const WedgeQuestion& question, std::vector<Retarget>& result) {
    result.clear();
    const Sides sides = sidesOf(faces, question);
    Fit worst = Fit::good;
    Choice choice;
    std::uint32_t lastWedge = Corner::none;
    std::uint32_t lastPrimitive = Corner::none;
    for (const std::uint32_t corner : question.from) {
        const std::uint32_t face = corner / 3;
        if (face == sides.both[0].face || face == sides.both[1].face) continue;
        const std::uint32_t wedge = faces.corners[corner].wedge;
        const std::uint32_t primitive = faces.primitives[face];
        if (wedge != lastWedge || primitive != lastPrimitive) choice = chooseWedge(sides, wedge, primitive);
        lastWedge = wedge;
        lastPrimitive = primitive;
        worst = std::max(worst, choice.fit);
        result.push_back({corner, choice.wedge});
    }
    return worst;
}

}  // namespace defocus
