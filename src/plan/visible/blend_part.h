#pragma once
// Tests which parts of blended primitives may hide each other. A part is a triangle, or the surface of a convex body.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// A plane: all points x with n·x = d.
struct Plane {
    glm::dvec3 normal{0};  // unit normal n of the plane n·x = d
    double distance = 0;   // signed distance d of the plane from the origin
};

// A part of a surface at one of the object's poses, in view space: a triangle, or the surface of a convex body with
// outward normals.
struct PosedPart {
    std::vector<glm::dvec3> corners;
    std::vector<Plane> planes;  // planes of all triangles with an area above 0
    double nearest = 0;         // nearest depth, m
    double farthest = 0;        // farthest depth, m
    double rounding = 0;        // upper bound of the corners' rounding errors, m
};

struct BlendPart {
    std::vector<PosedPart> poses;  // the part in one pose, or in one pose for each shutter time
    bool flat = false;             // true: the part is a single triangle
    // Bounds in px, relative to the centre of the image, of the part's projections in all lens samples.
    glm::dvec2 low{0}, high{0};
};

// Returns the poses and image bounds of the part that consists of the object's triangles `indices`. `positions` are the
// vertex positions of the drawn level, in object space.
BlendPart blendPart(const ObjectPlan& object, const FramePlan& plan, const std::vector<glm::vec3>& positions,
                    std::span<const std::uint32_t> indices);

// Returns whether the parts may cover a common pixel in some lens sample.
bool overlap(const BlendPart& a, const BlendPart& b);

// Returns false if no ray from the lens hits `front` before `behind`. The result is conservative: it may be true
// although no such ray exists.
bool mayHide(const BlendPart& front, const BlendPart& behind, const FramePlan& plan);

// Returns whether the part's triangles all show their back faces to every point of the lens.
bool showsOnlyBacks(const BlendPart& part, const FramePlan& plan);

}  // namespace defocus::engine
