#pragma once
// How far objects are apart in the image, and quantities that spread over what touches.
//
// Two objects that touch must be drawn alike: from the same lens points and pixel offsets. Else the background shows in
// a line between them. So what decides about an object (a largest blur, say) also decides about all that touches it,
// and less and less about what is farther away.

#include <limits>
#include <vector>

#include "plan/frame_plan.h"

namespace defocus::engine {

// Where an object's box lies; unlimited: it touches everything.
struct ContactBounds {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    // In the image, px from its lower left corner, through the middle of the lens.
    glm::dvec2 seenMin{-infinity};
    glm::dvec2 seenMax{infinity};
    // In view space, but with a depth that is positive, in units that are a px at a depth of 1 m.
    glm::dvec3 min{-infinity};
    glm::dvec3 max{infinity};
    double unit = 1;  // m
};

// Returns the bounds of an object of `plan`; unlimited where its box reaches the near plane.
ContactBounds contactBounds(const ObjectPlan& object, const FramePlan& plan);

// Returns how far apart the two are, px: in the image, or in space along one of its axes where they come closest,
// whichever is more; less one px, which a rasteriser may close. 0: they touch, or may. It is the same from a to b as
// from b to a, and continuous in the camera.
double contactGap(const ContactBounds& a, const ContactBounds& b);

// Returns for each object the greatest of values[j] − (the shortest way from it to j, over gaps between objects), but
// `least` where that is less. Objects that touch get the same value, and none is raised by more than `most` − `least`
// over its own. `values` are within [least, most]. Near-linear in the number of objects.
std::vector<double> spreadOverContact(const std::vector<ContactBounds>& bounds, std::vector<double> values, double min,
                                      double max);

}  // namespace defocus::engine
