#pragma once
// Parts of blended primitives, and tests of which parts may hide each other.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Plane n·x = d.
struct Plane {
    glm::dvec3 normal{0};  // unit vector n
    double distance = 0;   // distance d from the origin
};

// A convex piece of a surface at one of the object's poses, in view space: a triangle, or the surface of a convex body
// with outward normals.
struct PosedPart {
    std::vector<glm::dvec3> corners;
    std::vector<Plane> planes;  // planes of all triangles that are not degenerate
    double nearest = 0;         // depth, m
    double farthest = 0;        // depth, m
    double rounding = 0;        // bound of the corners' rounding errors, m
};

struct BlendPart {
    std::vector<PosedPart> poses;  // one pose, or one for each shutter time
    bool flat = false;             // the part is a single triangle
    // Bounds in px, relative to the centre of the image, of the part's projections in all lens samples.
    glm::dvec2 low{0}, high{0};
};

// Returns the part with the given triangles of the object. `positions` are the vertex positions of the drawn level, in
// object space.
BlendPart blendPart(const ObjectPlan& object, const FramePlan& plan, const std::vector<glm::vec3>& positions,
                    std::span<const std::uint32_t> indices);

// Returns whether the images of the parts may overlap.
bool overlap(const BlendPart& a, const BlendPart& b);

// Returns false if no ray from the lens hits `front` before `behind`. The result is conservative: it may be true
// although no such ray exists.
bool mayHide(const BlendPart& front, const BlendPart& behind, const FramePlan& plan);

// Returns whether all points of the lens see only the backs of the part's triangles.
bool showsOnlyBacks(const BlendPart& part, const FramePlan& plan);

}  // namespace defocus::engine
