#pragma once
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace defocus::engine {

inline void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

}  // namespace defocus::engine
