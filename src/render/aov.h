#pragma once
// Arbitrary output variables: what a pixel's nearest surface is, through the pinhole at the pixel's centre.

#include <filesystem>

#include "image/image.h"
#include "plan/frame_plan.h"

namespace defocus {

struct AovImages {
    Image depth;  // m along the view axis; infinity where nothing is
    Image coc;    // signed circle of confusion, px, > 0 behind the focus plane; the value at infinity where nothing is
    Image level;  // the object's fractional level λ; −1 where nothing is
};

// Draws opaque, alpha-tested and blended surfaces alike, at the nearest whole level. Needs a current GL context.
AovImages renderAovs(const World& world, const FramePlan& plan, const std::filesystem::path& shaderFolder = {});

// λ as colours that a person can read: level 0 dark violet to level 8 and beyond yellow (viridis), black where nothing
// is.
Image levelColourMap(const Image& level);

}  // namespace defocus
