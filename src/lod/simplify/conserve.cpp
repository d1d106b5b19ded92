#include "lod/simplify/conserve.h"

#include <cstdint>
#include <vector>

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

}  // namespace defocus
