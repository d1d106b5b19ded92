#pragma once
// Corners and wedges (Hoppe 1998): the surface is joined by position, but each corner of a face draws a mesh vertex of
// its own, its wedge, so that UV seams, creases and material borders live on a closed surface. When a vertex collapses
// onto another, each of its corners takes over a wedge of the survivor.

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace defocus {

// What makes wedges alike. Colours are in [0, 1]; uv is scaled to object lengths (see scaledAttributes).
struct WedgeAttributes {
    glm::vec3 normal{0};
    glm::vec3 color{0};
    glm::vec2 uv{0};
};

struct Corners {
    std::vector<std::uint32_t> vertex;        // of the surface, three a face
    std::vector<std::uint32_t> wedge;         // mesh vertex, three a face
    std::vector<std::uint32_t> primitive;     // one a face
    std::vector<WedgeAttributes> attributes;  // of each mesh vertex

    // The corner of `face` at `v`, which it has.
    [[nodiscard]] std::uint32_t at(std::uint32_t face, std::uint32_t v) const {
        const std::uint32_t first = 3 * face;
        return vertex[first] == v ? first : vertex[first + 1] == v ? first + 1 : first + 2;
    }
};

// How well a collapse, or the wedges that it hands over, suits the mesh. Worse ones wait until no better is left.
enum class Fit : std::uint8_t { good, poor, bad, impossible };

// One side of the edge that collapses: its face (or none) and the wedges of the vertex that goes and the one that
// stays.
struct EdgeSide {
    static constexpr std::uint32_t none = 0xffffffffu;
    std::uint32_t face = none;
    std::uint32_t from = none;
    std::uint32_t to = none;
};

struct Retarget {
    std::uint32_t corner = 0;
    std::uint32_t wedge = 0;
};

struct WedgeQuestion {
    std::uint32_t from = 0;  // the vertex that goes
    std::uint32_t to = 0;    // the vertex that stays
    EdgeSide sides[2];
    std::span<const std::uint32_t> facesFrom;  // around `from`
    std::span<const std::uint32_t> facesTo;    // around `to`
    double edgeLength = 0;                     // in the unit of the scaled uv
};

// Picks a wedge of the survivor for every corner of the vertex that goes whose face stays: the one across the edge on
// the same side of any seam, else the nearest of its primitive.
//   poor: its texture would be stretched (a seam would be left); bad: it belongs to another primitive.
Fit retargetWedges(const Corners& corners, const WedgeQuestion& question, std::vector<Retarget>& result);

// Squared difference of normals and (weighted 4) colours; and of uv as a squared length.
inline double shadingDifference(const WedgeAttributes& a, const WedgeAttributes& b) {
    const glm::vec3 normals = a.normal - b.normal;
    const glm::vec3 colors = a.color - b.color;
    return glm::dot(normals, normals) + 4 * glm::dot(colors, colors);
}

inline double uvDifference(const WedgeAttributes& a, const WedgeAttributes& b) {
    const glm::vec2 step = a.uv - b.uv;
    return glm::dot(step, step);
}

// No seam lies between wedges that differ in nothing but their normals.
inline bool sameChart(const WedgeAttributes& a, const WedgeAttributes& b) {
    return a.uv == b.uv && a.color == b.color;
}

}  // namespace defocus
