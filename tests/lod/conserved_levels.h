#pragma once
// Expects coarse levels of a mesh to preserve the mean colour, the reflected radiance and the silhouette area of level
// 0 within given limits. A wide blur does not hide changes of these properties.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "lod/pyramid/conserved.h"

namespace defocus::engine {

struct ConservedLimits {
    double colour = 1e-3;
    double light = 1e-3;
    double outline = 0.005;
};

// Expects `limits` to hold for all levels whose mean edge length is at most a quarter of the mesh's size.
inline void expectConserved(const Mesh& mesh, const ConservedLimits& limits) {
    const Pyramid pyramid = buildPyramid(mesh);
    const auto measured = [&](std::size_t level) {
        return conservedBy(pyramid, level, vertexColours(pyramid, level), 30'000, 1024);
    };
    const Conserved level0 = measured(0);
    for (std::size_t l = 1; l < pyramid.levels.size(); ++l) {
        if (pyramid.levels[l].meanEdge > 0.25 * glm::length(pyramid.bounds.size())) break;
        const ConservedDifference difference = differenceOf(measured(l), level0);
        EXPECT_LE(difference.colour, limits.colour) << "level " << l;
        EXPECT_LE(difference.light, limits.light) << "level " << l;
        EXPECT_LE(difference.outline, limits.outline) << "level " << l;
    }
}

}  // namespace defocus::engine
