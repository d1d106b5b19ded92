#pragma once
// Method "scheuermann": Scheuermann 2004, Advanced Depth of Field (ATI; also Riguer, Tatarchuk and Isidoro 2003). A
// pinhole image is gathered at the taps of a Poisson disk as large as the centre's circle of confusion. Each tap mixes
// the image with a small pre-blurred copy, by its own blurriness. A tap nearer than the centre is weighted by its blur,
// so that sharp foreground doesn't leak into the background.
//
// Blurriness and relative depth share one channel: −1 in front of the focal range, 0 in focus, 1 behind, stored as 0 …
// 1. As published, it is linear in depth between three planes. The near and far planes here are the depths at which the
// thin lens reaches the max circle of confusion. If the lens never reaches it behind the focus plane, the line passes
// through the depth of half the blur at infinity. It is clamped to the blur at infinity. Settings of the method
// override these depths, as the artist does in the slides.
//
// The taps follow the shape and density of the lens's aperture: blades, rings and images. A cat's eye is ignored.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus::engine {

// Maps depth to blurriness, −1 … cutoff: (z − focus)/(focus − near) in front, (z − focus)/(far − focus) behind.
struct BlurrinessPlanes {
    double near = 0;   // m
    double focus = 0;  // m
    double far = 0;    // m
    double cutoff = 1;
};

// Planes set by the artist, m; 0: the value that blurrinessPlanes() computes. The cutoff is in (0, 1].
struct PlanesByHand {
    double near = 0;
    double focus = 0;
    double far = 0;
    double cutoff = 0;
};

// Returns `planes` with the artist's values. A near or far plane that is not set keeps its ratio to the focus distance.
// Throws Error unless near < focus < far.
BlurrinessPlanes withPlanesByHand(const BlurrinessPlanes& planes, const PlanesByHand& byHand);

// Returns the planes of a lens with an aperture, at any focus distance. `largest`: diameter of the max circle of
// confusion, px, > 0.
BlurrinessPlanes blurrinessPlanes(const ClipCircleOfConfusion& coc, double focusDistance, double largest, int width);

// Returns `count` points of the unit disk with large mutual distances (best candidates, Mitchell 1991). The first is
// the centre. The points are the same in each call.
std::vector<glm::vec2> poissonDisk(std::uint32_t count);

Method scheuermannMethod();

}  // namespace defocus::engine
