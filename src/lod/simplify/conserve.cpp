#include "lod/simplify/conserve.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "lod/simplify/anchored.h"
#include "lod/simplify/grouping.h"
#include "lod/simplify/surface_mean.h"

namespace defocus {

namespace {

// Levels of more triangles cover what level 0 does without help.
constexpr std::size_t mostOutlineTriangles = 16'384;

void conserveOutline(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (level.triangles.count() > mostOutlineTriangles) return;
    const auto leaderOf = [&](MeshVertexNumber v) { return source.positions.first[source.positions.id[v]]; };
    const Grouping groups = grouped(level, source.vertices.count(), leaderOf, false);
    std::vector<std::uint32_t> places;
    places.reserve(groups.of.size());
    for (const UnknownNumber g : groups.of) places.push_back(g.value);
    fitOutlines(fit.positions, plainCorners(level.triangles), places, source.outlines, source.bounds);
}

void conserveColor(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    if (fit.colors.empty()) return;
    const glm::dvec4 own = areaMean(
        level.triangles, [&](LevelVertexNumber v) { return fit.positions[v]; },
        [&](LevelVertexNumber v) { return fit.colors[v]; });
    for (glm::vec4& color : fit.colors) color += glm::vec4(source.meanColor - own);
}

}  // namespace

void conserve(const FitSource& source, const LevelMesh& level, LevelFit& fit) {
    conserveOutline(source, level, fit);
    conserveColor(source, level, fit);
}

PatchMeans patchMeans(const FitSource& source, const LevelMesh& level, const LevelFit& fit,
                      const Numbered<MeshVertexNumber, Anchor>& anchors,
                      const Numbered<TriangleNumber, std::uint32_t>& patchOf) {
    std::size_t count = 0;
    for (const std::uint32_t patch : patchOf) count = std::max<std::size_t>(count, std::size_t{patch} + 1);
    PatchMeans means;
    for (std::vector<double>* areas : {&means.areas, &means.areas0}) areas->assign(count, 0);
    for (std::vector<glm::dvec4>* colors : {&means.colors, &means.colors0}) colors->assign(count, glm::dvec4(0));
    for (const TriangleNumber t : level.triangles.numbers()) {
        const auto corners = level.triangles.corners(t);
        const double area =
            0.5 * glm::length(triangleCross(corners, [&](LevelVertexNumber v) { return fit.positions[v]; }));
        means.areas[patchOf[t]] += area;
        for (const LevelVertexNumber v : corners)
            if (!fit.colors.empty()) means.colors[patchOf[t]] += area / 3 * glm::dvec4(fit.colors[v]);
    }
    const Numbered<MeshVertexNumber, Anchored> values = anchoredValues(source, anchors);
    for (const MeshVertexNumber v : anchors.numbers()) {
        if (isUnused(anchors[v])) continue;
        const std::uint32_t patch = patchOf[anchors[v].triangle];
        means.areas0[patch] += double{values[v].area};
        means.colors0[patch] += double{values[v].area} * glm::dvec4(values[v].color);
    }
    for (std::size_t patch = 0; patch < count; ++patch) {
        if (means.areas[patch] > 0) means.colors[patch] /= means.areas[patch];
        if (means.areas0[patch] > 0) means.colors0[patch] /= means.areas0[patch];
    }
    return means;
}

}  // namespace defocus
