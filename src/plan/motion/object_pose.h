#pragma once
// Computes the pose of an object in view space at one instant, and a bounding box of all its levels in that pose.

#include "plan/frame_plan.h"

namespace defocus::engine {

ObjectPose objectPose(const Object& object, const glm::dmat4& viewFromWorld);

// Returns true if morph targets change the mesh in this pose.
bool morphs(const ObjectPose& pose);

// Returns a bounding box of the vertices of all levels in view space. A skinned vertex Σ w_j·M_j·p with joint weights
// w_j lies in the convex hull of the points M_j·p. The result is therefore the union of all joints' transformed boxes.
// A morphed vertex p + Σ m_t·d_t with target weights m_t lies in the box of p, widened by the weighted box of each
// target.
Bounds posedBox(const Pyramid& pyramid, const ObjectPose& pose, bool skinned);

// Returns the largest factor by which the pose scales a length.
double largestScale(const ObjectPose& pose);

// Returns true if the pose flips the winding of triangles. With a skin, the majority of the joints decides.
bool mirrors(const ObjectPose& pose);

}  // namespace defocus::engine
