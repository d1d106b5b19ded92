#pragma once
// Where an object is at one moment, in view space, and how much room it takes at any level of its pyramid.

#include "plan/frame_plan.h"

namespace defocus {

ObjectPose objectPose(const Object& object, const glm::dmat4& viewFromWorld);

// Do morph targets change the mesh?
bool morphs(const ObjectPose& pose);

// Around the vertices of all levels. Skinned: Σ w_j·M_j·p lies in the convex hull of the M_j·p, so in the box around
// the boxes that each joint moves. Morphed: p + Σ m_t·d_t lies in the box of p, widened by each target's box times its
// weight.
Bounds posedBox(const Pyramid& pyramid, const ObjectPose& pose, bool skinned);

// The factor by which the pose stretches lengths at most.
double largestScale(const ObjectPose& pose);

// Does the pose flip the winding of triangles? Joints decide by majority.
bool mirrors(const ObjectPose& pose);

}  // namespace defocus
