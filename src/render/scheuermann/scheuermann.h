#pragma once
// Method "scheuermann": Scheuermann 2004, Advanced Depth of Field (ATI; also Riguer, Tatarchuk and Isidoro 2003). A
// pinhole image is gathered at the taps of a Poisson disk as wide as the centre's circle of confusion. Each tap mixes
// the image with a small pre-blurred copy by its own blurriness; a tap nearer than the centre counts only as much as it
// is blurred, so that what is sharp in front doesn't leak into the background.
//
// Blurriness and relative depth share one channel: −1 in front of the focal range, 0 in focus, 1 behind, stored as
// 0 … 1. As published it is linear in depth between three planes; the near and far planes here are the depths at which
// the thin lens reaches the largest circle of confusion. Where it never does behind the focus plane, the line is laid
// through the depth of half the blur at infinity, and cut off at that blur. Settings of the method give these depths by
// hand, as the artist does in the slides.
//
// The taps lie in the shape of the lens's aperture: blades, rings, images, and its density. A cat's eye isn't drawn.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus::engine {

// Depth → blurriness, −1 … cutoff: (z − focus)/(focus − near) in front, (z − focus)/(far − focus) behind.
struct BlurrinessPlanes {
    double near = 0;   // m
    double focus = 0;  // m
    double far = 0;    // m
    double cutoff = 1;
};

// What the artist sets by hand, m; 0: as blurrinessPlanes(…) without them finds it. The cutoff is in (0, 1].
struct PlanesByHand {
    double near = 0;
    double focus = 0;
    double far = 0;
    double cutoff = 0;
};

// `planes` with those that are set by hand. A near or far plane that isn't keeps its distance from the focus. Throws
// Error where near < focus < far doesn't hold.
BlurrinessPlanes withPlanesByHand(const BlurrinessPlanes& planes, const PlanesByHand& byHand);

// `largest`: diameter of the largest circle of confusion, px, > 0. A lens with an aperture; any focus distance.
BlurrinessPlanes blurrinessPlanes(const ClipCircleOfConfusion& coc, double focusDistance, double largest, int width);

// `count` points of the unit disk that keep their distance (best candidates, Mitchell 1991), the first in its middle.
// Always the same points.
std::vector<glm::vec2> poissonDisk(std::uint32_t count);

Method scheuermannMethod();

}  // namespace defocus::engine
