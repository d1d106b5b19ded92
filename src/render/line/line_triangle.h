#pragma once
// Visibility of a triangle along a line through the lens: shaders/line/line.glsl in double precision, for tests.
//
// At lens point p·d, a vertex (x, y, w) with signed C lies at (x, y) + C·p·d − w·s relative to image position s. This
// is linear in p. The edge functions are linear too: α_i × α_j + p·(α_i × β_j + β_i × α_j), because all β = C·d are
// parallel. They are the inequality C_i + u·A_i(y) − v·B_i(x) ≥ 0 of Tzeng et al. 2012 along a spoke.

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace defocus::engine {

struct LensVertex {  // clip space
    double x = 0;
    double y = 0;
    double w = 0;
    double c = 0;  // signed, > 0 behind the focus plane
};

struct LineInterval {
    double first = 0;
    double last = 0;
    bool front = true;  // whether the front face is seen
};

struct LensLine {
    glm::dvec2 direction{0};  // (u, k·v) at p = 1
    glm::dvec2 place{0};      // image position, normalised device coordinates
    double nearPlane = 0;
    double first = -1;  // range of p
    double last = 1;
};

// Returns the intervals in which the line sees the triangle beyond the near plane: the front face (counter-clockwise),
// and with `doubleSided` also the back face.
std::vector<LineInterval> seenOnLine(const std::array<LensVertex, 3>& corners, const LensLine& line, bool doubleSided);

}  // namespace defocus::engine
