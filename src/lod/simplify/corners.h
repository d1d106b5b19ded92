#pragma once
// Corners, half-edges and wedges. The surface is joined by position, but each corner of a face draws a mesh vertex of
// its own, its wedge (Hoppe 1998), so that UV seams, creases and material borders live on a closed surface. When a
// vertex collapses onto another, each of its corners takes over a wedge of the survivor.
//
// Corner 3·f + i of face f is also the half-edge that runs from there to the face's next corner (Rossignac, Safonova
// and Szymczak 2001, 3D Compression Made Simple: Edgebreaker on a Corner Table).

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/memory.h"
#include "lod/simplify/attribute_quadric.h"

namespace defocus {

struct Corner {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t vertex = none;  // of the surface; none: the face is gone (as told by its first corner)
    std::uint32_t twin = none;    // the half-edge on the other side, which runs the other way; none at a border
    std::uint32_t wedge = none;
};

constexpr std::uint32_t nextCorner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
constexpr std::uint32_t previousCorner(std::uint32_t corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

// The distance, in the mesh's longest sides, that weighs as much as a unit of an attribute (of uv: scaled to lengths of
// the surface, so that it tells a texture that slides). Swept on the school of fish: half or twice as much costs up to
// 0.5 dB at the same triangles.
constexpr float normalWeight = 0.003f;
constexpr float colorWeight = 0.005f;  // of colours in [0, 1]
constexpr float uvWeight = 0.05f;

// What all corners that draw one mesh vertex share.
struct Wedge {
    AttributeRow row{};        // attributes by the weights above: normal, colour, uv
    std::uint32_t source = 0;  // the mesh vertex
};

// Faces run around their corners so that neighbours agree.
struct Faces {
    LargeVector<Corner> corners;            // three a face
    std::vector<std::uint32_t> primitives;  // one a face
    std::vector<std::uint8_t> turned;       // one a face; 1: the mesh has its last two corners the other way round
    LargeVector<Wedge> wedges;

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(primitives.size()); }
    [[nodiscard]] bool isAlive(std::uint32_t face) const {
        return corners[3 * std::size_t{face}].vertex != Corner::none;
    }
};

// An edge that is to collapse: its half-edge from the vertex that goes to the one that stays, and the other way. One of
// them may be none.
struct Edge {
    std::uint32_t along = Corner::none;
    std::uint32_t back = Corner::none;
};

// Calls visit(corner) for every corner at a vertex; `first` as in SurfaceVertex.
template <typename Visit>
void forEachCorner(const Faces& faces, std::uint32_t first, const Visit& visit) {
    std::uint32_t corner = first;
    do {
        visit(corner);
        corner = faces.corners[previousCorner(corner)].twin;
    } while (corner != Corner::none && corner != first);
}

// Calls visit(edge, neighbour) for every edge that leaves a vertex.
template <typename Visit>
void forEachEdge(const Faces& faces, std::uint32_t first, const Visit& visit) {
    Edge edge{first, faces.corners[first].twin};
    do {
        visit(edge, faces.corners[nextCorner(edge.along)].vertex);
        edge.back = previousCorner(edge.along);
        edge.along = faces.corners[edge.back].twin;
    } while (edge.along != Corner::none && edge.along != first);
    if (edge.along == Corner::none) visit(edge, faces.corners[edge.back].vertex);
}

// How well a collapse, or the wedges that it hands over, suits the mesh. Worse ones wait until no better is left.
enum class Fit : std::uint8_t { good, poor, bad, impossible };

struct Retarget {
    std::uint32_t corner = 0;
    std::uint32_t wedge = 0;
};

struct WedgeQuestion {
    Edge edge;
    std::span<const std::uint32_t> from;  // corners at the vertex that goes
    std::span<const std::uint32_t> to;    // corners at the vertex that stays
    double edgeLength = 0;                // in the unit of the scaled uv
};

// Picks a wedge of the survivor for every corner of the vertex that goes whose face stays: the one across the edge on
// the same side of any seam, else the nearest of its primitive.
//   poor: its texture would be stretched (a seam would be left); bad: it belongs to another primitive.
Fit retargetWedges(const Faces& faces, const WedgeQuestion& question, std::vector<Retarget>& result);

// Whether no seam lies between wedges: they differ in nothing but their normals.
inline bool sameChart(const AttributeRow& a, const AttributeRow& b) {
    return std::equal(a.begin() + 3, a.end(), b.begin() + 3);
}

}  // namespace defocus
