#pragma once
// Computes from which part of a line through the lens a triangle is visible, in double precision, as a reference for
// tests of shaders/line/line.glsl.
//
// From lens point p·d (d: direction of the line), a clip-space vertex (x, y, w) with signed circle of confusion C
// appears at the offset (α + p·β)/w from image position s, with α = (x, y) − w·s and β = C·d. The edge functions are
// also linear in p, α_i × α_j + p·(α_i × β_j + β_i × α_j), because all β are parallel. They correspond to the
// inequality C_i + u·A_i(y) − v·B_i(x) ≥ 0 of Tzeng et al. 2012 along a line.

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace defocus::engine {

struct LensVertex {  // vertex in clip space
    double x = 0;
    double y = 0;
    double w = 0;
    double c = 0;  // signed circle of confusion C, > 0 behind the focus plane
};

struct LineInterval {
    double first = 0;
    double last = 0;
    bool front = true;  // true: front face is visible; false: back face
};

struct LensLine {
    glm::dvec2 direction{0};  // lens point (u, k·v) at p = 1; k = image width / height
    glm::dvec2 place{0};      // image position in normalised device coordinates
    double nearPlane = 0;
    double first = -1;  // the line is the range [first, last] of p
    double last = 1;
};

// Returns the intervals of p in which the part of the triangle beyond the near plane is visible: its front face
// (counter-clockwise), and with `doubleSided` also its back face.
std::vector<LineInterval> seenOnLine(const std::array<LensVertex, 3>& corners, const LensLine& line, bool doubleSided);

}  // namespace defocus::engine
