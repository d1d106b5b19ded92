#pragma once
// Computes the pose of an object in view space at one moment, and a box that contains it at every level of its pyramid.

#include "plan/frame_plan.h"

namespace defocus::engine {

ObjectPose objectPose(const Object& object, const glm::dmat4& viewFromWorld);

// Returns whether morph targets change the mesh.
bool morphs(const ObjectPose& pose);

// Returns a box around the vertices of all levels. With a skin, Σ w_j·M_j·p lies in the convex hull of the M_j·p, and
// so in the box around the moved boxes of all joints. With morph targets, p + Σ m_t·d_t lies in the box of p, widened
// by the box of each target times its weight.
Bounds posedBox(const Pyramid& pyramid, const ObjectPose& pose, bool skinned);

// Returns the largest factor by which the pose stretches a length.
double largestScale(const ObjectPose& pose);

// Returns whether the pose flips the winding of triangles. The joints of a skin decide by majority.
bool mirrors(const ObjectPose& pose);

}  // namespace defocus::engine
