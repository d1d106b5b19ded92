#pragma once
// Method "scheuermann": Scheuermann 2004, Advanced Depth of Field (ATI; also Riguer, Tatarchuk and Isidoro 2003). A
// pinhole image is gathered at the taps of a Poisson disk as wide as the centre's circle of confusion. Each tap mixes
// the image with a small pre-blurred copy by its own blurriness; a tap nearer than the centre counts only as much as it
// is blurred, so that what is sharp in front doesn't leak into the background.
//
// Blurriness and relative depth share one channel: −1 in front of the focal range, 0 in focus, 1 behind, stored as
// 0 … 1. As published it is linear in depth between three planes; the near and far planes here are the depths at which
// the thin lens reaches the largest circle of confusion. Where it never does behind the focus plane, the line is laid
// through the depth of half the blur at infinity, and cut off at that blur.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus {

// Depth → blurriness, −1 … cutoff: (z − focus)/(focus − near) in front, (z − focus)/(far − focus) behind.
struct BlurrinessPlanes {
    double near = 0;   // m
    double focus = 0;  // m
    double far = 0;    // m
    double cutoff = 1;
};

// `largest`: diameter of the largest circle of confusion, px, > 0. A lens with an aperture; any focus distance.
BlurrinessPlanes blurrinessPlanes(const ClipCircleOfConfusion& coc, double focusDistance, double largest, int width);

// `count` points of the unit disk that keep their distance (best candidates, Mitchell 1991), the first in its middle.
// Always the same points.
std::vector<glm::vec2> poissonDisk(std::uint32_t count);

Method scheuermannMethod();

}  // namespace defocus
