#pragma once
// Method "scheuermann": Scheuermann 2004, Advanced Depth of Field (ATI; also Riguer, Tatarchuk and Isidoro 2003). Each
// pixel gathers a pinhole image at the taps of a Poisson disk as large as the pixel's circle of confusion. Each tap
// interpolates between the image and a small pre-blurred copy by the blurriness at the tap. A tap nearer than the pixel
// is weighted by its blurriness, so that sharp foreground does not leak into the background.
//
// One signed value is both blurriness and relative depth: −1 at the near plane, 0 in focus, 1 at the far plane, stored
// as 0 … 1. As published, it is linear in depth between three planes. By default, the near and far planes are the
// depths at which the lens has the max circle of confusion. If this max is not reached behind the focus plane, the far
// plane is chosen so that the value is correct at twice the focus distance, where the blur is half the blur at
// infinity. The value is then clamped to the blur at infinity. Settings of the method override the planes; in the
// slides, artists set the planes.
//
// The taps have the shape and density of the lens's aperture: blades, rings and aperture images. The cat's eye is
// ignored.

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "lens/circle_of_confusion.h"
#include "render/methods.h"

namespace defocus::engine {

// Maps depth z to blurriness: (z − focus)/(focus − near) in front of the focus plane, (z − focus)/(far − focus) behind,
// clamped to [−1, cutoff]. The cutoff is the max blurriness behind the focus plane.
struct BlurrinessPlanes {
    double near = 0;   // m
    double focus = 0;  // m
    double far = 0;    // m
    double cutoff = 1;
};

// Planes set by the user, in m, and the max blurriness behind the focus plane (cutoff), in (0, 1]. 0: use the value of
// blurrinessPlanes().
struct PlanesByHand {
    double near = 0;
    double focus = 0;
    double far = 0;
    double cutoff = 0;
};

// Returns `planes` with the user's values. If only the focus is set, near and far keep their ratio to it. Throws Error
// unless near < focus < far.
BlurrinessPlanes withPlanesByHand(const BlurrinessPlanes& planes, const PlanesByHand& byHand);

// Returns the planes at which a lens with nonzero aperture has the blurriness −1, 0 and 1. `largest` is the max
// diameter of the circle of confusion in px, > 0; `width` is the image's width in px.
BlurrinessPlanes blurrinessPlanes(const ClipCircleOfConfusion& coc, double focusDistance, double largest, int width);

// Returns `count` points in the unit disk that are far from each other and from the centre (best candidates, Mitchell
// 1991). As in Scheuermann's slides, the centre is not a tap: only its depth is read. All calls return the same points.
std::vector<glm::vec2> poissonDisk(std::uint32_t count);

Method scheuermannMethod();

}  // namespace defocus::engine
